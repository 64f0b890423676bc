#include "ginzburg_landau.hpp"

#include <cmath>

namespace octafield::surface::detail {
namespace {

Eigen::VectorXd stiffness_diagonal(const std::vector<CornerLink>& links, Eigen::Index edges) {
    Eigen::VectorXd diagonal = Eigen::VectorXd::Zero(edges);
    for (const CornerLink& link : links) {
        diagonal[link.first] += link.weight;
        diagonal[link.second] += link.weight;
    }
    return diagonal;
}

}  // namespace

GinzburgLandau::GinzburgLandau(const std::vector<CornerLink>& links, const Eigen::VectorXd& masses,
                               const FreeSystem& system, const Pull& pull, const Eigen::VectorXd& epsilon)
    : links_(links),
      system_(system),
      pull_(pull),
      weights_(masses.array() / epsilon.array() / epsilon.array()),
      residual_weights_(weights_.cwiseMin(stiffness_diagonal(links, masses.size())).cwiseAbs2()),
      stiffness_(system.diagonal()) {}

GinzburgLandau::Slope GinzburgLandau::slope(const Eigen::VectorXcd& values) const {
    Eigen::VectorXcd gradient = apply_stiffness(links_, values);
    double energy = values.dot(gradient).real() / 2 + pull_.energy(values);
    for (Eigen::Index e = 0; e < values.size(); ++e) {
        const double square = std::norm(values[e]), excess = square - 1;
        energy += weights_[e] / 4 * excess * excess;
        gradient[e] += (weights_[e] * excess + pull_.weights[e]) * values[e] - pull_.targets[e];
    }
    Slope slope = {energy, as_real(system_.gather(gradient)), 0};
    const double scale = residual_weights_.dot(values.cwiseAbs2());
    slope.residual = scale > 0 ? slope.gradient.norm() / std::sqrt(scale) : 0;
    return slope;
}

void GinzburgLandau::hessian(const Eigen::VectorXcd& values, double shift, FreeSystem::RealMatrix& matrix) const {
    for (Index i = 0; i < system_.size(); ++i) {
        const Index e = system_.edges()[i];
        const double x = values[e].real(), y = values[e].imag(), w = weights_[e];
        const double rest = stiffness_[i] + pull_.weights[e] + w * (shift - 1);
        FreeSystem::set_diagonal(matrix, i, rest + w * (3 * x * x + y * y), w * 2 * x * y,
                                 rest + w * (x * x + 3 * y * y));
    }
}

std::array<double, 4> GinzburgLandau::along(const Eigen::VectorXcd& values, const Eigen::VectorXcd& direction) const {
    const auto inner = [](const Eigen::VectorXcd& a, const Eigen::VectorXcd& b) { return a.dot(b).real(); };
    const Eigen::VectorXcd stiff = apply_stiffness(links_, direction);
    std::array<double, 4> c = {inner(values, stiff) - inner(pull_.targets, direction), inner(direction, stiff) / 2, 0,
                               0};
    // |f + t d|^2 - 1 = s + 2 p t + q t^2
    for (Eigen::Index e = 0; e < values.size(); ++e) {
        const double s = std::norm(values[e]) - 1, q = std::norm(direction[e]);
        const double p = (std::conj(values[e]) * direction[e]).real();
        c[0] += weights_[e] * s * p + pull_.weights[e] * p;
        c[1] += weights_[e] * (p * p + s * q / 2) + pull_.weights[e] * q / 2;
        c[2] += weights_[e] * p * q;
        c[3] += weights_[e] * q * q / 4;
    }
    return c;
}

}  // namespace octafield::surface::detail
