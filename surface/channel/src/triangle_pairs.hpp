// Triangles joined to polygons with an even number of sides.
#pragma once

#include "plane_quads.hpp"
#include "plane_triangulation.hpp"

namespace octafield::surface::detail {

// The wanted triangles, in pairs where these are good quads. Those that are left, an even number in each connected
// part, are joined two by two by paths across sides, which are all split at their middles: so every triangle and every
// pair has an even number of sides, 8 at most. Polygons counter-clockwise; middles are added to the vertices.
std::vector<std::vector<Index>> even_polygons(const PlaneTriangulation& made, const std::vector<char>& wanted,
                                              PlaneQuads& vertices);

}  // namespace octafield::surface::detail
