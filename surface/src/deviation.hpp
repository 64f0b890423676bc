// How far one surface lies from another.
#pragma once

#include "octafield/surface/triangle_mesh.hpp"

namespace octafield::surface {

// Largest distance to `to` of the corners and centres of the triangles of `from`, input unit. Triangles of both with
// the same three points count as none. Requires triangles in `to`.
double one_sided_distance(const TriangleMesh& from, const TriangleMesh& to);

}  // namespace octafield::surface
