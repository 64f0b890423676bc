// What the least-squares smoothers share: manifolds by constraint, solver options by size, progress, errors.
#pragma once

#include <ceres/problem.h>

#include <memory>
#include <vector>

#include "frame_manifolds.hpp"
#include "octafield/volume/smooth.hpp"

namespace octafield::volume {

// Outlives the problem: one manifold per site held in part; free ones share one.
struct Manifolds {
    FrameManifold frame;
    std::vector<std::unique_ptr<ceres::Manifold>> parts;
};

// The parameter block of a vertex is its row of `quaternions`; vertices in no residual are skipped.
void set_manifolds(ceres::Problem& problem, Quaternions& quaternions, const BoundaryConstraints& constraints,
                   Manifolds& manifolds);

ceres::Problem::Options problem_options(ceres::EvaluationCallback& field);

// Everything of the result but the sh4 energy at its end. `quaternions` are the problem's parameters; Ceres' cost is the
// objective at unit size (Sampling::size).
SmoothResult solve_with_ceres(ceres::Problem& problem, const Quaternions& quaternions, const Sampling& sampling,
                              const SmoothOptions& options, const Progress& progress);

}  // namespace octafield::volume
