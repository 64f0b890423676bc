#include "octafield/surface/repair.hpp"

#include <algorithm>
#include <array>

#include "fill_holes.hpp"
#include "flat_triangles.hpp"
#include "half_edges.hpp"
#include "merge_points.hpp"
#include "shells.hpp"

namespace octafield::surface {
namespace {

std::string counted(std::size_t count, const char* noun) {
    return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

void reverse(Triangles& triangles, Index t) { std::swap(triangles(t, 1), triangles(t, 2)); }

// Drops the marked triangles; the others keep their order.
std::size_t drop(Triangles& triangles, const std::vector<bool>& marked) {
    Index kept = 0;
    for (Index t = 0; t < triangles.rows(); ++t)
        if (!marked[t]) triangles.row(kept++) = triangles.row(t).eval();
    const std::size_t dropped = triangles.rows() - kept;
    triangles.conservativeResize(kept, 3);
    return dropped;
}

// Of triangles on the same three vertices the first stays.
std::size_t drop_repeated(Triangles& triangles) {
    std::vector<std::pair<std::array<Index, 3>, Index>> keys;
    for (Index t = 0; t < triangles.rows(); ++t) {
        std::array<Index, 3> key{triangles(t, 0), triangles(t, 1), triangles(t, 2)};
        std::ranges::sort(key);
        keys.emplace_back(key, t);
    }
    std::ranges::sort(keys);
    std::vector<bool> marked(triangles.rows(), false);
    for (std::size_t i = 1; i < keys.size(); ++i) marked[keys[i].second] = keys[i].first == keys[i - 1].first;
    return drop(triangles, marked);
}

// A triangle hanging on a non-manifold edge by one side, its other two free, bounds nothing.
std::size_t drop_fins(Triangles& triangles) {
    std::vector<int> free_sides(triangles.rows(), 0), crowded_sides(triangles.rows(), 0);
    for_each_edge(sorted_half_edges(triangles), [&](auto first, auto last) {
        for (auto side = first; side != last; ++side) {
            free_sides[side->triangle] += last - first == 1;
            crowded_sides[side->triangle] += last - first > 2;
        }
    });
    std::vector<bool> marked(triangles.rows());
    for (Index t = 0; t < triangles.rows(); ++t) marked[t] = free_sides[t] == 2 && crowded_sides[t] == 1;
    return drop(triangles, marked);
}

// The fewest reversals that orient each piece alike across its two-sided edges. Pieces that cannot be oriented stay as
// they are.
std::size_t orient_alike(Triangles& triangles) {
    struct Neighbour {
        Index triangle;
        bool alike;
    };
    std::vector<std::vector<Neighbour>> neighbours(triangles.rows());
    for_each_edge(sorted_half_edges(triangles), [&](auto first, auto last) {
        if (last - first != 2) return;
        const auto second = first + 1;
        const bool alike = first->forward != second->forward;
        neighbours[first->triangle].push_back({second->triangle, alike});
        neighbours[second->triangle].push_back({first->triangle, alike});
    });
    std::size_t reversed = 0;
    std::vector<signed char> sign(triangles.rows(), 0);
    for (Index seed = 0; seed < triangles.rows(); ++seed) {
        if (sign[seed] != 0) continue;
        std::vector<Index> piece = {seed};
        sign[seed] = 1;
        bool orientable = true;
        for (std::size_t i = 0; i < piece.size(); ++i)
            for (const auto [next, alike] : neighbours[piece[i]]) {
                const signed char wanted = alike ? sign[piece[i]] : static_cast<signed char>(-sign[piece[i]]);
                if (sign[next] == 0) {
                    sign[next] = wanted;
                    piece.push_back(next);
                } else if (sign[next] != wanted) {
                    orientable = false;
                }
            }
        if (!orientable) continue;
        const auto negative = std::ranges::count_if(piece, [&](Index t) { return sign[t] < 0; });
        const int minority = 2 * negative <= static_cast<std::ptrdiff_t>(piece.size()) ? -1 : 1;
        for (const Index t : piece)
            if (sign[t] == minority) {
                reverse(triangles, t);
                ++reversed;
            }
    }
    return reversed;
}

class Repair {
public:
    Repair(const TriangleMesh& mesh, const RepairOptions& options) : options_(options) { result_.mesh = mesh; }

    RepairResult run() {
        if (!usable()) return std::move(result_);
        if (options_.merge_vertices) merge();
        if (options_.remove_degenerate) remove_degenerate();
        if (options_.remove_fins)
            note(drop_fins(mesh_.triangles), "removed ", "dangling triangle",
                 " (one side on an edge of three or more triangles, two free)");
        if (options_.orient)
            note(orient_alike(mesh_.triangles), "reversed ", "triangle", " to agree with the neighbours");
        if (options_.remove_degenerate) flatten();
        if (options_.fill_holes) fill();
        if (options_.orient) orient_outward();
        return std::move(result_);
    }

private:
    // Numbers that no repair can guess are left for validation to name.
    bool usable() const {
        return mesh_.triangles.rows() > 0 && mesh_.triangles.minCoeff() >= 0 &&
               mesh_.triangles.maxCoeff() < mesh_.vertices.rows() && mesh_.vertices.allFinite();
    }

    void note(std::size_t count, const char* verb, const char* noun, const char* rest) {
        if (count > 0) result_.actions.push_back(verb + counted(count, noun) + rest);
    }

    void merge() {
        TriangleMesh merged = merge_equal_points(mesh_);
        const auto count = static_cast<std::size_t>(mesh_.vertices.rows() - merged.vertices.rows());
        if (count == 0) return;
        mesh_ = std::move(merged);
        note(count, "merged ", "point", " into others at the same place");
    }

    void remove_degenerate() {
        std::vector<bool> repeats(mesh_.triangles.rows());
        for (Index t = 0; t < mesh_.triangles.rows(); ++t) repeats[t] = repeats_vertex(mesh_.triangles, t);
        note(drop(mesh_.triangles, repeats), "removed ", "triangle", " that used a vertex twice");
        note(drop_repeated(mesh_.triangles), "removed ", "triangle", " on the same three vertices as another");
    }

    void flatten() { note(flip_flat_triangles(mesh_), "flipped away ", "triangle", " without area"); }

    void fill() {
        const HoleFilling filling = fill_holes(mesh_, options_.max_hole_edges);
        const auto before = mesh_.triangles.rows();
        mesh_.triangles.conservativeResize(before + static_cast<Eigen::Index>(filling.triangles.size()), 3);
        for (std::size_t i = 0; i < filling.triangles.size(); ++i)
            mesh_.triangles.row(before + static_cast<Eigen::Index>(i)) = filling.triangles[i];
        note(filling.filled, "filled ", "hole", (" with " + counted(filling.triangles.size(), "triangle")).c_str());
    }

    void orient_outward() {
        const std::vector<HalfEdge> sides = sorted_half_edges(mesh_.triangles);
        bool oriented = true;
        for_each_edge(sides, [&](auto first, auto last) {
            if (last - first > 2 || (last - first == 2 && first->forward == (first + 1)->forward)) oriented = false;
        });
        if (!oriented) return;
        const std::vector<Index> wrong = wrong_way_triangles(mesh_, sides);
        for (const Index t : wrong) reverse(mesh_.triangles, t);
        note(wrong.size(), "reversed ", "triangle", " of shells that faced the wrong way");
    }

    const RepairOptions& options_;
    RepairResult result_;
    TriangleMesh& mesh_ = result_.mesh;
};

}  // namespace

RepairResult repair(const TriangleMesh& mesh, const RepairOptions& options) { return Repair(mesh, options).run(); }

}  // namespace octafield::surface
