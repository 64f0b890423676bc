// Newton's method with few factorizations: each serves a round of L-BFGS steps that start from its inverse. Where the
// second derivative is indefinite (near the cores of singular points far from rest), its convex part is factorized
// instead.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <utility>

#include "limited_memory.hpp"
#include "random_field.hpp"
#include "sparse_cholesky.hpp"

namespace octafield::surface::detail {

// Energy: has State (what it is a function of), Curvature {exact, convex}, and
//   hessian(state, curvature): lower triangle of the second derivative, the pattern the same on every call;
//   slope(state): .energy and .gradient;
//   turned(state, direction, length): the state after a step; rounding(): an energy too small to count.
// It lowers the energy in place and never raises it.
template <class Energy>
class NewtonDescent {
public:
    using State = typename Energy::State;
    using Curvature = typename Energy::Curvature;
    using Matrix = Eigen::SparseMatrix<double>;

    // Keeps references. `order`: elimination order of the matrix. `told` hears the energy after each step; false from
    // it stops the descent. `seed`: of the disturbance that finds the way down from saddle points.
    NewtonDescent(Energy& energy, const Eigen::VectorXi& order, State& state, std::uint64_t seed,
                  const std::function<bool(double)>& told)
        : energy_(energy),
          state_(state),
          seed_(seed),
          told_(told),
          cholesky_(energy.hessian(state, Curvature::convex), order),
          slope_(energy.slope(state)) {}

    // To a minimum beside the present state: the gradient zero to `tolerance` (gain to be expected from a step,
    // relative to the energy), no direction of negative curvature found. False where the matrix is not definite to
    // rounding, when stopped, or after so many rounds of at most steps_per_round steps.
    bool descend(double tolerance, int most_rounds = 40);

    // The state was changed from outside. False when told to stop.
    bool start_anew() {
        slope_ = energy_.slope(state_);
        stopped_ = !told_(slope_.energy);
        return !stopped_;
    }

    double energy() const { return slope_.energy; }

private:
    static constexpr int steps_per_round = 8;
    static constexpr double armijo = 1e-4, least_length = 1e-6;
    // Length of the step that leaves a saddle point, radian, of the unknown that turns most.
    static constexpr double saddle_step = 0.1;
    static constexpr int saddle_iterations = 60;

    bool factorize(Curvature curvature) { return cholesky_.factorize(energy_.hessian(state_, curvature)); }
    bool line_search(const Eigen::VectorXd& direction, double slope, LimitedMemory& memory);
    void round();
    enum class Saddle { left, stuck, none };
    Saddle leave_saddle();

    Energy& energy_;
    State& state_;
    std::uint64_t seed_;
    const std::function<bool(double)>& told_;
    SparseCholesky<double> cholesky_;
    typename Energy::Slope slope_;
    bool stopped_ = false, flat_ = false;
    double tolerance_ = 0;
};

// Backtracks from the whole step; `slope`: the energy's along it. False where nothing is gained.
template <class Energy>
bool NewtonDescent<Energy>::line_search(const Eigen::VectorXd& direction, double slope, LimitedMemory& memory) {
    for (double length = 1; length > least_length;) {
        State next = energy_.turned(state_, direction, length);
        typename Energy::Slope there = energy_.slope(next);
        const double gain = slope_.energy - there.energy;
        if (gain > 0 && gain >= -armijo * length * slope) {
            memory.add(length * direction, there.gradient - slope_.gradient);
            state_ = std::move(next);
            slope_ = std::move(there);
            stopped_ = !told_(slope_.energy);
            return true;
        }
        // The minimum of the parabola through what is known.
        const double curvature = 2 * (-gain - slope * length) / (length * length);
        const double best = curvature > 0 ? -slope / curvature : 0;
        length = std::min(length / 2, std::max(length / 10, best));
    }
    return false;
}

template <class Energy>
void NewtonDescent<Energy>::round() {
    LimitedMemory memory(steps_per_round);
    const auto solve = [&](const Eigen::VectorXd& right) { return cholesky_.solve(right); };
    for (int i = 0; i < steps_per_round && !stopped_; ++i) {
        const Eigen::VectorXd direction = -memory.apply(slope_.gradient, solve);
        const double slope = direction.dot(slope_.gradient);
        flat_ = -slope / 2 <= std::max(tolerance_ * slope_.energy, energy_.rounding());
        if (flat_ || !line_search(direction, slope, memory)) return;
    }
}

// From a point where the gradient vanishes and the second derivative is indefinite: down along (nearly) the most
// negative curvature relative to the convex matrix C. E - s C with s at the largest eigenvalue of C^-1 E (the part of E
// that C leaves out may be positive too) is negative, so power iteration with it finds the least one.
template <class Energy>
typename NewtonDescent<Energy>::Saddle NewtonDescent<Energy>::leave_saddle() {
    const Matrix exact = energy_.hessian(state_, Curvature::exact);
    if (!factorize(Curvature::convex)) return Saddle::stuck;
    const auto times = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
        return exact.selfadjointView<Eigen::Lower>() * x;
    };
    Eigen::VectorXd direction = random_vector(slope_.gradient.size(), seed_);
    double largest = 1;
    for (int i = 0; i < saddle_iterations; ++i) {
        const Eigen::VectorXd image = cholesky_.solve(times(direction));
        largest = std::max(largest, image.norm() / direction.norm());
        direction = largest * direction - image;
        direction /= direction.cwiseAbs().maxCoeff();
    }
    const double curvature = direction.dot(times(direction));
    if (!(curvature < 0)) return Saddle::none;
    if (direction.dot(slope_.gradient) > 0) direction = -direction;
    LimitedMemory memory(1);
    const bool gained = line_search(saddle_step * direction, saddle_step * saddle_step * curvature / 2, memory);
    return gained ? Saddle::left : Saddle::stuck;
}

// To a minimum beside the present field. False where the matrix is not definite to rounding, or when stopped.
template <class Energy>
bool NewtonDescent<Energy>::descend(double tolerance, int most_rounds) {
    tolerance_ = tolerance;
    for (int i = 0; i < most_rounds && !stopped_; ++i) {
        const bool exact = factorize(Curvature::exact);
        if (!exact && !factorize(Curvature::convex)) return false;
        const double before = slope_.energy;
        round();
        if (flat_ && exact) return true;
        if (stopped_) return false;
        if (slope_.energy < before && !flat_) continue;
        if (exact) return true;
        const Saddle saddle = leave_saddle();
        if (saddle != Saddle::left) return saddle == Saddle::none;
    }
    return false;
}

}  // namespace octafield::surface::detail
