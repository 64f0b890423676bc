#include "followed_field.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <complex>

namespace octafield::surface::detail {

using Vector = Eigen::Vector3d;

Vector FollowedField::direction(Index triangle, const Vector& place) const {
    const TriangleMesh& mesh = domain_->mesh();
    const EdgeTopology& topology = domain_->topology();
    const Vector normal = domain_->normals().row(triangle);
    std::array<Vector, 3> corners;
    for (int k = 0; k < 3; ++k) corners[k] = mesh.vertices.row(mesh.triangles(triangle, k));
    const Vector x = (corners[1] - corners[0]).normalized(), y = normal.cross(x);
    const double area = (corners[1] - corners[0]).cross(corners[2] - corners[0]).dot(normal);
    std::complex<double> sum = 0;
    for (int k = 0; k < 3; ++k) {
        const Vector &a = corners[k], &b = corners[(k + 1) % 3];
        const double opposite = (b - a).cross(place - a).dot(normal) / area;  // barycentric, of corner k + 2
        const Index edge = topology.triangle_edges(triangle, k);
        const Vector along = mesh.vertices.row(topology.edges(edge, 1)) - mesh.vertices.row(topology.edges(edge, 0));
        const double angle = std::atan2(along.dot(y), along.dot(x));
        sum += (1 - 2 * opposite) * (*values_)[edge] * std::polar(1.0, 4 * angle);
    }
    if (sum == 0.0) return Vector::Zero();
    const double angle = std::arg(sum) / 4;
    return std::cos(angle) * x + std::sin(angle) * y;
}

}  // namespace octafield::surface::detail
