#include "charts.hpp"

#include <Eigen/Geometry>
#include <algorithm>

namespace octafield::surface::detail {

Charts::Charts(SurfaceDomain domain)
    : domain_(std::move(domain)),
      mesh_(domain_.mesh()),
      topology_(domain_.topology()),
      corners_(mesh_.triangles.rows()) {
    for (Index t = 0; t < mesh_.triangles.rows(); ++t) {
        const Eigen::Vector3d origin = mesh_.vertices.row(mesh_.triangles(t, 0));
        corners_[t][0] = 0;
        for (int k = 1; k < 3; ++k)
            corners_[t][k] = lower_vector(t, mesh_.vertices.row(mesh_.triangles(t, k)).transpose() - origin);
    }
}

Charts::Exit Charts::exit(Index t, Complex z, Complex direction, int skip) const {
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

Charts::Side Charts::across(Side from) const {
    const Index edge = topology_.triangle_edges(from.triangle, from.side);
    const auto beside = topology_.edge_triangles.row(edge);
    const Index other = beside[0] == from.triangle ? beside[1] : beside[0];
    if (other < 0) return {-1, -1};
    for (int k = 0; k < 3; ++k)
        if (topology_.triangle_edges(other, k) == edge) return {other, k};
    return {-1, -1};
}

Complex Charts::carried(Complex direction, Side from, Side to) const {
    const Complex turn = -side(to.triangle, to.side) * std::conj(side(from.triangle, from.side));
    const Complex result = direction * turn;
    return result / std::abs(result);
}

std::array<Eigen::Vector3d, 2> Charts::axes(Index t) const {
    const Eigen::Vector3d origin = mesh_.vertices.row(mesh_.triangles(t, 0));
    const Eigen::Vector3d first = mesh_.vertices.row(mesh_.triangles(t, 1)).transpose() - origin;
    const Eigen::Vector3d second = mesh_.vertices.row(mesh_.triangles(t, 2)).transpose() - origin;
    const double sign = mesh_.triangles(t, 0) < mesh_.triangles(t, 1) ? 1 : -1;
    const Eigen::Vector3d x = sign * first.stableNormalized();
    return {x, first.cross(second).stableNormalized().cross(x)};
}

Eigen::Vector3d Charts::lift_vector(Index t, Complex z) const {
    const auto [x, y] = axes(t);
    return z.real() * x + z.imag() * y;
}

Eigen::Vector3d Charts::lift(Index t, Complex z) const {
    return mesh_.vertices.row(mesh_.triangles(t, 0)).transpose() + lift_vector(t, z);
}

Complex Charts::lower_vector(Index t, const Eigen::Vector3d& vector) const {
    const auto [x, y] = axes(t);
    return {x.dot(vector), y.dot(vector)};
}

Complex Charts::lower(Index t, const Eigen::Vector3d& position) const {
    return lower_vector(t, position - mesh_.vertices.row(mesh_.triangles(t, 0)).transpose());
}

}  // namespace octafield::surface::detail
