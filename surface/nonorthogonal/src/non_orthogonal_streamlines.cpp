#include "octafield/surface/non_orthogonal_streamlines.hpp"

#include <cmath>

#include "line_starts.hpp"
#include "streamline_tools.hpp"

namespace octafield::surface {
namespace {

using detail::ChartedLines;
using detail::LinesTracer;
using detail::TracedCurve;
using detail::VertexCharts;

void check(const NonOrthogonalField& field, const SurfaceSingularities& singularities,
           const StreamlineOptions& options) {
    detail::require_fit(field);
    detail::check_tracing(field.domain.mesh(), singularities, options);
}

Streamline both_ways(const LinesTracer& tracer, const detail::Place& place, bool back_too) {
    const TracedCurve ahead = tracer.trace(place);
    if (ahead.end == StreamlineEnd::closed) {
        Streamline line = detail::joined({}, ahead);
        line.first_end = StreamlineEnd::closed;
        return line;
    }
    if (!back_too) return detail::joined({}, ahead);
    return detail::joined(tracer.trace({place.triangle, place.at, -place.heading}), ahead);
}

}  // namespace

std::vector<Streamline> streamlines(const NonOrthogonalField& field, const SurfaceSingularities& singularities,
                                    const std::vector<StreamlineSeed>& seeds, const StreamlineOptions& options) {
    check(field, singularities, options);
    const ChartedLines charted(field, VertexCharts(field.domain));
    const LinesTracer tracer(charted, singularities, options);
    std::vector<Streamline> lines;
    for (const detail::Place& place : detail::seed_places(charted, seeds))
        lines.push_back(both_ways(tracer, place, options.both_ways));
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
        for (const auto& start : starts) {
            TracedCurve curve = tracer.trace(start.place, static_cast<Index>(i));
            detail::prepend(curve, start);
            detail::cut(curve, tracer.max_length());
            Streamline line = detail::joined({}, curve);
            line.first_end = StreamlineEnd::singularity;
            line.first_singularity = static_cast<Index>(i);
            lines.push_back(std::move(line));
        }
    }
    return lines;
}

}  // namespace octafield::surface
