// Edges as what couples the lines of two vertices.
#pragma once

#include <vector>

#include "octafield/surface/non_orthogonal_field.hpp"
#include "vertex_charts.hpp"

namespace octafield::surface::detail {

// From the lower vertex i to the higher one j.
struct VertexLink {
    Index i, j;
    Complex turn;   // exp(2 i angle) of the transport: u at i is turn * u at j
    double weight;  // half the sum of the opposite cotangents, or 1
};

// One per edge, in the domain's order.
std::vector<VertexLink> vertex_links(const SurfaceDomain& domain, const VertexCharts& charts, EdgeWeights weights);

// E_s.
double lines_energy(const std::vector<VertexLink>& links, const std::vector<TwoLines>& lines, double lambda);

}  // namespace octafield::surface::detail
