#include "start_field.hpp"

#include <algorithm>
#include <limits>

#include "inverse_iteration.hpp"
#include "random_field.hpp"

namespace octafield::surface::detail {
namespace {

// Makes K definite where a parallel field exists (flat torus), far below any other eigenvalue; in units of 1 over the
// area of the component.
constexpr double eigen_shift = 1e-6;
constexpr int most_iterations = 100;
// Relative fall of the eigenvalue estimate per iteration at which the eigenvector is good enough.
constexpr double eigen_tolerance = 1e-4;

// Scales each component's values to unit W-norm; returns the norms before.
Eigen::ArrayXd scale_components(Eigen::VectorXcd& values, const Eigen::VectorXd& weights,
                                const Components& components) {
    Eigen::ArrayXd norms = Eigen::ArrayXd::Zero(components.size());
    for (Eigen::Index e = 0; e < values.size(); ++e) norms[components.of_edge[e]] += weights[e] * std::norm(values[e]);
    norms = norms.sqrt();
    for (Eigen::Index e = 0; e < values.size(); ++e)
        if (norms[components.of_edge[e]] > 0) values[e] /= norms[components.of_edge[e]];
    return norms;
}

// The masses of components that are not anchored, each with sum 1; zero on the others.
Eigen::VectorXd floating_weights(const Eigen::VectorXd& masses, const Components& components) {
    Eigen::VectorXd weights = Eigen::VectorXd::Zero(masses.size());
    for (Eigen::Index e = 0; e < masses.size(); ++e)
        if (!components.anchored[components.of_edge[e]])
            weights[e] = masses[e] / components.areas[components.of_edge[e]];
    return weights;
}

// Inverse iteration, on all components with weights at once.
Eigen::VectorXcd smoothest_eigenvector(DiffusionSolver& solver, const FreeSystem& system,
                                       const Eigen::VectorXd& weights, const Components& components, std::uint64_t seed,
                                       const Progress& progress) {
    Eigen::VectorXcd values = system.scatter(as_complex(random_vector(2 * system.size(), seed)), weights.size());
    const auto solve = [&](const Eigen::VectorXcd& given) -> Eigen::VectorXcd {
        const Eigen::VectorXcd weighted = weights.cast<Complex>().cwiseProduct(given);
        return system.scatter(solver.solve(system.gather(weighted)), weights.size());
    };
    const auto scale = [&](Eigen::VectorXcd& given) { return scale_components(given, weights, components); };
    const auto go_on = [&] { return report(progress, "cross field", 0, std::numeric_limits<double>::quiet_NaN()); };
    bool settled = false;
    inverse_iteration(values, solve, scale, most_iterations, eigen_tolerance, go_on, settled);
    for (Eigen::Index e = 0; e < values.size(); ++e)
        if (weights[e] == 0) values[e] = 0;
    return values;
}

}  // namespace

void normalise(Eigen::VectorXcd& values, const Eigen::VectorXcd& instead) {
    for (Eigen::Index e = 0; e < values.size(); ++e) {
        const double length = std::abs(values[e]);
        values[e] = length > 0 ? values[e] / length : instead[e];
    }
}

Eigen::VectorXcd start_field(const Problem& problem, DiffusionSolver& solver, std::uint64_t seed,
                             const Progress& progress) {
    const FreeSystem& system = problem.system;
    const Eigen::Index edges = problem.masses.size();
    const Eigen::VectorXd floating = floating_weights(problem.masses, problem.components);
    const Eigen::VectorXd shifts = eigen_shift * floating + problem.pull.weights;
    solver.factorize(system.gather(shifts));
    const Eigen::VectorXcd right = problem.pull.targets - apply_stiffness(problem.links, problem.held);
    Eigen::VectorXcd values = problem.held + system.scatter(solver.solve(system.gather(right)), edges);
    if (floating.maxCoeff() > 0)
        values += smoothest_eigenvector(solver, system, floating, problem.components, seed, progress);
    normalise(values, Eigen::VectorXcd::Ones(edges));
    return values;
}

}  // namespace octafield::surface::detail
