// The angle of fields on closed surfaces.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "given_field.hpp"
#include "octafield/error.hpp"
#include "separatrix_tracer.hpp"
#include "structure.hpp"

namespace octafield::surface {
namespace {

constexpr double quarter = std::numbers::pi / 2;
constexpr int directions = 120;       // looked along, per quarter turn
constexpr double reach = 1;           // how far, in roots of the area in parameters
constexpr int most_tried = 8;         // angles
constexpr double same_angle = 0.004;  // radians
constexpr double longest = 8;         // curve, in the same roots

ImposedField turned(const ImposedField& field, const detail::Structure& structure, Index component, double angle) {
    ImposedField result = field;
    for (Index e = 0; e < result.field.values.size(); ++e)
        if (structure.of_vertex[field.field.domain.topology().edges(e, 0)] == component)
            result.field.values[e] *= std::polar(1.0, 4 * angle);
    return result;
}

// Angles at which a separatrix of the part hits a point, those of short ones first.
std::vector<double> hitting_angles(const ImposedField& field, const detail::Structure& structure, Index component,
                                   double unit) {
    std::vector<std::pair<double, double>> found;  // length, angle
    const double step = quarter / directions;
    for (int i = 0; i < directions; ++i) {
        const ImposedField at = turned(field, structure, component, i * step);
        const detail::LocalField local(at);
        const detail::LayoutPoints points = detail::layout_points(at, local);
        const detail::SeparatrixTracer tracer(local, points, 0.6 * step * unit, reach * unit);
        for (Index p = 0; p < static_cast<Index>(points.points.size()); ++p) {
            if (structure.of_vertex[points.points[p].vertex] != component) continue;
            for (int s = 0; s < static_cast<int>(points.points[p].slots.size()); ++s)
                for (const auto& passing : tracer.trace({p, s}).passing)
                    found.emplace_back(passing.length, i * step + std::atan2(passing.offset, passing.length));
        }
    }
    std::sort(found.begin(), found.end());
    std::vector<double> angles;
    for (const auto& [length, angle] : found) {
        const auto same = [&](double other) {
            const double off = angle - other;
            return std::abs(off - quarter * std::round(off / quarter)) < same_angle;
        };
        if (std::none_of(angles.begin(), angles.end(), same)) angles.push_back(angle);
        if (angles.size() == most_tried) break;
    }
    return angles;
}

// Of all curves; infinite where some do not end.
double total_length(const ImposedField& field, LayoutCurveOptions options, double unit) {
    if (!(options.max_length > 0 && options.max_length < longest * unit)) options.max_length = longest * unit;
    try {
        double sum = 0;
        for (const LayoutCurve& curve : layout_curves(field, options).curves) sum += curve.points.back().length;
        return sum;
    } catch (const GeometryError&) {
        return std::numeric_limits<double>::infinity();
    }
}

}  // namespace

ImposedField turned_for_layout(const ImposedField& field, const LayoutCurveOptions& options, const Progress& progress) {
    detail::require_field(field);
    const detail::Structure structure(field.field.domain);
    ImposedField result = field;
    for (Index c = 0; c < static_cast<Index>(structure.components.size()); ++c) {
        std::vector<Index> vertices;
        for (const Index v : field.point_vertices)
            if (structure.of_vertex[v] == c) vertices.push_back(v);
        if (!structure.components[c].curves.empty() || vertices.empty()) continue;
        report_or_throw(progress, "turn", c / static_cast<double>(structure.components.size()), NAN);
        double area = 0;
        const Eigen::VectorXd areas = triangle_areas(field.field.domain.mesh());
        for (Index t = 0; t < areas.size(); ++t) area += structure.of_triangle[t] == c ? areas[t] : 0;
        const double unit = std::sqrt(area);
        double best = std::numeric_limits<double>::infinity(), angle = 0;
        for (const double tried : hitting_angles(result, structure, c, unit))
            if (const double length = total_length(turned(result, structure, c, tried), options, unit); length < best) {
                best = length;
                angle = tried;
            }
        if (std::isinf(best))
            throw GeometryError("the field on the closed part with singular points at vertices " + first_few(vertices) +
                                    " can be turned in no way tried that makes its separatrices end; move the points",
                                "no_short_turn", vertices);
        result = turned(result, structure, c, angle);
    }
    return result;
}

}  // namespace octafield::surface
