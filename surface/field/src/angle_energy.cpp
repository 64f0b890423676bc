#include "angle_energy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace octafield::surface::detail {
namespace {

// Added to the second derivative, in units of mass over the area of the component: far below its other eigenvalues.
constexpr double shift_of_angles = 1e-6;
// Of a link's own weight, what the convex second derivative keeps at least where it changes anything.
constexpr double least_part = 0.1;

// Whether sum_k w_k (x_k - x_k+1)^2 over the corners of a triangle is never negative.
bool is_convex(const std::array<double, 3>& w) {
    return w[0] + w[1] + w[2] >= 0 && w[0] * w[1] + w[1] * w[2] + w[2] * w[0] >= 0;
}

}  // namespace

AngleEnergy::AngleEnergy(const Problem& problem) : problem_(problem), number_(problem.masses.size(), -1) {
    const FreeSystem& system = problem.system;
    const FreeSystem::Matrix& stiffness = system.stiffness();
    shift_.resize(system.size());
    for (Index i = 0; i < system.size(); ++i) {
        const Index e = system.edges()[i];
        number_[e] = i;
        shift_[i] = shift_of_angles * problem.masses[e] / problem.components.areas[problem.components.of_edge[e]];
    }
    matrix_.resize(system.size(), system.size());
    matrix_.resizeNonZeros(stiffness.nonZeros());
    std::copy_n(stiffness.outerIndexPtr(), system.size() + 1, matrix_.outerIndexPtr());
    std::copy_n(stiffness.innerIndexPtr(), stiffness.nonZeros(), matrix_.innerIndexPtr());
    const double unit = std::numeric_limits<double>::epsilon();
    rounding_ = unit * unit * (system.diagonal() + system.gather(problem.pull.weights)).sum();
}

AngleEnergy::Slope AngleEnergy::slope(const Eigen::VectorXcd& values) const {
    Eigen::VectorXcd force = apply_stiffness(problem_.links, values);
    const double energy = values.dot(force).real() / 2 + problem_.pull.energy(values);
    force -= problem_.pull.targets;
    Slope slope{energy, Eigen::VectorXd(problem_.system.size())};
    for (Index i = 0; i < problem_.system.size(); ++i) {
        const Index e = problem_.system.edges()[i];
        slope.gradient[i] = (std::conj(values[e]) * force[e]).imag();
    }
    return slope;
}

// weight / 2 (x_i - x_j)^2; -1: a held edge, x = 0.
void AngleEnergy::add(Index i, Index j, double weight) {
    double* const entries = matrix_.valuePtr();
    const int* const columns = matrix_.outerIndexPtr();
    if (i >= 0) entries[columns[i]] += weight;
    if (j >= 0) entries[columns[j]] += weight;
    if (i < 0 || j < 0) return;
    const auto [column, row] = std::minmax(i, j);
    const int* const rows = matrix_.innerIndexPtr();
    const int* const place = std::lower_bound(rows + columns[column], rows + columns[column + 1], row);
    entries[place - rows] -= weight;
}

const FreeSystem::RealMatrix& AngleEnergy::hessian(const Eigen::VectorXcd& values, Curvature curvature) {
    std::fill_n(matrix_.valuePtr(), matrix_.nonZeros(), 0.0);
    const bool convex = curvature == Curvature::convex;
    for (std::size_t t = 0; t < problem_.links.size() / 3; ++t) {
        std::array<double, 3> weights;
        for (std::size_t k = 0; k < 3; ++k) {
            const CornerLink& link = problem_.links[3 * t + k];
            const Complex first = link.first_sign * values[link.first], second = link.second_turn * values[link.second];
            weights[k] = link.weight * (std::conj(first) * second).real();
        }
        if (convex && !is_convex(weights))
            for (std::size_t k = 0; k < 3; ++k)
                weights[k] = std::max(weights[k], least_part * std::abs(problem_.links[3 * t + k].weight));
        for (std::size_t k = 0; k < 3; ++k) {
            const CornerLink& link = problem_.links[3 * t + k];
            add(number_[link.first], number_[link.second], weights[k]);
        }
    }
    for (Index i = 0; i < problem_.system.size(); ++i) {
        const Index e = problem_.system.edges()[i];
        const double pull = (std::conj(problem_.pull.targets[e]) * values[e]).real();
        matrix_.valuePtr()[matrix_.outerIndexPtr()[i]] += shift_[i] + (convex ? std::max(pull, 0.0) : pull);
    }
    return matrix_;
}

Eigen::VectorXcd AngleEnergy::turned(const Eigen::VectorXcd& values, const Eigen::VectorXd& angles,
                                     double length) const {
    Eigen::VectorXcd result = values;
    for (Index i = 0; i < problem_.system.size(); ++i) {
        Complex& value = result[problem_.system.edges()[i]];
        value *= std::polar(1.0, length * angles[i]);
        value /= std::abs(value);
    }
    return result;
}

}  // namespace octafield::surface::detail
