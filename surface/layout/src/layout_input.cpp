#include "layout_input.hpp"

#include <cmath>

#include "octafield/error.hpp"
#include "short_number.hpp"
#include "split_between_points.hpp"

namespace octafield::surface::detail {
namespace {

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

// Fields may be put together by hand.
void require_field(const ImposedField& field) {
    const SurfaceDomain& domain = field.field.domain;
    const auto fail = [](const std::string& what) {
        throw InvalidInput("this is no field that impose_singular_points gives: " + what, "bad_field");
    };
    if (domain.triangle_count() == 0) fail("its surface has no triangles");
    if (field.field.symmetry != 4) fail("its symmetry is not 4");
    if (field.log_size.size() != domain.vertex_count()) fail("log_size has not one number per vertex");
    if (field.field.values.size() != domain.edge_count()) fail("there is not one direction per edge");
    if (!field.log_size.allFinite() || !field.field.values.allFinite()) fail("not all of it is finite");
    if (field.point_vertices.size() != field.pattern.points.size()) fail("its pattern has other points");
    std::vector<bool> used(domain.vertex_count(), false);
    for (const VertexFans::Fan& fan : domain.fans().fans) used[fan.vertex] = true;
    const auto known = [&](Index v) { return v >= 0 && v < domain.vertex_count() && used[v]; };
    for (const Index v : field.point_vertices)
        if (!known(v)) fail("a point is at no vertex");
    for (const CornerQuads& corner : field.pattern.corners)
        if (!known(corner.vertex)) fail("a corner is at no vertex");
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

const ImposedField& checked(const ImposedField& field, const LayoutCurveOptions& options, bool general) {
    if (!(options.end_tolerance >= 0) || !(options.max_length >= 0) || std::isinf(options.end_tolerance))
        throw InvalidInput("the end tolerance and maximum length of layout curves are numbers >= 0", "bad_option");
    require_field(field);
    if (!general) require_parameters(field);
    return field;
}

}  // namespace

LayoutInput::LayoutInput(const ImposedField& given, const LayoutCurveOptions& options, bool general)
    : field(split_between_points(checked(given, options, general))),
      local(field),
      points(layout_points(field, local, options.cut_vertices, general)),
      parameter_area(area_in_parameters(field)) {
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
