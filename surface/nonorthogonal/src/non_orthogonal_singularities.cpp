#include <algorithm>
#include <cmath>
#include <numbers>

#include "charted_lines.hpp"

namespace octafield::surface {
namespace {

using detail::ChartedLines;
using detail::Complex;
using detail::VertexCharts;
constexpr double pi = std::numbers::pi;

// The branches of a cross in counter-clockwise order, numbered by all integers: k + 2 is k turned by pi.
double branch(const NonOrthogonalField& field, Index v, int k) {
    const int half_turns = k >= 0 ? k / 2 : (k - 1) / 2;
    return field.angles(v, k - 2 * half_turns) + half_turns * pi;
}

// The shift m for which branch k at the lower vertex of the edge, transported, becomes branch k + m at the higher one
// with the least sum of squared angles.
int shift(const NonOrthogonalField& field, const VertexCharts& charts, Index e) {
    const Index from = field.domain.topology().edges(e, 0), to = field.domain.topology().edges(e, 1);
    const double transport = charts.transport(e);
    const double mean_from = (branch(field, from, 0) + branch(field, from, 1)) / 2 + transport;
    const double mean_to = (branch(field, to, 0) + branch(field, to, 1)) / 2;
    const int middle = static_cast<int>(std::lround((mean_from - mean_to) / (pi / 2)));
    int best = middle;
    double least = -1;
    for (int m = middle - 1; m <= middle + 1; ++m) {
        double cost = 0;
        for (int k = 0; k < 2; ++k) {
            const double turn = branch(field, to, k + m) - branch(field, from, k) - transport;
            cost += turn * turn;
        }
        if (least >= 0 && cost >= least) continue;
        least = cost;
        best = m;
    }
    return best;
}

double boundary_deviation(const ChartedLines& field) {
    double most = 0;
    const EdgeTopology& topology = field.topology();
    for (Index t = 0; t < field.domain().triangle_count(); ++t)
        for (int k = 0; k < 3; ++k) {
            if (topology.edge_triangles.row(topology.triangle_edges(t, k)).minCoeff() >= 0) continue;
            const Complex along = field.side(t, k) / std::abs(field.side(t, k));
            most = std::max(most, std::abs(std::arg(field.direction(t, field.on_side(t, k, 0.5), along) / along)));
        }
    return most;
}

}  // namespace

SurfaceSingularities surface_singularities(const NonOrthogonalField& field) {
    detail::require_fit(field);
    const SurfaceDomain& domain = field.domain;
    const EdgeTopology& topology = domain.topology();
    const VertexCharts charts(domain);
    const ChartedLines charted(field, charts);
    std::vector<int> shifts(domain.edge_count());
    for (Index e = 0; e < domain.edge_count(); ++e) shifts[e] = shift(field, charts, e);

    SurfaceSingularities found;
    int sum = 0;
    const auto add = [&](const Eigen::Vector3d& position, int t, Index triangle, Index vertex) {
        if (t != 0) found.points.push_back({position, t, t / 4.0, triangle, vertex, vertex >= 0});
        sum += t;
    };
    for (Index t = 0; t < domain.triangle_count(); ++t) {
        int branches = 0;
        double turn = 0;
        for (int k = 0; k < 3; ++k) {
            const Index e = topology.triangle_edges(t, k);
            const int sense = topology.edges(e, 0) == domain.mesh().triangles(t, k) ? 1 : -1;
            branches += sense * shifts[e];
            turn += sense * charts.transport(e);
        }
        // Counter-clockwise round the triangle a branch has turned by `branches` quarters against the transport, which
        // itself has gone round by whole turns, and by the curvature in the triangle.
        branches -= 4 * static_cast<int>(std::lround(turn / (2 * pi)));
        if (branches != 0) add(charted.lift(t, charted.singular_place(t)), branches, t, -1);
    }
    for (Index v = 0; v < domain.vertex_count(); ++v)
        if (charts.on_boundary(v)) add(domain.mesh().vertices.row(v), 2 - field.quads[v], -1, v);
    found.index_sum = sum / 4.0;
    found.euler_characteristic = static_cast<int>(static_cast<Index>(domain.fans().fans.size()) - domain.edge_count() +
                                                  domain.triangle_count());
    found.agree = sum == 4 * found.euler_characteristic;
    found.boundary_deviation = boundary_deviation(charted);
    return found;
}

}  // namespace octafield::surface
