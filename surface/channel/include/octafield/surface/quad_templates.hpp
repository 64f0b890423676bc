// All ways to fill a polygon with quads, as combinatorics (Simons, "Size-driven all-quad meshing for geographic data",
// 2024, 2.2.6).
#pragma once

#include <array>
#include <vector>

#include "octafield/arrays.hpp"

namespace octafield::surface {

// Corners counter-clockwise; ids below `sides` are the polygon's vertices in their order, those from `sides` on are
// inside.
struct QuadTemplate {
    int sides = 0, interior = 0;
    std::vector<std::array<int, 4>> quads;  // sides / 2 - 1 + interior of them
};

// Those with that many vertices inside, each once up to rotation and reflection of the polygon: the edges are a simple
// graph, vertices inside have three quads at least, and no two quads share two edges. Made at the first call; the same
// order each time. 4 for a hexagon with up to three vertices inside, 36 for an octagon with up to four.
// Throws InvalidInput (kind "bad_template") unless sides is even and 4 to 10, and interior 0 to 4.
const std::vector<QuadTemplate>& quad_templates(int sides, int interior);

}  // namespace octafield::surface
