// Boundary and interfaces of a tet mesh, out of its table of triangles.
#pragma once

#include <vector>

#include "octafield/volume/tet_mesh.hpp"
#include "octafield/volume/triangle_table.hpp"

namespace octafield::volume {

struct SurfaceOfTets {
    BoundarySurface surface;  // boundary triangles outward, then interfaces, out of the region of the lower id
    Index interface_triangles = 0;
    Edges sides;              // (F, 2) the tet behind each triangle and the one ahead of it; -1: none
    std::vector<Index> rows;  // (F) in the table
};

// regions: (m) ids, or none.
SurfaceOfTets surface_of_tets(const TetMesh& mesh, const TriangleTable& table, const std::vector<Index>& regions);

}  // namespace octafield::volume
