#include "charts.hpp"

#include <Eigen/Geometry>
#include <algorithm>

namespace octafield::surface::detail {
namespace {

// From corner 0.
std::array<Eigen::Vector3d, 2> sides_in_space(const TriangleMesh& mesh, Index t) {
    const Eigen::Vector3d origin = mesh.vertices.row(mesh.triangles(t, 0));
    return {mesh.vertices.row(mesh.triangles(t, 1)).transpose() - origin,
            mesh.vertices.row(mesh.triangles(t, 2)).transpose() - origin};
}

}  // namespace

Complex vector_by_own_lengths(const SurfaceDomain& domain, Index t, const Eigen::Vector3d& vector) {
    const auto [first, second] = sides_in_space(domain.mesh(), t);
    const Eigen::Vector3d normal = first.cross(second);
    const auto length = [&](int k) { return domain.edge_lengths()[domain.topology().triangle_edges(t, k)]; };
    const double along_first = vector.cross(second).dot(normal) * length(0);
    const double along_second = first.cross(vector).dot(normal) * length(2);
    return (along_first + along_second * std::polar(1.0, domain.corner_angles()(t, 0))) / normal.squaredNorm();
}

Charts::Charts(SurfaceDomain domain)
    : domain_(std::move(domain)),
      mesh_(domain_.mesh()),
      topology_(domain_.topology()),
      corners_(mesh_.triangles.rows()) {
    for (Index t = 0; t < mesh_.triangles.rows(); ++t) {
        corners_[t][0] = 0;
        if (domain_.has_own_lengths()) {
            const double sign = mesh_.triangles(t, 0) < mesh_.triangles(t, 1) ? 1 : -1;
            const auto length = [&](int k) { return domain_.edge_lengths()[topology_.triangle_edges(t, k)]; };
            corners_[t][1] = sign * length(0);
            corners_[t][2] = sign * std::polar(length(2), domain_.corner_angles()(t, 0));
            continue;
        }
        const Eigen::Vector3d origin = mesh_.vertices.row(mesh_.triangles(t, 0));
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
    const auto [first, second] = sides_in_space(mesh_, t);
    const double sign = mesh_.triangles(t, 0) < mesh_.triangles(t, 1) ? 1 : -1;
    const Eigen::Vector3d x = sign * first.stableNormalized();
    return {x, first.cross(second).stableNormalized().cross(x)};
}

Eigen::Vector3d Charts::lift_vector(Index t, Complex z) const {
    if (domain_.has_own_lengths()) {
        const auto [first, second] = sides_in_space(mesh_, t);
        const Complex a = corners_[t][1], b = corners_[t][2];
        return (cross(z, b) * first + cross(a, z) * second) / cross(a, b);
    }
    const auto [x, y] = axes(t);
    return z.real() * x + z.imag() * y;
}

Eigen::Vector3d Charts::lift(Index t, Complex z) const {
    return mesh_.vertices.row(mesh_.triangles(t, 0)).transpose() + lift_vector(t, z);
}

Complex Charts::lower_vector(Index t, const Eigen::Vector3d& vector) const {
    if (domain_.has_own_lengths()) {
        const double sign = mesh_.triangles(t, 0) < mesh_.triangles(t, 1) ? 1 : -1;
        return sign * vector_by_own_lengths(domain_, t, vector);
    }
    const auto [x, y] = axes(t);
    return {x.dot(vector), y.dot(vector)};
}

Complex Charts::lower(Index t, const Eigen::Vector3d& position) const {
    return lower_vector(t, position - mesh_.vertices.row(mesh_.triangles(t, 0)).transpose());
}

}  // namespace octafield::surface::detail
