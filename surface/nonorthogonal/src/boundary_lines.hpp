// What the boundary asks for: quads at its vertices and the lines that follow from them.
#pragma once

#include <vector>

#include "octafield/surface/non_orthogonal_field.hpp"
#include "vertex_charts.hpp"

namespace octafield::surface::detail {

struct BoundaryLines {
    std::vector<int> quads;       // (V), 0 inside
    std::vector<TwoLines> lines;  // (V), in the vertex's chart; `first` follows the boundary; (0, 0) inside
    std::vector<bool> is_held;    // (V), both lines are given
    std::vector<Index> next;      // (V) the boundary vertex after it, surface on the left; -1 inside
};

// Throws InvalidInput as non_orthogonal_field.
BoundaryLines boundary_lines(const SurfaceDomain& domain, const VertexCharts& charts,
                             const NonOrthogonalFieldOptions& options);

// Quads at a boundary vertex of interior angle phi.
int quads_of_angle(double phi, double corner_angle);

}  // namespace octafield::surface::detail
