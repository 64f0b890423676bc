// Removal of triangles without area.
#pragma once

#include <cstddef>

#include "octafield/surface/triangle_mesh.hpp"

namespace octafield::surface {

// A triangle of three distinct points on a line is taken away by flipping its longest side into the neighbour beyond,
// which keeps the surface the same set of points; at a free side it is dropped. Those that cannot be treated stay.
// Returns the number of treatments. No triangle may use a vertex twice.
std::size_t flip_flat_triangles(TriangleMesh& mesh);

}  // namespace octafield::surface
