#include "crouzeix_raviart.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <string>

#include "octafield/error.hpp"

namespace octafield::surface::detail {
namespace {

// Sines of angles below this are rounding: cotangents would swamp every other entry of the stiffness matrix.
constexpr double smallest_sine = 1e-12;

// Squares of triangles' areas must be numbers.
void require_squares(const std::vector<Index>& beyond) {
    if (beyond.empty()) return;
    throw GeometryError("the squared areas of " + std::to_string(beyond.size()) + " triangles (" + first_few(beyond) +
                            ") are beyond double precision; measure the surface in another unit of length",
                        "size_out_of_range", beyond);
}

}  // namespace

std::vector<CornerLink> corner_links(const TriangleMesh& mesh, const EdgeTopology& topology, int symmetry) {
    const double reversed = symmetry % 2 == 0 ? 1 : -1;
    std::vector<CornerLink> links(3 * mesh.triangles.rows());
    std::vector<Index> degenerate, beyond;
    for (Index t = 0; t < mesh.triangles.rows(); ++t) {
        for (int k = 0; k < 3; ++k) {
            const Index corner = mesh.triangles(t, k);
            const Eigen::RowVector3d origin = mesh.vertices.row(corner);
            const Eigen::RowVector3d a = mesh.vertices.row(mesh.triangles(t, (k + 1) % 3)) - origin;
            const Eigen::RowVector3d b = mesh.vertices.row(mesh.triangles(t, (k + 2) % 3)) - origin;
            const double sine = a.cross(b).norm(), cosine = a.dot(b);
            const double most = a.norm() * b.norm();
            const bool flat = !(sine > smallest_sine * most), square_fits = std::isnormal(most * most);
            const bool repeated = a.isZero(0) || b.isZero(0);
            if (flat && (square_fits || repeated) && (degenerate.empty() || degenerate.back() != t))
                degenerate.push_back(t);
            if (!square_fits && !repeated && (beyond.empty() || beyond.back() != t)) beyond.push_back(t);
            CornerLink& link = links[3 * t + k];
            link.first = topology.triangle_edges(t, k);
            link.second = topology.triangle_edges(t, (k + 2) % 3);
            link.angle = std::atan2(sine, cosine);
            link.weight = 2 * cosine / sine;
            link.first_sign = topology.edges(link.first, 0) == corner ? 1 : reversed;
            link.second_turn =
                std::polar(1.0, symmetry * link.angle) * (topology.edges(link.second, 0) == corner ? 1 : reversed);
        }
    }
    require_squares(beyond);
    if (!degenerate.empty())
        throw GeometryError(std::to_string(degenerate.size()) + " triangles have no area (" + first_few(degenerate) +
                                "); repair or remesh the surface first",
                            "degenerate_triangle", degenerate);
    return links;
}

Eigen::VectorXd edge_masses(const TriangleMesh& mesh, const EdgeTopology& topology) {
    const Eigen::VectorXd areas = triangle_areas(mesh);
    Eigen::VectorXd masses = Eigen::VectorXd::Zero(topology.edges.rows());
    for (Index t = 0; t < areas.size(); ++t)
        for (int k = 0; k < 3; ++k) masses[topology.triangle_edges(t, k)] += areas[t] / 3;
    return masses;
}

double turn(const CornerLink& link, const Eigen::VectorXcd& values) {
    return std::arg(link.second_turn * values[link.second] * std::conj(link.first_sign * values[link.first]));
}

Eigen::VectorXcd unit_values(const Eigen::VectorXcd& values) {
    Eigen::VectorXcd result(values.size());
    for (Index e = 0; e < values.size(); ++e) {
        const double length = std::abs(values[e]);
        result[e] = length > 0 ? Complex(values[e].real() / length, values[e].imag() / length) : 1;
    }
    return result;
}

std::array<Complex, 3> local_values(const std::vector<CornerLink>& links, const Eigen::VectorXcd& values, Index t) {
    const CornerLink &from_0_to_2 = links[3 * t], &from_1_to_0 = links[3 * t + 1];
    return {values[from_0_to_2.first],
            std::conj(from_1_to_0.second_turn) * from_1_to_0.first_sign * values[from_1_to_0.first],
            std::conj(from_0_to_2.first_sign) * from_0_to_2.second_turn * values[from_0_to_2.second]};
}

double dirichlet_energy(const std::vector<CornerLink>& links, const Eigen::VectorXcd& values) {
    double twice = 0;
    for (const CornerLink& link : links)
        twice += link.weight * std::norm(link.first_sign * values[link.first] - link.second_turn * values[link.second]);
    return twice / 2;
}

Eigen::VectorXcd apply_stiffness(const std::vector<CornerLink>& links, const Eigen::VectorXcd& values) {
    Eigen::VectorXcd result = Eigen::VectorXcd::Zero(values.size());
    for (const CornerLink& link : links) {
        const Complex jump =
            link.weight * (link.first_sign * values[link.first] - link.second_turn * values[link.second]);
        result[link.first] += std::conj(link.first_sign) * jump;
        result[link.second] -= std::conj(link.second_turn) * jump;
    }
    return result;
}

}  // namespace octafield::surface::detail
