// Edges that are rounding: two points computed for one place.
#pragma once

#include <cstddef>

#include "octafield/surface/triangle_mesh.hpp"

namespace octafield::surface {

// Makes the ends of edges no longer than `length` one, the first of each group, and drops the triangles that this leaves without
// area. Leaves the mesh alone where it is no manifold, before or after, or would have another Euler characteristic. Vertices stay, used or not. Number of vertices that were moved into others.
std::size_t collapse_short_edges(TriangleMesh& mesh, double length);

}  // namespace octafield::surface
