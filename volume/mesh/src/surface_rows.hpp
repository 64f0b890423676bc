// Triangles of a surface in the table of a tet mesh.
#pragma once

#include <vector>

#include "triangle_table.hpp"

namespace octafield::volume {

// Row of each triangle of the surface. Throws InvalidInput where vertices or triangles are none of the mesh.
std::vector<Index> surface_rows(const TetMesh& mesh, const TriangleTable& table, const BoundarySurface& surface);

}  // namespace octafield::volume
