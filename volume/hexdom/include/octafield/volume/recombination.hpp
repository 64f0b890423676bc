// Tets joined to hexahedra and wedges, and pyramids where quads meet triangles.
#pragma once

#include "octafield/volume/mixed_mesh.hpp"

namespace octafield::volume {

struct RecombineOptions {
    double min_scaled_jacobian = 0.3;  // of a hexahedron or wedge that is made, in (0, 1)
    bool wedges = true;
    int threads = 0;
};

// Cells of `mesh` that are no tets stay. Its faces match but for quads that meet two triangles of tets (either diagonal);
// so do those of the result, where tets have been joined to more hexahedra and wedges. Vertices stay.
MixedMesh recombine(const MixedMesh& mesh, const RecombineOptions& options = {});

struct ConformReport {
    Index combined = 0;  // pyramids of two tets
    Index raised = 0;    // pyramids with a new apex in the tets round a diagonal
    Index split = 0;     // hexahedra and wedges given up: split about a point inside, or into tets
};

// The same region with faces that all match: pyramids on quads that met triangles. Positive at all corners as the mesh given
// is. New vertices come last.
MixedMesh conform(const MixedMesh& mesh, ConformReport* report = nullptr);

}  // namespace octafield::volume
