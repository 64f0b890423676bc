#include <cmath>

#include "vertex_search.hpp"

namespace octafield::volume::detail {
namespace {

// A right wedge over an equilateral triangle has corners of sin 60 degrees.
const double best_corner = std::sqrt(3.0) / 2;

double wedge_quality(const Points& vertices, const std::array<Index, 8>& ids) {
    double least = 1;
    for (const CellCorner& c : wedge_shape.corners) {
        const auto edge = [&](int k) -> Eigen::Vector3d { return vertices.row(ids[c[k]]) - vertices.row(ids[c[0]]); };
        const Eigen::Vector3d x = edge(1), y = edge(2), z = edge(3);
        least = std::min(least, x.cross(y).dot(z) / (x.norm() * y.norm() * z.norm()));
    }
    return least / best_corner;
}

// Cells whose lowest vertex is given: corner 0.
class WedgeFinder {
public:
    WedgeFinder(const TetSearch& search, PotentialCells& cells)
        : search_(search),
          topology_(search.topology),
          test_(search.vertices, best_corner * search.min_quality),
          cells_(cells) {}

    void find(Index lowest) {
        v_[0] = lowest;
        const std::span<const Index> around = topology_.around(lowest);
        for (std::size_t k = 0; k < around.size(); ++k) {
            if (around[k] < lowest) continue;
            const Index edge = topology_.neighbour_edges[topology_.neighbour_start[lowest] + k];
            for (Index i = topology_.link_start[edge]; i < topology_.link_start[edge + 1]; ++i) {
                const Index third = topology_.link_vertices[i];
                if (third < around[k] || !free(topology_.link_triangles[i])) continue;
                for (const Index top : around) {
                    if (top < lowest || top == third || top == around[k]) continue;
                    if (test_.corner(lowest, around[k], third, top))
                        grow(around[k], third, top);
                    else if (test_.corner(lowest, third, around[k], top))
                        grow(third, around[k], top);
                }
            }
        }
    }

private:
    bool free(Index triangle) const {
        for (const Index tet : topology_.triangle_tets[triangle])
            if (tet >= 0 && (search_.taken.empty() || !search_.taken[tet])) return true;
        return false;
    }

    bool corner(int k) const {
        const CellCorner& c = wedge_shape.corners[k];
        return test_.corner(v_[c[0]], v_[c[1]], v_[c[2]], v_[c[3]]);
    }

    void grow(Index first, Index second, Index top) {
        v_[1] = first, v_[2] = second, v_[3] = top;
        for_each_common(topology_.around(first), topology_.around(top), v_[0], [&](Index fourth) {
            if (fourth == second) return;
            v_[4] = fourth;
            if (!corner(1)) return;
            for_each_common(
                topology_.around(second), topology_.link(topology_.edge(top, fourth)), v_[0], [&](Index last) {
                    if (last == first) return;
                    v_[5] = last;
                    if (corner(2) && corner(3) && corner(4) && corner(5))
                        add_if_filled(
                            search_, wedge_shape, v_,
                            [&](const std::array<Index, 8>& ids) { return wedge_quality(search_.vertices, ids); },
                            cells_);
                });
        });
    }

    const TetSearch& search_;
    const TetTopology& topology_;
    const CornerTest test_;
    PotentialCells& cells_;
    std::array<Index, 8> v_{-1, -1, -1, -1, -1, -1, -1, -1};
};

}  // namespace

PotentialCells potential_wedges(const TetSearch& search) { return search_vertices<WedgeFinder>(search); }

}  // namespace octafield::volume::detail
