#include "octafield/surface/layout_curves.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "given_field.hpp"
#include "octafield/error.hpp"
#include "separatrix_tracer.hpp"
#include "short_number.hpp"
#include "split_between_points.hpp"

namespace octafield::surface {
namespace {

using detail::Slot;

constexpr double most_size_factor = 1.05;
constexpr double default_tolerance = 0.01, default_length = 40;  // of the root of the area in parameters

void require_parameters(const ImposedField& field) {
    std::vector<Index> vertices;
    for (const HolonomyCondition& c : field.conditions)
        if (!(c.size_factor <= most_size_factor)) vertices.push_back(c.vertex);
    if (!vertices.empty())
        throw InvalidInput("sizes disagree after one turn round the curves or generators at vertices " +
                               first_few(vertices) +
                               ": the field was rotated too far to have quad coordinates; move the points instead "
                               "(inadmissible: move)",
                           "rotated_field", vertices);
}

double area_in_parameters(const ImposedField& field) {
    const TriangleMesh& mesh = field.field.domain.mesh();
    const Eigen::VectorXd areas = triangle_areas(mesh);
    double sum = 0;
    for (Index t = 0; t < areas.size(); ++t)
        for (int k = 0; k < 3; ++k) {  // by the middles of the sides
            const Index a = mesh.triangles(t, k), b = mesh.triangles(t, (k + 1) % 3);
            sum += areas[t] / 3 * std::exp(-field.log_size[a] - field.log_size[b]);
        }
    return sum;
}

struct Candidate {
    Slot from;
    detail::Passing to;
};

void require_short(const std::vector<Index>& vertices, double max_length) {
    if (vertices.empty()) return;
    throw GeometryError(std::to_string(vertices.size()) + " separatrices, from vertices " + first_few(vertices) +
                            ", are longer than " + short_number(max_length) +
                            " in quad coordinates without an end: the singular points are not in positions that give "
                            "a coarse layout. Move them, or raise the end tolerance so that near misses are joined, "
                            "or the maximum length",
                        "long_separatrix", vertices);
}

}  // namespace

LayoutCurves layout_curves(const ImposedField& given, const LayoutCurveOptions& options, const Progress& progress) {
    if (!(options.end_tolerance >= 0) || !(options.max_length >= 0) || std::isinf(options.end_tolerance))
        throw InvalidInput("the end tolerance and maximum length of layout curves are numbers >= 0", "bad_option");
    detail::require_field(given);
    require_parameters(given);
    const ImposedField field = detail::split_between_points(given);
    LayoutCurves result;
    result.domain = field.field.domain;
    result.parameter_area = area_in_parameters(field);
    const double unit = std::sqrt(result.parameter_area);
    result.end_tolerance = options.end_tolerance > 0 ? options.end_tolerance : default_tolerance * unit;
    const double max_length = options.max_length > 0 ? options.max_length : default_length * unit;
    const detail::LocalField local(field);
    const detail::LayoutPoints points = detail::layout_points(field, local, options.cut_vertices);
    const detail::SeparatrixTracer tracer(local, points, result.end_tolerance, max_length);

    std::vector<std::pair<Slot, detail::Trace>> traces;
    std::vector<Candidate> candidates;
    for (Index p = 0; p < static_cast<Index>(points.points.size()); ++p) {
        report_or_throw(progress, "trace", 0.9 * p / static_cast<double>(points.points.size()), NAN);
        for (int s = 0; s < static_cast<int>(points.points[p].slots.size()); ++s) {
            traces.push_back({{p, s}, tracer.trace({p, s})});
            for (const auto& passing : traces.back().second.passing) candidates.push_back({{p, s}, passing});
        }
    }
    result.traced = static_cast<Index>(traces.size());
    // Short ones first: what lies behind a point is not reached through it.
    std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
        return std::tuple(a.to.length, a.from, a.to.slot) < std::tuple(b.to.length, b.from, b.to.slot);
    });
    std::set<Slot> taken;
    for (const Candidate& c : candidates) {
        if (c.from == c.to.slot || taken.contains(c.from) || taken.contains(c.to.slot)) continue;
        auto curve = tracer.joined(c.from, c.to);
        if (!curve) continue;
        taken.insert({c.from, c.to.slot});
        result.curves.push_back(std::move(*curve));
    }
    std::vector<Index> unended;
    for (auto& [slot, trace] : traces) {
        if (taken.contains(slot)) continue;
        if (!trace.boundary) unended.push_back(points.points[slot.point].vertex);
        result.curves.push_back(std::move(trace.curve));
    }
    require_short(unended, max_length);
    for (LayoutCurve& curve : result.curves) detail::tighten(curve, local.charts());
    return result;
}

}  // namespace octafield::surface
