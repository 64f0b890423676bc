#include "odeco_smoothing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "ceres_smoothing.hpp"
#include "dirichlet_costs.hpp"
#include "odeco_field.hpp"

namespace octafield::volume {
namespace {

// The axis of a frame on the constraints that is held: its twist never leaves it.
int held_axis(const BoundaryConstraints& constraints, const Quaternions& frames, Eigen::Index site) {
    int axis = 0;
    const frames::Vector3 held = constraints.axis.row(site).transpose();
    (frames::from_wxyz(frames.row(site)).conjugate() * held).cwiseAbs().maxCoeff(&axis);
    return axis;
}

// Lengths of 1, but for those that the constraints give.
Points start_lengths(const BoundaryConstraints& constraints, const Quaternions& start) {
    Points lengths = Points::Ones(start.rows(), 3);
    if (constraints.lengths.rows() == 0) return lengths;
    for (Eigen::Index v = 0; v < lengths.rows(); ++v) {
        if (constraints.kind[v] == VertexConstraint::fixed) lengths.row(v) = constraints.lengths.row(v);
        if (constraints.kind[v] == VertexConstraint::axis)
            lengths(v, held_axis(constraints, start, v)) = constraints.lengths(v, 0);
    }
    return lengths;
}

// One per axis that may be held.
using LengthManifolds = std::array<ceres::SubsetManifold, 3>;

void hold_lengths(ceres::Problem& problem, OdecoField& field, const BoundaryConstraints& constraints,
                  LengthManifolds& manifolds) {
    for (Index v = 0; v < static_cast<Index>(constraints.kind.size()); ++v) {
        double* parameters = field.parameters(v, 1);
        if (!problem.HasParameterBlock(parameters)) continue;
        if (constraints.kind[v] == VertexConstraint::fixed) problem.SetParameterBlockConstant(parameters);
        if (constraints.kind[v] == VertexConstraint::axis)
            problem.SetManifold(parameters, &manifolds[held_axis(constraints, field.quaternions(), v)]);
    }
}

void require_held(const BoundaryConstraints& constraints) {
    const auto free = [](VertexConstraint kind) { return kind == VertexConstraint::free; };
    if (std::all_of(constraints.kind.begin(), constraints.kind.end(), free))
        throw InvalidInput(
            "odeco_lengths needs constraints: where no length is held, all of them would shrink to 0; hold the "
            "boundary (aligned or fixed) or choose another representation",
            "no_constraint");
}

}  // namespace

SmoothResult smooth_odeco_lengths(const Sampling& sampling, const BoundaryConstraints& constraints,
                                  const Quaternions& start, const SmoothOptions& options, const Progress& progress) {
    require_held(constraints);
    SmoothOptions chosen = options;
    // Gauss-Newton steps are dear with six unknowns a site, and no better where singular curves still move.
    if (options.solver == SmoothSolver::automatic) chosen.solver = SmoothSolver::lbfgs;
    OdecoField field(start, start_lengths(constraints, start).array().log(), options.threads);
    Manifolds manifolds;
    LengthManifolds length_manifolds{ceres::SubsetManifold(3, {0}), ceres::SubsetManifold(3, {1}),
                                     ceres::SubsetManifold(3, {2})};
    ceres::Problem problem(problem_options(field));
    add_dirichlet_costs(problem, field, dirichlet_blocks(sampling), 1 / sampling.size);
    set_manifolds(problem, field.quaternions(), constraints, manifolds);
    hold_lengths(problem, field, constraints, length_manifolds);
    SmoothResult result = solve_with_ceres(problem, field.quaternions(), sampling, chosen, progress);
    result.lengths = field.lengths();
    return result;
}

}  // namespace octafield::volume
