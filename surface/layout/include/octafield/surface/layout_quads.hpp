// Block-structured quads from a quad layout.
#pragma once

#include "octafield/surface/quad_layout.hpp"
#include "octafield/surface/quad_mesh.hpp"

namespace octafield::surface {

// One of the two is to be given, > 0.
struct LayoutQuadsOptions {
    double edge_length = 0;  // input unit, where exp(H) is 1: then the quads are about area / edge_length^2
    Index quad_count = 0;    // wanted; the nearest that comes from one size for all chords
};

struct LayoutQuads {
    QuadMesh mesh;                     // vertices of the layout first
    std::vector<Index> patches;        // of each quad
    std::vector<int> chord_counts;     // quads across each chord of the layout, >= 1
    Rows<Index, 2> patch_sizes{0, 2};  // quads along the first and second side of each patch
    Index mean_value_patches = 0;      // that were mapped with mean value weights, as the harmonic map folded
    double least_scaled_jacobian = 0;
};

// Quads across a chord: its length over the size, rounded, at least 1. Each patch is mapped to a rectangle, sides by
// their lengths in parameters: harmonic (cotangent weights), or with mean value weights (Floater 2003) where that
// folds; every triangle's area is checked. The grid is taken back to the surface: vertices lie on it; those on sides
// are shared.
//
// Throws InvalidInput (kind "bad_option"); GeometryError (kind "no_quad_layout", elements: patches that are not quads);
// SolverError: kinds "folded_map" (elements: patches), "inverted_quads" (elements: quads; a smaller size
// helps). The mesh is checked by require_valid.
LayoutQuads layout_quads(const QuadLayout& layout, const LayoutQuadsOptions& options, const Progress& progress = {});

// Of each quad, max(0, 1 - 2 / pi max |pi / 2 - angle|): 1 for right angles (Remacle et al. 2012).
Eigen::VectorXd quad_angle_quality(const QuadMesh& mesh);

}  // namespace octafield::surface
