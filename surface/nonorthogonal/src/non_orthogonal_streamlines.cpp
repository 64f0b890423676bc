#include "octafield/surface/non_orthogonal_streamlines.hpp"

#include <cmath>

#include "line_starts.hpp"
#include "streamline_tools.hpp"

namespace octafield::surface {
namespace {

using detail::ChartedLines;
using detail::LinesTracer;
using detail::VertexCharts;

void check(const NonOrthogonalField& field, const SurfaceSingularities& singularities,
           const StreamlineOptions& options) {
    detail::require_fit(field);
    detail::check_tracing(field.domain.mesh(), singularities, options);
}

}  // namespace

std::vector<Streamline> streamlines(const NonOrthogonalField& field, const SurfaceSingularities& singularities,
                                    const std::vector<StreamlineSeed>& seeds, const StreamlineOptions& options) {
    check(field, singularities, options);
    const ChartedLines charted(field, VertexCharts(field.domain));
    const LinesTracer tracer(charted, singularities, options);
    std::vector<Streamline> lines;
    for (const detail::Place& place : detail::seed_places(charted, seeds))
        lines.push_back(detail::both_ways(tracer, tracer, place, options.both_ways));
    return lines;
}

std::vector<Streamline> separatrices(const NonOrthogonalField& field, const SurfaceSingularities& singularities,
                                     const StreamlineOptions& options, const Progress& progress) {
    check(field, singularities, options);
    const VertexCharts vertices(field.domain);
    const ChartedLines charted(field, vertices);
    const LinesTracer tracer(charted, singularities, options);
    std::vector<Streamline> lines;
    for (std::size_t i = 0; i < singularities.points.size(); ++i) {
        const SurfaceSingularity& point = singularities.points[i];
        report_or_throw(progress, "separatrices", static_cast<double>(i) / singularities.points.size(), NAN);
        std::vector<detail::SeparatrixStart> starts;
        if (point.vertex < 0) {
            starts = detail::starts_of_point(charted, point, tracer);
        } else if (vertices.on_boundary(point.vertex)) {
            starts = detail::starts_of_corner(charted, field, vertices, point.vertex);
        }
        const auto number = static_cast<Index>(i);
        for (const auto& start : starts)
            lines.push_back(detail::separatrix(start, tracer.trace(start.place, number), tracer.max_length(), number));
    }
    return lines;
}

}  // namespace octafield::surface
