// Vertices taken out of a surface.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "triangle_complex.hpp"

namespace octafield::volume::detail {

// How long a new edge may be, by its ends: longer where the quads wanted there are.
struct LengthBound {
    std::vector<double> at;        // (V)
    std::vector<double> length{};  // (V) wanted of edges, for what is crowded; empty: 1
    double wanted(Index v) const { return length.empty() ? 1 : length[v]; }
    double operator()(Index a, Index b) const { return std::max(at[a], at[b]); }
};

struct ThinLimits {
    double least_cosine;   // of the turn of new triangles from the old surface beneath
    double least_quality;  // of new triangles, unless those that go are as bad
    double crowded;        // a vertex this near to another, in lengths wanted, may leave edges of 1.5 times the bound
    bool any_filling;      // the hole filled in any way, not only from one of the vertices round it (edge collapse)
};

// Takes out vertices marked 1, those with the shortest edges first, and says how many. Near linear: one of more than 64
// triangles stays while it has so many. New edges keep to the bound
// unless one as long was round the vertex. Features and topology stay. Edge collapse with the link condition (Dey,
// Edelsbrunner, Guha, Nekhayev 1999), for curves along their edges only.
Index thin(TriangleComplex& complex, const std::vector<std::uint8_t>& removable, const LengthBound& bound,
           const ThinLimits& limits);

}  // namespace octafield::volume::detail
