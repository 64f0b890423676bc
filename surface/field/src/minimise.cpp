// Minimisation of the Ginzburg-Landau functional, from any start, to a local minimum.
//
// Singular points travel along curved, nearly flat valleys of E: a Newton step is good for a fraction of epsilon there,
// and its factorization costs as much as a dozen solves. So the steps come in rounds: factorize H + mu W (W: the
// weights m / eps^2) at the round's first field, with mu raised until the matrix is positive definite, then take L-BFGS
// steps that start from its inverse. E is a polynomial of degree 4 along a line, so step lengths are exact. mu = 1 is
// always enough, as H >= K - W. Near a minimum mu falls to its floor and the first step of a round is Newton's.
#include <cmath>

#include "definiteness.hpp"
#include "ginzburg_landau.hpp"
#include "limited_memory.hpp"
#include "line_search.hpp"
#include "random_field.hpp"
#include "sparse_cholesky.hpp"

namespace octafield::surface::detail {
namespace {

// Turning all directions of a component that nothing aligns by one angle does not change E: i f is a null vector of H
// at a critical point, the gradient is orthogonal to it everywhere. This keeps the factorization away from it, and the
// step keeps out of it.
constexpr double least_shift = 1e-8;
constexpr double largest_shift = 1.5;
constexpr int steps_per_round = 8;
constexpr int remembered_steps = 10;
// Curvature below -this, in units of 1 / eps^2, marks a saddle point.
constexpr double saddle_shift = 1e-6;
// Relative gain of a round from which on the next one tries Newton's method.
constexpr double newton_start = 1e-3;
// Largest length of what is added to a start.
constexpr double added_to_start = 0.1;

class Descent {
public:
    Descent(const GinzburgLandau& functional, const Eigen::VectorXi& order, Eigen::VectorXcd& values,
            const DescentOptions& options, const Progress& progress)
        : functional_(functional),
          values_(values),
          options_(options),
          progress_(progress),
          matrix_(functional.system().real_stiffness()),
          cholesky_(matrix_, FreeSystem::real_order(order)) {}

    DescentResult run();

private:
    bool flat() const { return slope_.residual <= options_.tolerance; }
    void factorize();
    double step(LimitedMemory& memory);
    bool round();
    void disturb();
    bool leave_saddle();
    void moved();

