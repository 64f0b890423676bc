// Isotropic remeshing to a target edge length, features kept (Botsch, Kobbelt 2004, by CGAL).
#pragma once

#include <string>
#include <vector>

#include "octafield/progress.hpp"
#include "octafield/surface/features.hpp"
#include "octafield/surface/triangle_mesh.hpp"

namespace octafield::surface {

struct RemeshOptions {
    double edge_length = 0;  // target, input unit; 0: default_edge_length, shorter where the shape needs it
    int iterations = 5;      // split, collapse, flip, relax, project: rounds, at least 1
};

struct RemeshResult {
    TriangleMesh mesh;
    FeatureGraph features;  // of the new mesh: pieces of the old curves, corners at the old corners' positions
    // What a user should know: edges shorter than wanted, and why; a surface that is not quite the input's.
    std::vector<std::string> notes;
    double deviation = 0;  // of the input's vertices from the new mesh, the largest, input unit
};

constexpr double deviation_told = 1. / 400;  // of shape_size

// 1/25 of shape_size: what remesh tries first where no length is given.
double default_edge_length(const TriangleMesh& mesh);

// The input must be valid (validate.hpp). Corners stay where they are; feature edges are split and merged along their
// curves only. The result is as sound as the input, with its topology: where that fails, or where no length was given
// and the surface departs by more than deviation_told or its volume by more than 1 %, shorter lengths are tried, down to
// 1/16 and within about 400,000 triangles or tets (200,000 for the departure's sake). The input's triangles are
// returned where none is sound. Throws InvalidInput, GeometryError (the input is not valid).
RemeshResult remesh(const TriangleMesh& mesh, const FeatureGraph& features, const RemeshOptions& options = {},
                    const Progress& progress = {});

}  // namespace octafield::surface
