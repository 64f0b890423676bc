// A surface round another drawn onto it.
#pragma once

#include "octafield/surface/triangle_mesh.hpp"

namespace octafield::surface {

// Moves vertices of `mesh` that are nearer than `reach` to their nearest points on `to`, but those whose triangles
// would turn by more than 60 degrees, become thin, cross or touch others for that. Number of vertices moved. Requires a
// mesh that does not cross itself, which it does not do afterwards either, and triangles in `to`.
std::size_t snap(TriangleMesh& mesh, const TriangleMesh& to, double reach);

}  // namespace octafield::surface
