#include "octafield/surface/layout_curves.hpp"

#include <cmath>

#include "given_field.hpp"
#include "joiner.hpp"
#include "octafield/error.hpp"
#include "short_number.hpp"
#include "split_between_points.hpp"

namespace octafield::surface {
namespace {

// Of the root of the area in parameters.
constexpr double default_tolerance = 0.01, default_length = 40, first_reach = 1.5;

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
    detail::require_parameters(given);
    const ImposedField field = detail::split_between_points(given);
    LayoutCurves result;
    result.domain = field.field.domain;
    result.parameter_area = detail::parameter_area(field);
    const double unit = std::sqrt(result.parameter_area);
    result.end_tolerance = options.end_tolerance > 0 ? options.end_tolerance : default_tolerance * unit;
    const double max_length = options.max_length > 0 ? options.max_length : default_length * unit;
    const detail::LocalField local(field);
    const detail::LayoutPoints points = detail::layout_points(field, local, options.cut_vertices);
    const detail::SeparatrixTracer tracer(local, points, result.end_tolerance, max_length);

    detail::Joiner joiner(tracer, points, max_length);
    for (double reach = first_reach * unit; joiner.trace(reach, progress); reach *= 4) joiner.join(reach);
    result.traced = joiner.count();
    const std::vector<Index> unended = joiner.take_curves(result.curves);
    require_short(unended, max_length);
    for (LayoutCurve& curve : result.curves) detail::tighten(curve, local.charts());
    return result;
}

}  // namespace octafield::surface
