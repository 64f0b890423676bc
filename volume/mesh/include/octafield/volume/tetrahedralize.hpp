// Tetrahedra inside a closed surface, by TetGen (Si 2015).
#pragma once

#include <string>
#include <vector>

#include "octafield/progress.hpp"
#include "octafield/surface/triangle_mesh.hpp"
#include "octafield/volume/tet_mesh.hpp"

namespace octafield::volume {

struct TetrahedralizeOptions {
    double radius_edge_ratio = 1.3;  // TetGen -q: bound on circumradius over shortest edge, at least 1
    double min_dihedral = 0;         // TetGen -q second bound, radians; 0: TetGen's default
    // Interior target: tets are split until their volume is at most that of 1.5 regular tets of this edge. 0: mean edge
    // length of the surface. Near a surface that is coarser the bound is not met, because the surface is kept: remesh
    // it first.
    double edge_length = 0;
};

// The surface (valid: surface/validate.hpp) is kept triangle by triangle: its vertices come first, in the same order
// with the same bits, and the boundary of the result is exactly its triangles. Several components and cavities (inner
// surfaces oriented outward of the solid) are allowed. TetGen runs in a copy of the process (Linux), which a crash of
// TetGen, `progress` or Ctrl-C ends alone. Where it fails on a sound surface it is run again: on the surface turned in
// space (the tets are turned back and the surface's own coordinates put in), with another tolerance, and with other
// bounds on shape and size; a sentence on what helped is appended to `notes`. Throws GeometryError with the surface's
// defect or why TetGen failed, in words of this project (kinds "tetgen_self_intersection", "tetgen_failed"),
// InvalidInput, Cancelled, SolverError. Never exits.
TetMesh tetrahedralize(const surface::TriangleMesh& mesh, const TetrahedralizeOptions& options = {},
                       const Progress& progress = {}, std::vector<std::string>* notes = nullptr);

}  // namespace octafield::volume