    const GinzburgLandau& functional_;
    Eigen::VectorXcd& values_;
    const DescentOptions& options_;
    const Progress& progress_;
    FreeSystem::RealMatrix matrix_;
    SparseCholesky<double> cholesky_;
    GinzburgLandau::Slope slope_;
    double shift_ = 0.25;
    bool raised_ = false;   // the last factorization needed a higher shift than tried first
    bool stopped_ = false;  // cancelled, or out of iterations
    DescentResult result_;
};

// Takes note of new values.
void Descent::moved() {
    slope_ = functional_.slope(values_);
    if (!std::isfinite(slope_.energy))
        throw SolverError("the energy of the direction field is not a number to double precision", not_definite);
    result_.energy_history.push_back(slope_.energy);
    result_.iterations = static_cast<int>(result_.energy_history.size()) - 1;
    const double fraction = static_cast<double>(result_.iterations) / std::max(1, options_.max_iterations);
    stopped_ = !report(progress_, "cross field", std::min(1.0, fraction), result_.energy_history.back()) ||
               result_.iterations >= options_.max_iterations;
}

// Factorizes H + shift W with the first shift, from shift_ upward, that makes it positive definite.
void Descent::factorize() {
    raised_ = false;
    for (;; raised_ = true, shift_ = std::min(largest_shift, std::max(4 * shift_, 4e-4))) {
        functional_.hessian(values_, shift_, matrix_);
        if (cholesky_.factorize(matrix_)) return;
        if (shift_ >= largest_shift)
            throw SolverError("the matrix of the direction field is not positive definite to rounding", not_definite);
    }
}

// One descent step; its length in units of the direction, 0 where no descent is left.
double Descent::step(LimitedMemory& memory) {
    const auto solve = [&](const Eigen::VectorXd& right) { return cholesky_.solve(right); };
    const Eigen::VectorXd direction = -memory.apply(slope_.gradient, solve);
    const Eigen::VectorXcd field = functional_.system().scatter(as_complex(direction), values_.size());
    const std::array<double, 4> energy = functional_.along(values_, field);
    if (!(energy[0] < 0)) return 0;
    const double length = lowest_along(energy);
    const Eigen::VectorXd before = slope_.gradient;
    values_ += length * field;
    moved();
    memory.add(length * direction, slope_.gradient - before);
    return length;
}

// Steps with one factorization; true when they gain no more than the tolerance.
bool Descent::round() {
    factorize();
    if (options_.disturb && result_.iterations == 0) disturb();
    LimitedMemory memory(remembered_steps);
    double first = 0;
    bool settled = false;
    for (int i = 0; i < steps_per_round && !stopped_ && !settled && !flat(); ++i) {
        const double before = slope_.energy, length = step(memory);
        if (i == 0) first = length;
        settled = before - slope_.energy <= options_.energy_tolerance / steps_per_round * std::abs(before);
    }
    if (first > 0.5) {
        shift_ = std::max(least_shift, shift_ / (raised_ ? 2 : 8));
    } else if (first < 0.25) {
        shift_ = std::min(largest_shift, 4 * shift_);
    }
    return settled || flat();
}

// A symmetric start may have multiple singular points, which stay where they are otherwise.
void Descent::disturb() {
    const FreeSystem& system = functional_.system();
    const Eigen::VectorXcd noise = as_complex(random_vector(2 * system.size(), options_.seed));
    const Eigen::VectorXd rough = as_real(system.gather(functional_.weights()).cast<Complex>().cwiseProduct(noise));
    const Eigen::VectorXd smooth = cholesky_.solve(rough);
    values_ += system.scatter(as_complex(smooth * (added_to_start / smooth.cwiseAbs().maxCoeff())), values_.size());
    slope_ = functional_.slope(values_);
}

// Where E has negative curvature, goes down along (nearly) the most negative one. False at a minimum.
bool Descent::leave_saddle() {
    shift_ = saddle_shift;
    factorize();
    if (!raised_) return false;
    const FreeSystem& system = functional_.system();
    const auto& weights = functional_.weights();
    Eigen::VectorXcd field =
        system.scatter(as_complex(random_vector(2 * system.size(), options_.seed)), values_.size());
    for (int i = 0; i < 10; ++i) {
        const Eigen::VectorXcd weighted = system.gather(Eigen::VectorXcd(weights.cast<Complex>().cwiseProduct(field)));
        field = system.scatter(as_complex(cholesky_.solve(as_real(weighted))), values_.size());
        field /= field.cwiseAbs().maxCoeff();
    }
    std::array<double, 4> energy = functional_.along(values_, field);
    if (!(energy[1] < 0)) return false;
    if (energy[0] > 0) {
        field = -field;
        energy[0] = -energy[0];
        energy[2] = -energy[2];
    }
    values_ += lowest_along(energy) * field;
    moved();
    return true;
}

DescentResult Descent::run() {
    moved();
    for (bool tried_saddle = false; !stopped_ && !result_.converged;) {
        const double before = slope_.energy;
        const bool newton = shift_ <= saddle_shift, was_flat = flat();
        const bool settled = was_flat || round();
        if (stopped_) break;
        const bool slow = before - slope_.energy <= newton_start * std::abs(before);
        if (!options_.to_minimum) {
            result_.converged = settled || slow;
        } else if (settled && (newton || was_flat)) {
            // A saddle point is left once: what gains next to nothing after that is a flat valley.
            const bool proven = newton && !was_flat && !raised_;
            result_.converged = proven || tried_saddle || !leave_saddle();
            tried_saddle = true;
        } else if (settled || slow) {
            shift_ = saddle_shift;  // the next factorization also tells a minimum from a saddle point
        }
    }
    result_.residual = slope_.residual;
    result_.converged = result_.converged || flat();
    return result_;
}

}  // namespace

DescentResult minimise(const GinzburgLandau& functional, const Eigen::VectorXi& order, Eigen::VectorXcd& values,
                       const DescentOptions& options, const Progress& progress) {
    return Descent(functional, order, values, options, progress).run();
}

}  // namespace octafield::surface::detail
