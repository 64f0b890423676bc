#include "start_field.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "random_field.hpp"
#include "sparse_cholesky.hpp"

namespace octafield::surface::detail {
namespace {

// Makes K definite where a parallel field exists (flat torus), far below any other eigenvalue; in units of 1 over the
// area of the component.
constexpr double eigen_shift = 1e-6;
constexpr int most_iterations = 100;
// Relative fall of the eigenvalue estimate per iteration at which the eigenvector is good enough.
constexpr double eigen_tolerance = 1e-4;

Index root_of(std::vector<Index>& parent, Index e) {
    while (parent[e] != e) e = parent[e] = parent[parent[e]];
    return e;
}

// Scales each component's values to unit W-norm; returns the norms before.
Eigen::VectorXd normalise(Eigen::VectorXcd& values, const Eigen::VectorXd& weights,
                          const std::vector<Index>& component) {
    Eigen::VectorXd norms = Eigen::VectorXd::Zero(1 + *std::max_element(component.begin(), component.end()));
    for (Eigen::Index e = 0; e < values.size(); ++e) norms[component[e]] += weights[e] * std::norm(values[e]);
    norms = norms.cwiseSqrt();
    for (Eigen::Index e = 0; e < values.size(); ++e)
        if (norms[component[e]] > 0) values[e] /= norms[component[e]];
    return norms;
}

// (K + eigen_shift W)^-1 on the free unknowns.
class LinearSolver {
public:
    LinearSolver(const FreeSystem& system, const Eigen::VectorXd& weights)
        : system_(system), edges_(weights.size()), cholesky_(system.stiffness(), system.elimination_order()) {
        FreeSystem::Matrix matrix = system.stiffness();
        for (Index i = 0; i < system.size(); ++i) {
            const double shift = eigen_shift * weights[system.edges()[i]];
            FreeSystem::add_to_diagonal(matrix, i, shift, 0, shift);
        }
        if (!cholesky_.factorize(matrix))
            throw SolverError(
                "the smoothness matrix of the direction field is not positive definite to rounding; "
                "remesh the surface, its triangles are too thin");
    }
    Eigen::VectorXcd solve(const Eigen::VectorXcd& right) const {
        return system_.scatter(cholesky_.solve(system_.gather(right)), edges_);
    }

private:
    const FreeSystem& system_;
    Eigen::Index edges_;
    mutable SparseCholesky cholesky_;
};

// The masses of components that are not anchored, each with sum 1; zero on the others.
Eigen::VectorXd floating_weights(const Eigen::VectorXd& masses, const std::vector<Index>& component,
                                 const std::vector<bool>& anchored) {
    Eigen::VectorXd area = Eigen::VectorXd::Zero(masses.size()), weights = area;
    for (Eigen::Index e = 0; e < masses.size(); ++e) area[component[e]] += masses[e];
    for (Eigen::Index e = 0; e < masses.size(); ++e)
        if (!anchored[component[e]]) weights[e] = masses[e] / area[component[e]];
    return weights;
}

// Inverse iteration, on all components with weights at once.
Eigen::VectorXcd smoothest_eigenvector(const LinearSolver& solver, const FreeSystem& system,
                                       const Eigen::VectorXd& weights, const std::vector<Index>& component,
                                       std::uint64_t seed, const Progress& progress) {
    Eigen::VectorXcd values = system.scatter(random_vector(2 * system.size(), seed), weights.size());
    Eigen::ArrayXd growth = normalise(values, weights, component);
    for (int i = 0; i < most_iterations; ++i) {
        if (!report(progress, "cross field", 0, std::numeric_limits<double>::quiet_NaN())) break;
        values = solver.solve(weights.asDiagonal() * values);
        const Eigen::ArrayXd before = growth;
        growth = normalise(values, weights, component);
        if (i > 0 && ((growth - before).abs() <= eigen_tolerance * growth).all()) break;
    }
    for (Eigen::Index e = 0; e < values.size(); ++e)
        if (weights[e] == 0) values[e] = 0;
    return values;
}

}  // namespace

std::vector<Index> edge_components(const std::vector<CornerLink>& links, Eigen::Index edges) {
    std::vector<Index> parent(edges);
    std::iota(parent.begin(), parent.end(), 0);
    for (const CornerLink& link : links) {
        const Index a = root_of(parent, link.first), b = root_of(parent, link.second);
        parent[std::max(a, b)] = std::min(a, b);
    }
    std::vector<Index> component(edges);
    Index count = 0;
    for (Index e = 0; e < edges; ++e) component[e] = parent[e] == e ? count++ : component[root_of(parent, e)];
    return component;
}

Eigen::VectorXcd start_field(const std::vector<CornerLink>& links, const FreeSystem& system,
                             const Eigen::VectorXd& masses, const std::vector<bool>& is_held,
                             const Eigen::VectorXcd& held, std::uint64_t seed, const Progress& progress) {
    const Eigen::Index edges = masses.size();
    const std::vector<Index> component = edge_components(links, edges);
    std::vector<bool> anchored(edges, false);  // by component
    Eigen::VectorXcd values = Eigen::VectorXcd::Zero(edges);
    for (Eigen::Index e = 0; e < edges; ++e) {
        if (!is_held[e]) continue;
        anchored[component[e]] = true;
        values[e] = held[e];
    }
    if (system.size() > 0) {
        const Eigen::VectorXd floating = floating_weights(masses, component, anchored);
        const LinearSolver solver(system, floating);
        values -= solver.solve(apply_stiffness(links, values));
        if (floating.maxCoeff() > 0)
            values += smoothest_eigenvector(solver, system, floating, component, seed, progress);
    }
    for (Eigen::Index e = 0; e < edges; ++e) {
        const double length = std::abs(values[e]);
        values[e] = length > 0 ? values[e] / length : Complex(1);
    }
    return values;
}

}  // namespace octafield::surface::detail
