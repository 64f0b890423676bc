// What the least-squares smoothers share: manifolds by constraint, solver options by size, progress, errors.
#pragma once

#include <ceres/problem.h>

#include <functional>
#include <memory>
#include <vector>

#include "frame_unknowns.hpp"
#include "octafield/arrays.hpp"
#include "octafield/volume/smooth.hpp"

namespace octafield::volume {

// Outlives the problem: one manifold per site held in part; free ones share one.
template <class Unknowns = QuaternionUnknowns>
struct Manifolds {
    typename Unknowns::FreeManifold frame;
    std::vector<std::unique_ptr<ceres::Manifold>> parts;
};

// The parameter block of a vertex is its row of `rows`; vertices in no residual are skipped.
template <class Unknowns>
void set_manifolds(ceres::Problem& problem, Rows<double, Unknowns::size>& rows, const BoundaryConstraints& constraints,
                   Manifolds<Unknowns>& manifolds) {
    for (Index v = 0; v < static_cast<Index>(constraints.kind.size()); ++v) {
        double* parameters = rows.row(v).data();
        if (!problem.HasParameterBlock(parameters)) continue;
        ConstraintKinds::visit(constraints.kind[v], constraints.of(v), [&]<class Kind>(const Kind& kind) {
            if constexpr (Kind::unknowns == 0) {
                problem.SetParameterBlockConstant(parameters);
            } else if constexpr (Kind::unknowns == 3) {
                problem.SetManifold(parameters, &manifolds.frame);
            } else {
                manifolds.parts.push_back(std::make_unique<typename Unknowns::template HeldManifold<Kind>>(kind));
                problem.SetManifold(parameters, manifolds.parts.back().get());
            }
        });
    }
}

ceres::Problem::Options problem_options(ceres::EvaluationCallback& field);

// The frames of the problem's parameters as they are.
using FramesNow = std::function<const Quaternions&()>;

// Everything of the result but the sh4 energy at its end. Ceres' cost is the objective at unit size (Sampling::size).
SmoothResult solve_with_ceres(ceres::Problem& problem, const FramesNow& frames, const Sampling& sampling,
                              const SmoothOptions& options, const Progress& progress);

}  // namespace octafield::volume
