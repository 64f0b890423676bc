#include "orientation.hpp"

#include <numeric>
#include <string>

#include "half_edges.hpp"
#include "octafield/error.hpp"

namespace octafield::surface::detail {
namespace {

// Union of triangles with the side each has to turn relative to its root.
class TurnedUnion {
public:
    explicit TurnedUnion(Index count) : parent_(count), turned_(count, 0), broken_(count, false) {
        std::iota(parent_.begin(), parent_.end(), 0);
    }
    Index root(Index t) {
        std::vector<Index> path;
        for (; parent_[t] != t; t = parent_[t]) path.push_back(t);
        char turned = 0;
        for (auto step = path.rbegin(); step != path.rend(); ++step) {
            turned_[*step] = turned ^= turned_[*step];
            parent_[*step] = t;
        }
        return t;
    }
    void join(Index a, Index b, bool differ) {
        const Index ra = root(a), rb = root(b);
        const bool between = (turned_[a] ^ turned_[b]) != (differ ? 1 : 0);
        if (ra == rb) {
            broken_[ra] = broken_[ra] || between;
        } else {
            parent_[rb] = ra;
            turned_[rb] = between ? 1 : 0;
            broken_[ra] = broken_[ra] || broken_[rb];
        }
    }
    bool broken(Index t) { return broken_[root(t)]; }

private:
    std::vector<Index> parent_;
    std::vector<char> turned_;
    std::vector<bool> broken_;
};

}  // namespace

std::vector<Index> unorientable_triangles(const TriangleMesh& mesh) {
    TurnedUnion turns(static_cast<Index>(mesh.triangles.rows()));
    for_each_edge(sorted_half_edges(mesh.triangles), [&](auto first, auto last) {
        if (last - first == 2)
            turns.join(first->triangle, (first + 1)->triangle, first->forward == (first + 1)->forward);
    });
    std::vector<Index> result;
    for (Index t = 0; t < mesh.triangles.rows(); ++t)
        if (turns.broken(t)) result.push_back(t);
    return result;
}

EdgeTopology oriented_topology(const TriangleMesh& mesh) {
    try {
        return edge_topology(mesh);
    } catch (const GeometryError& error) {
        if (error.kind() != "inconsistent_orientation") throw;
        const std::vector<Index> twisted = unorientable_triangles(mesh);
        if (twisted.empty()) throw;
        throw GeometryError("the surface has one side only, like a Moebius strip: no orientation of its " +
                                std::to_string(twisted.size()) + " connected triangles (" + first_few(twisted) +
                                ") is consistent; cut it open, or take the boundary of the solid",
                            "not_orientable", twisted);
    }
}

}  // namespace octafield::surface::detail
