#include "octafield/surface/streamlines.hpp"

#include <cmath>

#include "separatrix_starts.hpp"
#include "streamline_tools.hpp"

namespace octafield::surface {
namespace {

using detail::Place;

// Index of the singular point's vertex among the fans; -1 where several parts of the surface touch.
const VertexFans::Fan* only_fan(const VertexFans& fans, Index vertex) {
    const auto found = std::lower_bound(fans.fans.begin(), fans.fans.end(), vertex,
                                        [](const auto& fan, Index v) { return fan.vertex < v; });
    if (found == fans.fans.end() || found->vertex != vertex) return nullptr;
    if (found + 1 != fans.fans.end() && (found + 1)->vertex == vertex) return nullptr;
    return &*found;
}

}  // namespace

std::vector<Streamline> streamlines(const DirectionField& field, const SurfaceSingularities& singularities,
                                    const std::vector<StreamlineSeed>& seeds, const StreamlineOptions& options) {
    const detail::TwoWayTracer tracer(field, singularities, options);
    std::vector<Streamline> lines;
    for (const Place& place : detail::seed_places(tracer.field(), seeds)) lines.push_back(tracer.trace(place));
    return lines;
}

std::vector<Streamline> separatrices(const DirectionField& field, const SurfaceSingularities& singularities,
                                     const StreamlineOptions& options, const Progress& progress) {
    StreamlineOptions one_way = options;
    one_way.both_ways = false;
    const detail::TwoWayTracer tracer(field, singularities, one_way);
    const auto links = detail::corner_links(field.domain, field.symmetry);
    const Eigen::VectorXcd unit_values = detail::unit_values(field.values);
    std::vector<Streamline> lines;
    for (std::size_t i = 0; i < singularities.points.size(); ++i) {
        const SurfaceSingularity& point = singularities.points[i];
        report_or_throw(progress, "separatrices", static_cast<double>(i) / singularities.points.size(), NAN);
        std::vector<detail::SeparatrixStart> starts;
        if (point.vertex < 0) {
            starts = detail::starts_in_triangle(tracer.field(), point, tracer.forward());
        } else if (const auto* fan = only_fan(field.domain.fans(), point.vertex)) {
            starts = detail::starts_at_vertex(tracer.field(), links, unit_values, *fan, tracer.forward());
        }
        const auto number = static_cast<Index>(i);
        for (const auto& start : starts)
            lines.push_back(detail::separatrix(start, tracer.forward().trace(start.place, number),
                                               tracer.forward().max_length(), number));
    }
    return lines;
}

}  // namespace octafield::surface
