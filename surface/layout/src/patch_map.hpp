// A patch with four corners, mapped to a rectangle.
#pragma once

#include "layout_pieces.hpp"
#include "octafield/surface/quad_layout.hpp"

namespace octafield::surface::detail {

struct PatchMap {
    Points positions;                             // on the surface
    Rows<double, 2> parameters;                   // in the rectangle [0, width] x [0, height]
    std::vector<Index> nodes;                     // of the cut surface, -1: added here
    std::vector<std::array<Index, 3>> triangles;  // counter-clockwise in both
    double width = 0, height = 0;                 // first and second side: the sums of their lengths
    bool mean_value = false, folded = false;
};

// Harmonic, or with mean value weights where that folds; `folded` if both do. `along`: of all sides of the layout,
// where each of their points goes on the rectangle's border, from 0, increasing; about equal sums on opposite sides of
// the patch.
PatchMap patch_map(const QuadLayout& layout, Index patch, const std::vector<Eigen::VectorXd>& along);

// Positions at the inner points (i width / n, j height / m), 0 < i < n, 0 < j < m: row (j - 1) (n - 1) + i - 1. Rows
// that are in no triangle are no numbers.
Points grid_positions(const PatchMap& map, int n, int m);

}  // namespace octafield::surface::detail
