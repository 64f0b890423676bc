// Edge lengths that fit a surface: short where it bends, where walls and gaps are narrow and where feature curves lie
// near one another, growing slowly from there to the default length.
#pragma once

#include <numbers>
#include <string>
#include <vector>

#include "octafield/progress.hpp"
#include "octafield/surface/features.hpp"

namespace octafield::surface {

constexpr double default_max_cells = 2e5;

struct SizeFieldOptions {
    double longest = 0;    // input unit; 0: 1/25 of shape_size
    double shortest = 0;   // input unit; 0: 1/16 of the longest
    double angle = std::numbers::pi / 15;  // by which the surface may turn along one edge, radians in (0, pi)
    double growth = 0.4;                   // change of the length per length along the surface, positive
    double max_cells = default_max_cells;  // triangles, and tets inside: lengths grow where there would be more
};

struct SizeField {
    Eigen::VectorXd lengths;   // (V) input unit
    double shortest = 0;       // of all lengths, those inside large triangles too
    double longest = 0;        // the largest possible one: that of edges far inside
    double triangles = 0, tets = 0;  // to be expected; no tets in an open surface
    double scale = 1;                // above 1: by which lengths were multiplied to keep max_cells
    std::vector<std::string> notes;  // that lengths are not all alike, and what max_cells costs
    // All alike: the surface needs no other length than the longest.
    bool uniform() const { return !(shortest < 0.95 * longest); }
};

// Lengths at the vertices: angle / curvature (principal_directions; feature curves by their own turns), twice the width
// of walls, of gaps and of strips between feature curves, twice the length of feature curves between corners, within
// [shortest, longest], and at most `growth` apart per distance along the edges. Nothing is measured along the axes.
// O(n log n). The mesh must be valid (validate.hpp). Throws InvalidInput, GeometryError.
SizeField size_field(const TriangleMesh& mesh, const FeatureGraph& features, const SizeFieldOptions& options = {},
                     const Progress& progress = {});

}  // namespace octafield::surface
