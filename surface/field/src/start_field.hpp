// Fields to start from: harmonic where something is aligned, the smoothest eigenvector elsewhere.
#pragma once

#include <cstdint>
#include <vector>

#include "components.hpp"
#include "diffusion_solver.hpp"
#include "octafield/progress.hpp"
#include "pull.hpp"

namespace octafield::surface::detail {

// What every method works with. (E) arrays by edge, (n) arrays by unknown.
struct Problem {
    const std::vector<CornerLink>& links;
    const FreeSystem& system;
    const Eigen::VectorXd& masses;
    const Components& components;
    const Eigen::VectorXcd& held;  // (E), the values of the held edges, zero elsewhere
    const Pull& pull;
};

// Scales every value to length 1; values of length 0 become `instead`.
void normalise(Eigen::VectorXcd& values, const Eigen::VectorXcd& instead);

// Values with |f| = 1. Anchored components get the minimiser of 1/2 int |grad f|^2 + pull (harmonic if there is none);
// the others the eigenvector of K f = lambda M f with the smallest lambda (Knoeppel et al. 2013), by inverse iteration
// from a random field. Leaves the solver factorized for next to no D but the pull's weights. False from progress stops
// the iteration.
Eigen::VectorXcd start_field(const Problem& problem, DiffusionSolver& solver, std::uint64_t seed,
                             const Progress& progress);

}  // namespace octafield::surface::detail
