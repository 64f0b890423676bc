#include "size_potential.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "vertex_laplacian.hpp"

namespace octafield::surface::detail {
namespace {

using std::numbers::pi;

// Edge midpoint quadrature of exp(-2 H), scaled by the largest so that nothing overflows.
void set_mean_size(const SurfaceDomain& domain, const Structure& structure, Eigen::VectorXd& h) {
    const std::size_t count = structure.components.size();
    std::vector<double> least(count, std::numeric_limits<double>::infinity()), sum(count, 0), area(count, 0);
    const Triangles& triangles = domain.mesh().triangles;
    const Eigen::VectorXd areas = domain.areas();
    for (Index v = 0; v < h.size(); ++v)
        if (const Index c = structure.of_vertex[v]; c >= 0) least[c] = std::min(least[c], h[v]);
    for (Index t = 0; t < domain.triangle_count(); ++t) {
        const Index c = structure.of_triangle[t];
        area[c] += areas[t];
        for (int k = 0; k < 3; ++k)
            sum[c] += areas[t] / 3 * std::exp(2 * least[c] - h[triangles(t, k)] - h[triangles(t, (k + 1) % 3)]);
    }
    for (Index v = 0; v < h.size(); ++v)
        if (const Index c = structure.of_vertex[v]; c >= 0) h[v] += std::log(sum[c] / area[c]) / 2 - least[c];
}

}  // namespace

Eigen::VectorXd loads(const Structure& structure, const std::vector<int>& indices) {
    Eigen::VectorXd result = Eigen::VectorXd::Zero(structure.angles.size());
    for (Index v = 0; v < result.size(); ++v)
        if (structure.of_vertex[v] >= 0)
            result[v] = (structure.on_boundary[v] ? pi : 2 * pi) - structure.angles[v] - pi / 2 * indices[v];
    return result;
}

Eigen::VectorXd size_potential(const SurfaceDomain& domain, const Structure& structure, const Eigen::VectorXd& loads) {
    std::vector<bool> held(domain.vertex_count(), false), seen(structure.components.size(), false);
    for (Index v = 0; v < domain.vertex_count(); ++v) {
        const Index c = structure.of_vertex[v];
        if (c >= 0 && seen[c]) continue;
        held[v] = true;
        if (c >= 0) seen[c] = true;
    }
    Eigen::VectorXd h = VertexLaplacian(domain, held).solve(loads, Eigen::VectorXd::Zero(domain.vertex_count()));
    set_mean_size(domain, structure, h);
    return h;
}

std::vector<double> conjugate_turns(const SurfaceDomain& domain, const Eigen::VectorXd& u) {
    std::vector<double> turns(3 * static_cast<std::size_t>(domain.triangle_count()));
    for (Index t = 0; t < domain.triangle_count(); ++t)
        for (int k = 0; k < 3; ++k) {
            const int next = (k + 1) % 3, last = (k + 2) % 3;
            const double here = u[domain.mesh().triangles(t, k)];
            const double to_next = here - u[domain.mesh().triangles(t, next)];
            const double to_last = here - u[domain.mesh().triangles(t, last)];
            turns[3 * t + k] = -(domain.cotangents()(t, last) * to_next + domain.cotangents()(t, next) * to_last) / 2;
        }
    return turns;
}

}  // namespace octafield::surface::detail
