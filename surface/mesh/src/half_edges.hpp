// The sides of all triangles, grouped by edge: what validation, repair, features and edge topology have in common.
#pragma once

#include <algorithm>
#include <vector>

#include "octafield/surface/triangle_mesh.hpp"

namespace octafield::surface {

struct HalfEdge {
    Index low, high;  // vertex ids
    Index triangle;
    int corner;    // the side runs from corner to corner + 1 (mod 3)
    bool forward;  // the triangle runs it low to high
};

inline bool repeats_vertex(const Triangles& triangles, Index t) {
    return triangles(t, 0) == triangles(t, 1) || triangles(t, 1) == triangles(t, 2) ||
           triangles(t, 2) == triangles(t, 0);
}

// Sorted by edge, then triangle, then corner. Triangles that use a vertex twice are left out.
inline std::vector<HalfEdge> sorted_half_edges(const Triangles& triangles) {
    std::vector<HalfEdge> sides;
    sides.reserve(3 * triangles.rows());
    for (Index t = 0; t < triangles.rows(); ++t) {
        if (repeats_vertex(triangles, t)) continue;
        for (int k = 0; k < 3; ++k) {
            const Index a = triangles(t, k), b = triangles(t, (k + 1) % 3);
            sides.push_back({std::min(a, b), std::max(a, b), t, k, a < b});
        }
    }
    // The input order is (triangle, corner), so a stable sort by edge is enough.
    std::stable_sort(sides.begin(), sides.end(), [](const HalfEdge& a, const HalfEdge& b) {
        return a.low != b.low ? a.low < b.low : a.high < b.high;
    });
    return sides;
}

// Calls visit(first, last) for the sides of each edge, in lexicographic order of the edges.
template <class Visit>
void for_each_edge(const std::vector<HalfEdge>& sides, const Visit& visit) {
    for (auto first = sides.begin(); first != sides.end();) {
        auto last = first + 1;
        while (last != sides.end() && last->low == first->low && last->high == first->high) ++last;
        visit(first, last);
        first = last;
    }
}

}  // namespace octafield::surface
