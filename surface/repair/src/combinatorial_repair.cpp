#include "combinatorial_repair.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "half_edges.hpp"
#include "shells.hpp"

namespace octafield::surface {
namespace {

void reverse(Triangles& triangles, Index t) { std::swap(triangles(t, 1), triangles(t, 2)); }

// Drops the marked triangles; the others keep their order. Drops none where none would be left.
std::size_t drop(Triangles& triangles, const std::vector<bool>& marked) {
    if (std::ranges::find(marked, false) == marked.end()) return 0;
    Index kept = 0;
    for (Index t = 0; t < triangles.rows(); ++t)
        if (!marked[t]) triangles.row(kept++) = triangles.row(t).eval();
    const std::size_t dropped = triangles.rows() - kept;
    triangles.conservativeResize(kept, 3);
    return dropped;
}

// Groups of triangles on the same three vertices, each in ascending order.
std::vector<std::vector<Index>> repeated(const Triangles& triangles) {
    std::vector<std::pair<std::array<Index, 3>, Index>> keys;
    for (Index t = 0; t < triangles.rows(); ++t) {
        std::array<Index, 3> key{triangles(t, 0), triangles(t, 1), triangles(t, 2)};
        std::ranges::sort(key);
        keys.emplace_back(key, t);
    }
    std::ranges::sort(keys);
    std::vector<std::vector<Index>> groups;
    for (std::size_t i = 1; i < keys.size(); ++i) {
        if (keys[i].first != keys[i - 1].first) continue;
        if (i < 2 || keys[i - 2].first != keys[i].first) groups.push_back({keys[i - 1].second});
        groups.back().push_back(keys[i].second);
    }
    return groups;
}

// An even permutation of ascending vertices.
bool is_even(const Triangles& triangles, Index t) {
    const Index a = triangles(t, 0), b = triangles(t, 1), c = triangles(t, 2);
    return (a < b) + (b < c) + (c < a) == 2;
}

}  // namespace

std::size_t drop_repeating_a_vertex(Triangles& triangles) {
    std::vector<bool> marked(triangles.rows());
    for (Index t = 0; t < triangles.rows(); ++t) marked[t] = repeats_vertex(triangles, t);
    return drop(triangles, marked);
}

std::size_t drop_repeated(Triangles& triangles) {
    const auto groups = repeated(triangles);
    if (groups.empty()) return 0;
    std::vector<std::array<Index, 3>> others(triangles.rows(), {0, 0, 0});  // other triangles at each side
    for_each_edge(sorted_half_edges(triangles), [&](auto first, auto last) {
        for (auto side = first; side != last; ++side)
            others[side->triangle][side->corner] = static_cast<Index>(last - first);
    });
    std::vector<bool> marked(triangles.rows(), false);
    for (const auto& group : groups) {
        const auto even = std::ranges::count_if(group, [&](Index t) { return is_even(triangles, t); });
        const auto size = static_cast<Index>(group.size());
        const bool is_wall = 2 * even == size && std::ranges::all_of(others[group[0]], [&](Index sides) {
            return sides - size == 0 || sides - size == 2;
        });
        for (std::size_t i = is_wall ? 0 : 1; i < group.size(); ++i) marked[group[i]] = true;
    }
    return drop(triangles, marked);
}

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

std::size_t drop_tiny_open_pieces(TriangleMesh& mesh, double size) {
    const std::vector<HalfEdge> sides = sorted_half_edges(mesh.triangles);
    const std::vector<Index> piece = connected_pieces(mesh, sides);
    if (piece.empty()) return 0;
    const Index count = *std::ranges::max_element(piece) + 1;
    std::vector<bool> open(count, false);
    for_each_edge(sides, [&](auto first, auto last) {
        if (last - first == 1) open[piece[first->triangle]] = true;
    });
    Eigen::ArrayX3d low = Eigen::ArrayX3d::Constant(count, 3, INFINITY), high = -low;
    for (Index t = 0; t < mesh.triangles.rows(); ++t)
        for (const Index v : mesh.triangles.row(t)) {
            low.row(piece[t]) = low.row(piece[t]).min(mesh.vertices.row(v).array());
            high.row(piece[t]) = high.row(piece[t]).max(mesh.vertices.row(v).array());
        }
    std::vector<bool> marked(mesh.triangles.rows());
    for (Index t = 0; t < mesh.triangles.rows(); ++t)
        marked[t] = open[piece[t]] && (high.row(piece[t]) - low.row(piece[t])).matrix().norm() < size;
    return drop(mesh.triangles, marked);
}

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

std::size_t orient_outward(TriangleMesh& mesh) {
    const std::vector<HalfEdge> sides = sorted_half_edges(mesh.triangles);
    bool oriented = true;
    for_each_edge(sides, [&](auto first, auto last) {
        if (last - first > 2 || (last - first == 2 && first->forward == (first + 1)->forward)) oriented = false;
    });
    if (!oriented) return 0;
    const std::vector<Index> wrong = wrong_way_triangles(mesh, sides);
    for (const Index t : wrong) reverse(mesh.triangles, t);
    return wrong.size();
}

std::size_t drop_unused_vertices(TriangleMesh& mesh) {
    std::vector<Index> new_id(mesh.vertices.rows(), -1);
    for (const Index v : mesh.triangles.reshaped()) new_id[v] = 0;
    Index kept = 0;
    for (std::size_t v = 0; v < new_id.size(); ++v)
        if (new_id[v] == 0) {
            mesh.vertices.row(kept) = mesh.vertices.row(static_cast<Index>(v)).eval();
            new_id[v] = kept++;
        }
    const auto dropped = static_cast<std::size_t>(mesh.vertices.rows() - kept);
    if (dropped == 0) return 0;
    mesh.vertices.conservativeResize(kept, 3);
    for (Index& v : mesh.triangles.reshaped()) v = new_id[v];
    return dropped;
}

}  // namespace octafield::surface
