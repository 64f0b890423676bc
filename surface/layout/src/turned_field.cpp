// The angle of fields on closed surfaces.
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>

#include "given_field.hpp"
#include "joiner.hpp"
#include "octafield/error.hpp"
#include "separatrix_tracer.hpp"
#include "split_between_points.hpp"
#include "structure.hpp"

namespace octafield::surface {
namespace {

constexpr double quarter = std::numbers::pi / 2;
constexpr int directions = 16;            // looked along, per quarter turn
constexpr double reaches[] = {0.5, 1.1};  // how far, in roots of the area in parameters, until there are enough angles
constexpr int most_tried = 8;             // angles
constexpr std::size_t enough = 4;
constexpr double same_angle = 0.004;  // radians
constexpr double longest = 8;         // curve, in the same roots
constexpr double first_reach = 1.5;   // likewise
constexpr double default_tolerance = 0.01;

ImposedField turned(const ImposedField& field, const detail::Structure& structure, Index component, double angle) {
    ImposedField result = field;
    for (Index e = 0; e < result.field.values.size(); ++e)
        if (structure.of_vertex[field.field.domain.topology().edges(e, 0)] == component)
            result.field.values[e] *= std::polar(1.0, 4 * angle);
    return result;
}

// Angles at which a separatrix of the part hits a point, those of short ones first. starts: vertices that are points as
// well, where there are no others.
std::vector<double> hitting_angles(const ImposedField& field, const detail::Structure& structure, Index component,
                                   const std::vector<Index>& starts, double reach, const Progress& progress) {
    std::vector<std::pair<double, double>> found;  // length, angle
    const double step = quarter / directions;
    // Lines are told to come to a point near its separatrices only: those turned by an eighth find the others.
    for (const double base : {0.0, quarter / 2}) {
        const ImposedField at = turned(field, structure, component, base);
        const detail::LocalField local(at);
        const detail::LayoutPoints points = detail::layout_points(at, local, starts, true);
        const detail::SeparatrixTracer tracer(local, points, 0.6 * step * reach, reach);
        for (int i = 0; i < directions / 2; ++i) {
            const double shear = (i + 0.5) * step - quarter / 4;
            for (Index p = 0; p < static_cast<Index>(points.points.size()); ++p) {
                if (structure.of_vertex[points.points[p].vertex] != component) continue;
                for (int s = 0; s < static_cast<int>(points.points[p].slots.size()); ++s) {
                    report_or_throw(progress, "turn", (base > 0 ? 0.25 : 0) + 0.5 * i / directions, NAN);
                    for (const auto& passing : tracer.trace({p, s}, shear).passing)
                        found.emplace_back(passing.length, base + shear + std::atan2(passing.offset, passing.length));
                }
            }
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

// The separatrices of one part, at one angle.
struct Try {
    double angle;
    ImposedField field;
    detail::LocalField local;
    detail::LayoutPoints points;
    detail::SeparatrixTracer tracer;
    detail::Joiner joiner;

    Try(const ImposedField& at, double by, const detail::Structure& structure, Index component,
        const std::vector<Index>& starts, double tolerance, double max_length)
        : angle(by),
          field(detail::split_between_points(at)),
          local(field),
          points(detail::layout_points(field, local, starts, true)),
          tracer(local, points, tolerance, max_length),
          joiner(tracer, points, max_length, of_component(points, structure, component)) {}

    static std::vector<bool> of_component(const detail::LayoutPoints& points, const detail::Structure& structure,
                                          Index component) {
        std::vector<bool> result;
        for (const detail::LayoutPoint& point : points.points)
            result.push_back(structure.of_vertex[point.vertex] == component);
        return result;
    }
    // All curves have this length in all at least, if those that are not joined are longer than `reach`.
    double least_length(double reach) const { return joiner.joined_length() + joiner.open() / 2.0 * reach; }
};

// The angle at which the curves of the part have the least length in all; none where they do not end. All angles are
// followed together, and given up where they can no longer be the best.
std::optional<double> best_angle(std::vector<std::unique_ptr<Try>> tries, double unit, double max_length,
                                 const Progress& progress) {
    std::optional<double> best;
    double least = std::numeric_limits<double>::infinity();
    double before = 0;
    for (double reach = first_reach * unit; !tries.empty(); before = reach, reach *= 2) {
        for (const auto& each : tries) {
            if (each->least_length(before) >= least) continue;
            report_or_throw(progress, "turn", std::min(0.5 + reach / max_length / 2, 1.0),
                            std::isinf(least) ? NAN : least);
            each->joiner.trace(reach);
            each->joiner.join(reach);
            if (each->joiner.open() > 0 || each->joiner.joined_length() >= least) continue;
            least = each->joiner.joined_length();
            best = each->angle;
        }
        std::erase_if(tries, [&](const auto& each) {
            return each->joiner.open() == 0 || each->least_length(reach) >= least || reach >= max_length;
        });
    }
    return best;
}

Index lowest_vertex(const detail::Structure& structure, Index component) {
    const auto found = std::find(structure.of_vertex.begin(), structure.of_vertex.end(), component);
    return static_cast<Index>(found - structure.of_vertex.begin());
}

}  // namespace

ImposedField turned_for_layout(const ImposedField& field, const LayoutCurveOptions& options, const Progress& progress) {
    detail::require_field(field);
    detail::require_parameters(field);
    const detail::Structure structure(field.field.domain);
    const double tolerance = options.end_tolerance > 0 ? options.end_tolerance
                                                       : default_tolerance * std::sqrt(detail::parameter_area(field));
    ImposedField result = field;
    for (Index c = 0; c < static_cast<Index>(structure.components.size()); ++c) {
        std::vector<Index> vertices;
        for (const Index v : field.point_vertices)
            if (structure.of_vertex[v] == c) vertices.push_back(v);
        if (!structure.components[c].curves.empty()) continue;
        const std::vector<Index> starts =
            vertices.empty() ? std::vector<Index>{lowest_vertex(structure, c)} : std::vector<Index>{};
        double area = 0;
        const Eigen::VectorXd areas = field.field.domain.areas();
        for (Index t = 0; t < areas.size(); ++t) area += structure.of_triangle[t] == c ? areas[t] : 0;
        const double unit = std::sqrt(area);
        const double max_length =
            options.max_length > 0 ? std::min(options.max_length, longest * unit) : longest * unit;
        std::vector<std::unique_ptr<Try>> tries;
        std::vector<double> angles;
        for (const double reach : reaches)
            if (angles.size() < enough) angles = hitting_angles(result, structure, c, starts, reach * unit, progress);
        for (const double angle : angles)
            tries.push_back(std::make_unique<Try>(turned(result, structure, c, angle), angle, structure, c, starts,
                                                  tolerance, max_length));
        auto angle = best_angle(std::move(tries), unit, max_length, progress);
        if (!angle && vertices.empty()) angle = angles.empty() ? 0.0 : angles[0];  // one closed line, not two
        if (!angle)
            throw GeometryError("the field on the closed part with singular points at vertices " + first_few(vertices) +
                                    " can be turned in no way tried that makes its separatrices end; move the points",
                                "no_short_turn", vertices);
        result = turned(result, structure, c, *angle);
    }
    return result;
}

}  // namespace octafield::surface
