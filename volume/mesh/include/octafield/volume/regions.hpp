// Regions of a tet mesh (materials, CAD volumes) and the surface that a field follows: boundary and interfaces.
#pragma once

#include <vector>

#include "octafield/volume/tet_mesh.hpp"

namespace octafield::volume {

// The triangles of one tet only, as in boundary_surface and in its order, then the interfaces: those between tets of
// different regions. Edges may have three triangles or more. What takes a BoundarySurface and a FeatureGraph takes
// this too: boundary_constraints, alignment_angles.
struct RegionSurface {
    BoundarySurface surface;        // boundary triangles outward, interfaces out of the region of the lower id
    Index interface_triangles = 0;  // the last so many
    Edges sides;                    // (F, 2) the tet behind each triangle and the one ahead of it; -1: none
};

// regions: (m) an id per tet; empty: all are one region. Throws InvalidInput where the number of ids is wrong, and what
// boundary_surface throws.
RegionSurface region_surface(const TetMesh& mesh, const std::vector<Index>& regions);

// A surface cut open along all edges that do not have exactly two triangles. The sheets are manifold, with rims; a
// surface that is so already stays as it is. Triangles keep their order.
struct Sheets {
    surface::TriangleMesh mesh;
    std::vector<Index> vertex_map;  // (n) the surface's vertex that each is a copy of, ascending; all but unused ones
    Edges cuts;                     // (c, 2) the surface's edges with three triangles or more, lower id first, in order
};
Sheets cut_into_sheets(const surface::TriangleMesh& surface);

}  // namespace octafield::volume
