#include "sized_system.hpp"

#include <cmath>
#include <numbers>

#include "curved_integrals.hpp"

namespace octafield::surface::detail {
namespace {

using std::numbers::pi;

double side_sign(const SurfaceDomain& domain, Index t, int k) {
    const auto corners = domain.mesh().triangles.row(t);
    return corners[k] < corners[(k + 1) % 3] ? 1 : -1;
}

// In the plane of the triangle, by its sides' lengths and angles.
std::array<Complex, 3> flat_corners(const SurfaceDomain& domain, Index t) {
    const auto length = [&](int k) { return domain.edge_lengths()[domain.topology().triangle_edges(t, k)]; };
    return {0.0, length(0), std::polar(length(2), domain.corner_angles()(t, 0))};
}

}  // namespace

SizedConnection::SizedConnection(const SurfaceDomain& domain, const VertexCharts& charts, const Eigen::VectorXd& turns,
                                 int symmetry)
    : steps(domain.edge_count()), holonomy(domain.triangle_count()) {
    for (Index e = 0; e < domain.edge_count(); ++e)
        steps[e] = std::polar(1.0, symmetry * (charts.transport(e) + turns[e]));
    for (Index t = 0; t < domain.triangle_count(); ++t) {
        double curvature = 0, turn = 0;
        for (int k = 0; k < 3; ++k) {
            const Index e = domain.topology().triangle_edges(t, k);
            curvature += side_sign(domain, t, k) * charts.transport(e);
            turn += side_sign(domain, t, k) * turns[e];
        }
        holonomy[t] = symmetry * (std::remainder(curvature, 2 * pi) + turn);
    }
}

Complex SizedConnection::step(const SurfaceDomain& domain, Index t, int k) const {
    const Complex forward = steps[domain.topology().triangle_edges(t, k)];
    return side_sign(domain, t, k) > 0 ? forward : std::conj(forward);
}

std::vector<int> turned_triangles(const SurfaceDomain& domain, const SizedConnection& connection,
                                  const Eigen::VectorXcd& values) {
    std::vector<int> indices(domain.triangle_count());
    for (Index t = 0; t < domain.triangle_count(); ++t) {
        double sum = connection.holonomy[t];
        for (int k = 0; k < 3; ++k) {
            const Complex here = values[domain.mesh().triangles(t, k)];
            const Complex next = values[domain.mesh().triangles(t, (k + 1) % 3)];
            // Of an edge seen from both sides the turns are opposite to the last bit.
            const Complex back = std::conj(connection.step(domain, t, k)) * next * std::conj(here);
            sum += side_sign(domain, t, k) > 0 ? std::arg(back) : -std::arg(std::conj(back));
        }
        indices[t] = static_cast<int>(std::lround(sum / (2 * pi)));
    }
    return indices;
}

SizedSystem::SizedSystem(const SurfaceDomain& domain, const SizedConnection& connection, double s)
    : row(domain.vertex_count(), -1), shares(Eigen::VectorXd::Zero(domain.vertex_count())) {
    Index unknowns = 0;
    for (const auto& fan : domain.fans().fans) row[fan.vertex] = unknowns++;
    std::vector<Eigen::Triplet<Complex>> energies, masses;
    energies.reserve(6 * domain.triangle_count());
    masses.reserve(6 * domain.triangle_count());
    for (Index t = 0; t < domain.triangle_count(); ++t) {
        const auto corners = domain.mesh().triangles.row(t);
        const std::array steps{connection.step(domain, t, 0), connection.step(domain, t, 1),
                               connection.step(domain, t, 2)};
        const auto plane = flat_corners(domain, t);
        const TriangleMatrices local = triangle_matrices(plane, steps);
        const double area = (std::conj(plane[1]) * plane[2]).imag() / 2;
        for (int k = 0; k < 3; ++k) shares[corners[k]] += area / 3;
        for (int j = 0; j < 3; ++j)
            for (int k = 0; k < 3; ++k) {
                const Index a = row[corners[j]], b = row[corners[k]];
                if (a < b) continue;
                Complex twist = local.holonomy / area * local.mass[j][k];
                const Complex half(0, 0.5);
                if (k == (j + 1) % 3) twist -= half * std::conj(steps[j]);
                if (j == (k + 1) % 3) twist += half * steps[k];
                energies.emplace_back(a, b, local.stiffness[j][k] - s * twist);
                masses.emplace_back(a, b, local.mass[j][k]);
            }
    }
    energy.resize(unknowns, unknowns);
    energy.setFromTriplets(energies.begin(), energies.end());
    mass.resize(unknowns, unknowns);
    mass.setFromTriplets(masses.begin(), masses.end());
}

}  // namespace octafield::surface::detail
