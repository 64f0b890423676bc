// Tets, triangles and edges inside the mesh whose vertices all lie on its surface. Where the field is held there, they
// leave it nothing to do but jump: coarse CAD meshes have many. Splitting them gives it vertices of its own.
#pragma once

#include <vector>

#include "octafield/volume/tet_domain.hpp"

namespace octafield::volume {

struct LockingElements {
    std::vector<Index> tets;  // all four vertices on the surface
    Edges edges;              // (e, 2) both ends on it, but no edge of its triangles; lower id first, in order
    Triangles triangles;      // (t, 3) all edges on it, but none of its triangles; ids ascending, in order
};

// surface: of the mesh, boundary_surface or that of region_surface. Throws InvalidInput, GeometryError.
LockingElements find_locking(const TetDomain& domain);

struct LockingSplit {
    TetMesh mesh;               // old vertices first, with their ids
    std::vector<Index> parent;  // (m) old tet that each tet is part of
    LockingElements found;      // what was there before
    Index added_vertices = 0;
    std::vector<Index> left;  // tets of `mesh` that still have all vertices on the surface: too flat to split
};

// Splits edges at their midpoints, then triangles and last tets at their centres. The surface keeps its vertices and
// triangles; no tet of the result has all its vertices there, and none is inverted, but for `left`. Near linear; the
// order of splits is that of the vertex ids. Throws InvalidInput, GeometryError.
LockingSplit split_locking(const TetDomain& domain);

}  // namespace octafield::volume
