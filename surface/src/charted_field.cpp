#include "charted_field.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace octafield::surface::detail {

ChartedField::ChartedField(const TriangleMesh& mesh, const DirectionField& field, const std::vector<CornerLink>& links)
    : mesh_(mesh), topology_(field.topology), symmetry_(field.symmetry), charts_(mesh.triangles.rows()) {
    // Directions do not depend on the size of f: scaled, its derivatives stay numbers.
    const double largest = field.values.size() > 0 ? field.values.cwiseAbs().maxCoeff() : 0;
    const Eigen::VectorXcd scaled = largest > 0 ? Eigen::VectorXcd(field.values / largest) : field.values;
    for (Index t = 0; t < mesh.triangles.rows(); ++t) {
        Chart& chart = charts_[t];
        const Eigen::Vector3d origin = mesh.vertices.row(mesh.triangles(t, 0));
        chart.corners[0] = 0;
        for (int k = 1; k < 3; ++k)
            chart.corners[k] = lower_vector(t, mesh.vertices.row(mesh.triangles(t, k)).transpose() - origin);
        const auto values = local_values(links, scaled, t);
        // The shape function of edge k is 1 - 2 times the barycentric function of corner k + 2, whose gradient is
        // i * side(k) / twice the area.
        chart.constant = chart.by_x = chart.by_y = 0;
        const double area = twice_area(t);
        for (int k = 0; k < 3; ++k) {
            const Complex gradient = -2.0 * Complex(0, 1) * side(t, k) / area;
            chart.by_x += values[k] * gradient.real();
            chart.by_y += values[k] * gradient.imag();
        }
        const Complex middle = on_side(t, 0, 0.5);
        chart.constant = values[0] - slope(t, middle);
    }
}

Complex ChartedField::direction(Index t, Complex z, Complex heading) const {
    const Complex f = value(t, z);
    if (f == 0.0) return heading;
    const double step = 2 * std::numbers::pi / symmetry_, angle = std::arg(f) / symmetry_;
    return std::polar(1.0, angle + step * std::round((std::arg(heading) - angle) / step));
}

ChartedField::Exit ChartedField::exit(Index t, Complex z, Complex direction, int skip) const {
    Exit found{-1, 0};
    for (int k = 0; k < 3; ++k) {
        const Complex along = side(t, k);
        const double rate = -cross(along, direction);
        if (k == skip || !(rate > 0)) continue;
        const double distance = std::max(0.0, cross(along, z - corners(t)[k])) / rate;
        if (found.side < 0 || distance < found.distance) found = {k, distance};
    }
    return found;
}

ChartedField::Side ChartedField::across(Side from) const {
    const Index edge = topology_.triangle_edges(from.triangle, from.side);
    const auto beside = topology_.edge_triangles.row(edge);
    const Index other = beside[0] == from.triangle ? beside[1] : beside[0];
    if (other < 0) return {-1, -1};
    for (int k = 0; k < 3; ++k)
        if (topology_.triangle_edges(other, k) == edge) return {other, k};
    return {-1, -1};
}

Complex ChartedField::carried(Complex direction, Side from, Side to) const {
    const Complex turn = -side(to.triangle, to.side) * std::conj(side(from.triangle, from.side));
    const Complex result = direction * turn;
    return result / std::abs(result);
}

std::array<Eigen::Vector3d, 2> ChartedField::axes(Index t) const {
    const Eigen::Vector3d origin = mesh_.vertices.row(mesh_.triangles(t, 0));
    const Eigen::Vector3d first = mesh_.vertices.row(mesh_.triangles(t, 1)).transpose() - origin;
    const Eigen::Vector3d second = mesh_.vertices.row(mesh_.triangles(t, 2)).transpose() - origin;
    const double sign = mesh_.triangles(t, 0) < mesh_.triangles(t, 1) ? 1 : -1;
    const Eigen::Vector3d x = sign * first.stableNormalized();
    return {x, first.cross(second).stableNormalized().cross(x)};
}

Eigen::Vector3d ChartedField::lift_vector(Index t, Complex z) const {
    const auto [x, y] = axes(t);
    return z.real() * x + z.imag() * y;
}

Eigen::Vector3d ChartedField::lift(Index t, Complex z) const {
    return mesh_.vertices.row(mesh_.triangles(t, 0)).transpose() + lift_vector(t, z);
}

Complex ChartedField::lower_vector(Index t, const Eigen::Vector3d& vector) const {
    const auto [x, y] = axes(t);
    return {x.dot(vector), y.dot(vector)};
}

Complex ChartedField::lower(Index t, const Eigen::Vector3d& position) const {
    return lower_vector(t, position - mesh_.vertices.row(mesh_.triangles(t, 0)).transpose());
}

}  // namespace octafield::surface::detail
