// One iteration: f <- argmin 1/2 int |grad f|^2 + pull + 1/2 sum_e s_e |f - f_old|^2, an implicit Euler step of the
// heat flow with the time step t_e = m_e / s_e; then f <- f / |f|. Diffusion over t joins and moves singular points
// over distances of sqrt(t); the projection makes the rest of the field long again. The time step falls in a few levels
// from the size of the component to that of the triangles; every level has one factorization.
#include "mbo.hpp"

#include <algorithm>
#include <cmath>

#include "random_field.hpp"

namespace octafield::surface::detail {
namespace {

// Diffusion lengths sqrt(t) of the first level, in sizes of the component, and of the last, in local edge lengths.
constexpr double first_length = 0.25, last_length = 1.5;
constexpr double most_fall = 25;  // of the time step, from one level to the next
constexpr int first_iterations = 16, iterations_per_level = 10;
// Relative change of the energy below which a level is done.
constexpr double least_change = 1e-4;

// A smooth random field of this largest length is added at first: multiple singular points, which symmetric surfaces
// start with, stay where they are without.
constexpr double size_of_noise = 0.1;

// s_e of every level.
class Levels {
public:
    explicit Levels(const Problem& problem) : first_(problem.masses.size()), last_(problem.masses.size()) {
        double fall = 1;
        for (Eigen::Index e = 0; e < first_.size(); ++e) {
            const double size = first_length * problem.components.sizes[problem.components.of_edge[e]];
            const double mass = problem.masses[e];
            // Equilateral triangles of edge length h have m_e = h^2 / (2 sqrt(3)).
            const double shortest = std::min(last_length * last_length * 2 * std::sqrt(3.0) * mass, size * size);
            first_[e] = mass / (size * size);
            last_[e] = mass / shortest;
            fall = std::max(fall, last_[e] / first_[e]);
        }
        count_ = 1 + static_cast<int>(std::ceil(std::log(fall) / std::log(most_fall) - 1e-9));
    }
    int count() const { return count_; }
    Eigen::VectorXd weights(int level) const {
        const double part = count_ == 1 ? 1 : static_cast<double>(level) / (count_ - 1);
        return first_.array().pow(1 - part) * last_.array().pow(part);
    }

private:
    Eigen::VectorXd first_, last_;
    int count_;
};

void disturb(const FreeSystem& system, DiffusionSolver& solver, const Eigen::VectorXd& weights, std::uint64_t seed,
             Eigen::VectorXcd& values) {
    const Eigen::VectorXcd noise = as_complex(random_vector(2 * system.size(), seed));
    Eigen::VectorXcd smooth = solver.solve(system.gather(weights).cast<Complex>().cwiseProduct(noise));
    smooth *= size_of_noise / smooth.cwiseAbs().maxCoeff();
    const Eigen::VectorXcd before = values;
    values += system.scatter(smooth, values.size());
    normalise(values, before);
}

}  // namespace

DiffusionResult diffuse_and_project(const Problem& problem, DiffusionSolver& solver, Eigen::VectorXcd& values,
                                    int max_iterations, std::uint64_t seed, const Progress& progress) {
    const FreeSystem& system = problem.system;
    const auto energy = [&] { return dirichlet_energy(problem.links, values) + problem.pull.energy(values); };
    const Eigen::VectorXcd given = problem.pull.targets - apply_stiffness(problem.links, problem.held);
    const Levels levels(problem);
    DiffusionResult result;
    result.energy_history.push_back(energy());
    for (int level = 0; level < levels.count(); ++level) {
        if (result.iterations >= max_iterations) return result;
        const Eigen::VectorXd weights = levels.weights(level), diagonal = weights + problem.pull.weights;
        solver.factorize(system.gather(diagonal));
        if (level == 0) disturb(system, solver, weights, seed, values);
        const int most = level == 0 ? first_iterations : iterations_per_level;
        for (int i = 0; i < most && result.iterations < max_iterations; ++i) {
            const Eigen::VectorXcd before = values;
            const Eigen::VectorXcd right = given + weights.cast<Complex>().cwiseProduct(values);
            values = problem.held + system.scatter(solver.solve(system.gather(right)), values.size());
            normalise(values, before);
            ++result.iterations;
            const double last = result.energy_history.back(), now = energy();
            result.energy_history.push_back(now);
            const double fraction = (level + (i + 1.0) / most) / levels.count();
            if (!report(progress, "cross field", fraction, now)) return result;
            if (std::abs(now - last) <= least_change * std::abs(last)) break;
        }
    }
    result.converged = true;
    return result;
}

}  // namespace octafield::surface::detail
