#include "crouzeix_raviart.hpp"

#include <cmath>

namespace octafield::surface::detail {

std::vector<CornerLink> corner_links(const SurfaceDomain& domain, int symmetry) {
    const EdgeTopology& topology = domain.topology();
    const double reversed = symmetry % 2 == 0 ? 1 : -1;
    std::vector<CornerLink> links(3 * static_cast<std::size_t>(domain.triangle_count()));
    for (Index t = 0; t < domain.triangle_count(); ++t) {
        for (int k = 0; k < 3; ++k) {
            const Index corner = domain.mesh().triangles(t, k);
            CornerLink& link = links[3 * t + k];
            link.first = topology.triangle_edges(t, k);
            link.second = topology.triangle_edges(t, (k + 2) % 3);
            link.angle = domain.corner_angles()(t, k);
            link.weight = 2 * domain.cotangents()(t, k);
            link.first_sign = topology.edges(link.first, 0) == corner ? 1 : reversed;
            link.second_turn =
                std::polar(1.0, symmetry * link.angle) * (topology.edges(link.second, 0) == corner ? 1 : reversed);
        }
    }
    return links;
}

Eigen::VectorXd edge_masses(const SurfaceDomain& domain) {
    const EdgeTopology& topology = domain.topology();
    const Eigen::VectorXd areas = domain.areas();
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
