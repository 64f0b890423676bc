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
constexpr double smallest_shift = 1e-8;
constexpr double largest_shift = 1.5;
constexpr int steps_per_round = 8;
constexpr int remembered_steps = 10;
// Curvature below -this, in units of 1 / eps^2, marks a saddle point.
constexpr double saddle_shift = 1e-6;

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
    void round();
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

void Descent::round() {
    factorize();
    LimitedMemory memory(remembered_steps);
    const double first = step(memory);
    for (int i = 1; i < steps_per_round && !stopped_ && !flat(); ++i)
        if (step(memory) == 0) break;
    if (first > 0.5) {
        shift_ = std::max(smallest_shift, shift_ / (raised_ ? 2 : 8));
    } else if (first < 0.25) {
        shift_ = std::min(largest_shift, 4 * shift_);
    }
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
    // A round that gains little ends the descent, unless it sat at a saddle point that has not been tried yet.
    for (bool tried_saddle = false; !stopped_;) {
        const double before = slope_.energy;
        if (!flat()) round();
        if (stopped_) break;
        const bool settled = flat() || before - slope_.energy <= options_.energy_tolerance * std::abs(before);
        result_.converged = settled && (tried_saddle || !leave_saddle());
        if (result_.converged) break;
        tried_saddle = settled;
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
