// Isotropic remeshing to a target edge length, features kept (Botsch, Kobbelt 2004, by CGAL).
#pragma once

#include "octafield/progress.hpp"
#include "octafield/surface/features.hpp"
#include "octafield/surface/triangle_mesh.hpp"

namespace octafield::surface {

struct RemeshOptions {
    double edge_length = 0;  // target, input unit; 0: 1/25 of the bounding-box diagonal
    int iterations = 5;      // split, collapse, flip, relax, project: rounds, at least 1
};

struct RemeshResult {
    TriangleMesh mesh;
    FeatureGraph features;  // of the new mesh: pieces of the old curves, corners at the old corners' positions
};

// The input must be valid (validate.hpp). Corners stay where they are; feature edges are split and merged along their
// curves only. Throws GeometryError if the result is not valid (the target is too coarse for the shape; the message
// says so), InvalidInput.
RemeshResult remesh(const TriangleMesh& mesh, const FeatureGraph& features, const RemeshOptions& options = {},
                    const Progress& progress = {});

}  // namespace octafield::surface
