#include "layout_input.hpp"

#include <cmath>

#include "given_field.hpp"
#include "octafield/disjoint_sets.hpp"
#include "octafield/error.hpp"
#include "short_number.hpp"
#include "split_between_points.hpp"

namespace octafield::surface::detail {
namespace {

constexpr double default_tolerance = 0.01, default_length = 40;  // of the root of the area in parameters
constexpr double most_of_part = 0.1;  // likewise, of a connected part: in small faces all would be near misses

const ImposedField& checked(const ImposedField& field, const LayoutCurveOptions& options, bool general) {
    if (!(options.end_tolerance >= 0) || !(options.max_length >= 0) || std::isinf(options.end_tolerance))
        throw InvalidInput("the end tolerance and maximum length of layout curves are numbers >= 0", "bad_option");
    require_field(field);
    if (!general) require_parameters(field);
    return field;
}

void limit_tolerances(const ImposedField& field, LayoutPoints& points) {
    const Triangles& triangles = field.field.domain.mesh().triangles;
    DisjointSets sets(field.field.domain.vertex_count());
    for (Index t = 0; t < triangles.rows(); ++t)
        for (int k = 1; k < 3; ++k) sets.join(triangles(t, 0), triangles(t, k));
    Index parts = 0;
    const std::vector<Index> part_of = std::move(sets).numbers(parts);
    const std::vector<double> areas = parameter_areas(field, part_of, parts);
    for (LayoutPoint& point : points.points)
        point.most_tolerance = most_of_part * std::sqrt(areas[part_of[point.vertex]]);
}

}  // namespace

LayoutInput::LayoutInput(const ImposedField& given, const LayoutCurveOptions& options, bool general)
    : field(split_between_points(checked(given, options, general))),
      local(field),
      points(layout_points(field, local, options.cut_vertices, general)),
      parameter_area(detail::parameter_area(field)) {
    limit_tolerances(field, points);
    const double unit = std::sqrt(parameter_area);
    end_tolerance = options.end_tolerance > 0 ? options.end_tolerance : default_tolerance * unit;
    max_length = options.max_length > 0 ? options.max_length : default_length * unit;
}

LayoutCurves LayoutInput::no_curves() const {
    LayoutCurves result;
    result.domain = field.field.domain;
    result.parameter_area = parameter_area;
    result.end_tolerance = end_tolerance;
    return result;
}

void require_short(const std::vector<Index>& vertices, double max_length) {
    if (vertices.empty()) return;
    throw GeometryError(std::to_string(vertices.size()) + " separatrices, from vertices " + first_few(vertices) +
                            ", are longer than " + short_number(max_length) +
                            " in quad coordinates without an end: the singular points are not in positions that give "
                            "a coarse layout. Move them, or raise the end tolerance so that near misses are joined, "
                            "or the maximum length",
                        "long_separatrix", vertices);
}

}  // namespace octafield::surface::detail
