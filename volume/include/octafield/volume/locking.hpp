// Tets, triangles and edges inside the mesh whose vertices all lie on its surface. Where the field is held there, they
// leave it nothing to do but jump: coarse CAD meshes have many. Splitting them gives it vertices of its own.
// Likewise edges inside that join two singular vertices without being singular: a seamless map of a field in the tets has
// no freedom at them, and meshers get flipped tets there.
#pragma once

#include <vector>

#include "octafield/volume/tet_mesh.hpp"

namespace octafield::volume {

struct LockingElements {
    std::vector<Index> tets;  // all four vertices on the surface
    Edges edges;              // (e, 2) both ends on it, but no edge of its triangles; lower id first, in order
    Triangles triangles;      // (t, 3) all edges on it, but none of its triangles; ids ascending, in order
};

// surface: of the mesh, boundary_surface or that of region_surface. Throws InvalidInput, GeometryError.
LockingElements find_locking(const TetMesh& mesh, const BoundarySurface& surface);

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
LockingSplit split_locking(const TetMesh& mesh, const BoundarySurface& surface);

struct SingularSplit {
    TetMesh mesh;               // old vertices first, with their ids
    std::vector<Index> parent;  // (m) old tet that each tet is part of, whose frame it keeps
    Edges edges;                // (e, 2) of the old mesh that were to be split; lower id first, in order
    Edges left;                 // of these, what is still there: rounding would invert a flat tet
    Index added_vertices = 0;
};

// Splits edges at their midpoints that are no edges of the surface, not singular, and join two vertices of singular
// edges. With the frames of the parents, the singular edges are those of the old mesh, none split, and the new vertices
// are on none of them. of_tets: (m, 4) unit quaternions w x y z. Near linear. Throws InvalidInput, GeometryError.
SingularSplit split_between_singular(const TetMesh& mesh, const BoundarySurface& surface, const Quaternions& of_tets,
                                     int threads = 0);

}  // namespace octafield::volume
