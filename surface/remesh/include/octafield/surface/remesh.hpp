// Isotropic remeshing to a target edge length, features kept (Botsch, Kobbelt 2004, by CGAL).
#pragma once

#include <string>
#include <vector>

#include "octafield/progress.hpp"
#include "octafield/surface/features.hpp"
#include "octafield/surface/size_field.hpp"
#include "octafield/surface/triangle_mesh.hpp"

namespace octafield::surface {

struct RemeshOptions {
    double edge_length = 0;  // target, input unit; 0: lengths of size_field, shorter where the result needs it
    int iterations = 5;      // split, collapse, flip, relax, project: rounds, at least 1
    double max_cells = default_max_cells;  // without a length: of triangles, and of tets inside, to be expected
};

struct RemeshResult {
    TriangleMesh mesh;
    FeatureGraph features;  // of the new mesh: pieces of the old curves, corners at the old corners' positions
    // What a user should know: edges shorter than wanted, and why; a surface that is not quite the input's.
    std::vector<std::string> notes;
    double deviation = 0;  // of the input's vertices from the new mesh, the largest, input unit
    double inner_length = 0;  // of edges far inside the surface, input unit; 0: the mean of the surface's
};

constexpr double deviation_told = 1. / 400;  // of shape_size

// 1/25 of shape_size: what remesh takes where no length is given and the shape asks for no shorter one.
double default_edge_length(const TriangleMesh& mesh);

// The input must be valid (validate.hpp). Corners stay where they are; feature edges are split and merged along their
// curves only. The result is as sound as the input, with its topology.
// Without a length, edges follow size_field; where triangles would cross, or the surface would depart from the input's
// by more than deviation_told or its volume by more than 1 %, lengths are lowered there and it is done again, within
// twice max_cells. Where that fails, and with a length, all edges get one length, shortened until the surface is sound
// (without a length: and follows), down to 1/16 and within the same bounds. The input's triangles are returned where
// none is sound. Throws InvalidInput, GeometryError (the input is not valid).
RemeshResult remesh(const TriangleMesh& mesh, const FeatureGraph& features, const RemeshOptions& options = {},
                    const Progress& progress = {});

}  // namespace octafield::surface
