#include <algorithm>
#include <cmath>

#include "charted_lines.hpp"
#include "line_matching.hpp"

namespace octafield::surface {
namespace {

using detail::ChartedLines;
using detail::Complex;
using detail::VertexCharts;

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
    const VertexCharts charts(domain);
    const ChartedLines charted(field, charts);
    std::vector<TwoLines> lines;
    for (Index v = 0; v < domain.vertex_count(); ++v)
        lines.push_back(ordered({field.angles(v, 0), field.angles(v, 1)}));
    const std::vector<int> indices = triangle_indices(domain, charts, lines);

    SurfaceSingularities found;
    int sum = 0;
    const auto add = [&](const Eigen::Vector3d& position, int t, Index triangle, Index vertex) {
        if (t != 0) found.points.push_back({position, t, t / 4.0, triangle, vertex, vertex >= 0});
        sum += t;
    };
    for (Index t = 0; t < domain.triangle_count(); ++t)
        if (indices[t] != 0) add(charted.lift(t, charted.singular_place(t)), indices[t], t, -1);
    for (Index v = 0; v < domain.vertex_count(); ++v)
        if (charts.on_boundary(v)) add(domain.mesh().vertices.row(v), 2 - field.quads[v], -1, v);
    found.index_sum = sum / 4.0;
    found.euler_characteristic =
        static_cast<int>(static_cast<Index>(domain.fans().fans.size()) - domain.edge_count() + domain.triangle_count());
    found.agree = sum == 4 * found.euler_characteristic;
    found.boundary_deviation = boundary_deviation(charted);
    return found;
}

}  // namespace octafield::surface
