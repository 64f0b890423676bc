// Edges as what couples the lines of two vertices.
#pragma once

#include <array>
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

// Of two pairs of coefficients, as real vectors.
inline double dot(const std::array<Complex, 2>& a, const std::array<Complex, 2>& b) {
    return (std::conj(a[0]) * b[0] + std::conj(a[1]) * b[1]).real();
}

// One per edge, in the domain's order.
std::vector<VertexLink> vertex_links(const SurfaceDomain& domain, const VertexCharts& charts, EdgeWeights weights);

// E_s.
double lines_energy(const std::vector<VertexLink>& links, const std::vector<TwoLines>& lines, double lambda);

}  // namespace octafield::surface::detail
