// Tets joined to hexahedra and wedges, and pyramids where quads meet triangles.
#pragma once

#include "octafield/volume/mixed_mesh.hpp"

namespace octafield::volume {

struct RecombineOptions {
    double min_scaled_jacobian = 0.3;  // of a hexahedron or wedge that is made, in (0, 1)
    bool wedges = true;
    double max_boundary_fold = 0.35;  // radians: turn between two triangles of the boundary that become a quad
    Edges kept_edges{0, 2};           // of the boundary: no quad replaces the two triangles at one (feature curves)
    // (w, 3) triangles, as between regions, through which no cell reaches. As on the boundary two of them may become
    // one quad: that of the cells on both sides, once there are pyramids.
    Triangles walls{0, 3};
    int threads = 0;
};

struct RecombineReport {
    Index potential_hexahedra = 0, potential_wedges = 0;  // found; wedges among the tets that hexahedra left
    Index hexahedra = 0, wedges = 0;                      // made
    Index flat_tets = 0;  // gone: they lay against a quad and had its four vertices, as where diagonals cross
};

// Cells of `mesh` that are no tets stay. Its faces match but for quads that meet two triangles of tets (either
// diagonal); so do those of the result, where tets have been joined to more hexahedra and wedges. Vertices stay. All
// hexahedra that tets can be joined to are found vertex by vertex (Pellerin, Johnen, Verhetsel, Remacle 2018,
// "Identifying combinations of tetrahedra into hexahedra"); of these some that can stand together are chosen: the best
// first, then improved by exchanges as Andrade, Resende, Werneck 2012 do. The same at any number of threads. The
// boundary, and a wall, may get a quad for two triangles; so a flat tet may go. Throws InvalidInput, and GeometryError
// with a defect of the mesh.
MixedMesh recombine(const MixedMesh& mesh, const RecombineOptions& options = {}, RecombineReport* report = nullptr);

struct ConformReport {
    Index combined = 0;  // pyramids of two tets
    Index raised = 0;    // pyramids with a new apex in the tets round a diagonal
    Index split = 0;     // hexahedra and wedges given up: split about a point inside, or into tets
};

// The same region with faces that all match: pyramids on quads that met triangles. Positive at all corners as the mesh
// given is. Vertices stay, new ones come last; of the old ones inside, some may be in no cell any more. A flat tet on
// the four vertices of a quad goes where quads or the boundary are on both its sides. Throws GeometryError: a defect of
// the mesh; kind "mismatched_face" where a quad meets triangles that do not fill it; "unsplittable_cell" where no
// pyramid fits on a quad and the cell cannot be split.
// walls: triangles, as between regions, that no cell made here reaches through where it grows over its neighbours.
MixedMesh conform(const MixedMesh& mesh, ConformReport* report = nullptr, const Triangles& walls = Triangles(0, 3));

}  // namespace octafield::volume
