#include "given_field.hpp"

#include <cmath>
#include <string>
#include <vector>

#include "octafield/error.hpp"

namespace octafield::surface::detail {
namespace {

constexpr double most_size_factor = 1.05;

}  // namespace

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

double parameter_area(const ImposedField& field) {
    return parameter_areas(field, std::vector<Index>(field.field.domain.vertex_count(), 0), 1)[0];
}

std::vector<double> parameter_areas(const ImposedField& field, const std::vector<Index>& part_of, Index parts) {
    const TriangleMesh& mesh = field.field.domain.mesh();
    const Eigen::VectorXd areas = field.field.domain.areas();
    std::vector<double> sums(parts, 0);
    for (Index t = 0; t < areas.size(); ++t)
        for (int k = 0; k < 3; ++k) {  // by the middles of the sides
            const Index a = mesh.triangles(t, k), b = mesh.triangles(t, (k + 1) % 3);
            sums[part_of[a]] += areas[t] / 3 * std::exp(-field.log_size[a] - field.log_size[b]);
        }
    return sums;
}

}  // namespace octafield::surface::detail
