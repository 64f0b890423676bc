// Newton's method with few factorizations: each serves a round of L-BFGS steps that start from its inverse. Where the
// second derivative is indefinite (near the cores of singular points far from rest), its convex part is factorized
// instead.
#include "angle_descent.hpp"

#include <algorithm>
#include <cmath>

#include "angle_energy.hpp"
#include "core_moves.hpp"
#include "limited_memory.hpp"
#include "random_field.hpp"
#include "sparse_cholesky.hpp"

namespace octafield::surface::detail {
namespace {

constexpr int most_rounds = 40, steps_per_round = 8, most_moves = 20;
constexpr double energy_tolerance = 1e-10;  // gain to be expected from a step, relative to the energy
constexpr double armijo = 1e-4, least_length = 1e-6;
// Length of the step that leaves a saddle point, radian, of the edge that turns most.
constexpr double saddle_step = 0.1;
constexpr int saddle_iterations = 60;

class AngleDescent {
public:
    AngleDescent(const Problem& problem, const Eigen::VectorXi& order, Eigen::VectorXcd& values, std::uint64_t seed,
                 const std::function<bool(double)>& told)
        : problem_(problem),
          energy_(problem),
          values_(values),
          seed_(seed),
          told_(told),
          cholesky_(energy_.hessian(values, AngleEnergy::Curvature::convex), order),
          slope_(energy_.slope(values)) {}

    bool run();

private:
    bool descend(double tolerance);
    using Curvature = AngleEnergy::Curvature;
    bool factorize(Curvature curvature) { return cholesky_.factorize(energy_.hessian(values_, curvature)); }
    bool line_search(const Eigen::VectorXd& direction, double slope, LimitedMemory& memory);
    void round();
    enum class Saddle { left, stuck, none };
    Saddle leave_saddle();

    const Problem& problem_;
    AngleEnergy energy_;
    Eigen::VectorXcd& values_;
    std::uint64_t seed_;
    const std::function<bool(double)>& told_;
    SparseCholesky<double> cholesky_;
    AngleEnergy::Slope slope_;
    bool stopped_ = false, flat_ = false;
    double tolerance_ = energy_tolerance;
};

// Backtracks from the whole step; `slope`: the energy's along it. False where nothing is gained.
bool AngleDescent::line_search(const Eigen::VectorXd& direction, double slope, LimitedMemory& memory) {
    for (double length = 1; length > least_length;) {
        Eigen::VectorXcd next = energy_.turned(values_, direction, length);
        AngleEnergy::Slope there = energy_.slope(next);
        const double gain = slope_.energy - there.energy;
        if (gain > 0 && gain >= -armijo * length * slope) {
            memory.add(length * direction, there.gradient - slope_.gradient);
            values_ = std::move(next);
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

void AngleDescent::round() {
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
AngleDescent::Saddle AngleDescent::leave_saddle() {
    const FreeSystem::RealMatrix exact = energy_.hessian(values_, Curvature::exact);
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
bool AngleDescent::descend(double tolerance) {
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

bool AngleDescent::run() {
    CoreMoves cores(problem_);
    bool settled = descend(energy_tolerance);
    for (int i = 0; i < most_moves && settled && cores.improve(values_) > 0; ++i) {
        slope_ = energy_.slope(values_);
        stopped_ = !told_(slope_.energy);
        settled = !stopped_ && descend(energy_tolerance);
    }
    return settled;
}

}  // namespace

bool descend_angles(const Problem& problem, const Eigen::VectorXi& order, Eigen::VectorXcd& values, std::uint64_t seed,
                    const std::function<bool(double energy)>& told) {
    return AngleDescent(problem, order, values, seed, told).run();
}

}  // namespace octafield::surface::detail
