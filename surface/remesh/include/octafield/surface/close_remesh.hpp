// Remeshing for its own sake: triangles of given edge lengths, all good, whose vertices lie on the input.
#pragma once

#include <string>
#include <vector>

#include "octafield/progress.hpp"
#include "octafield/surface/features.hpp"
#include "octafield/surface/triangle_mesh.hpp"

namespace octafield::surface {

struct CloseRemeshOptions {
    double vertices = 0;   // wanted number: all lengths are multiplied until it is met; 0: lengths as they are
    double deviation = 0;  // input unit: lengths become shorter where either surface is farther from the other; 0: any
    double quality = 0.3;  // that every triangle is to have (triangle_qualities), in [0, 0.5]
    double max_vertices = 1e6;  // a deviation that would take more is refused, and asks for no more
    bool keep_stubs = false;    // feature curves that end inside the surface, shorter than two edges, as noise makes
    int iterations = 5;         // rounds of split, collapse, flip, relax before anything is measured, at least 1
};

struct CloseRemeshResult {
    TriangleMesh mesh;
    Edges stubs{0, 2};               // (k, 2) feature edges of the input that were not followed (keep_stubs)
    FeatureGraph features;           // of the new mesh: pieces of the old curves, corners at the old corners' positions
    std::vector<std::string> notes;  // what a user should know, one sentence each
    double deviation = 0;            // the larger of both, input unit: of the input's vertices from the new triangles,
    double own_deviation = 0;        // and of these triangles' middles and their sides' from the input
    double off_surface = 0;          // of the new vertices from the input: rounding
    Index poor = 0, forced = 0;      // triangles below the quality; of these, those that two features hold at an angle
    bool kept = false;               // no sound mesh was found: the input's triangles
};

// lengths: (V) wanted at the vertices of the input, linear between, input unit, positive: of edges away from features
// in the mean, within 5 %. Where feature curves lie nearer to one another than half of that, and where triangles would
// cross, they become shorter. Each step keeps every vertex on the input: it
// walks there from where it was (no nearest points, which jump between near sheets), along its curve where it is on a
// feature. Then the worst triangles are mended one by one. The result is as sound as the input, with its topology.
// Throws InvalidInput (kinds too_many_cells, too_few_cells, of what cannot be asked of such a surface, too),
// GeometryError (the input is not valid). Cancelled by progress ("remesh").
CloseRemeshResult close_remesh(const TriangleMesh& mesh, const FeatureGraph& features, const Eigen::VectorXd& lengths,
                               const CloseRemeshOptions& options = {}, const Progress& progress = {});

}  // namespace octafield::surface
