// Diffusion and projection in turn (Merriman, Bence, Osher; for cross fields Viertel and Osting 2019).
#pragma once

#include "start_field.hpp"

namespace octafield::surface::detail {

struct DiffusionResult {
    int iterations = 0;
    bool converged = false;
    std::vector<double> energy_history;  // 1/2 int |grad f|^2 and the pull, at the start and after each iteration
};

// Improves `values`, |f| = 1, in place. `seed`: of a small disturbance of the start.
DiffusionResult diffuse_and_project(const Problem& problem, DiffusionSolver& solver, Eigen::VectorXcd& values,
                                    int max_iterations, std::uint64_t seed, const Progress& progress);

}  // namespace octafield::surface::detail
