#include "odeco_smoothing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "ceres_smoothing.hpp"
#include "dirichlet_costs.hpp"
#include "odeco_field.hpp"

namespace octafield::volume {
namespace {

// For each axis of a frame on the constraints: the column of the constraints' lengths that holds its length, or -1.
std::array<int, 3> length_columns(const BoundaryConstraints& constraints, const Quaternions& frames, Index site) {
    std::array<int, 3> columns = {-1, -1, -1};
    ConstraintKinds::visit(constraints.kind[site], constraints.of(site), [&](const auto& kind) {
        columns = kind.length_columns(frames::from_wxyz(frames.row(site)));
    });
    return columns;
}

// Lengths of 1, but for those that the constraints give.
Points start_lengths(const BoundaryConstraints& constraints, const Quaternions& start) {
    Points lengths = Points::Ones(start.rows(), 3);
    if (constraints.lengths.rows() == 0) return lengths;
    for (Index v = 0; v < static_cast<Index>(lengths.rows()); ++v) {
        const std::array<int, 3> columns = length_columns(constraints, start, v);
        for (int axis = 0; axis < 3; ++axis)
            if (columns[axis] >= 0) lengths(v, axis) = constraints.lengths(v, columns[axis]);
    }
    return lengths;
}

// By the axes that are held: bit k for axis k. None for no axis and for all three.
using LengthManifolds = std::array<std::unique_ptr<ceres::SubsetManifold>, 8>;

void hold_lengths(ceres::Problem& problem, OdecoField& field, const BoundaryConstraints& constraints,
                  LengthManifolds& manifolds) {
    for (Index v = 0; v < static_cast<Index>(constraints.kind.size()); ++v) {
        double* parameters = field.parameters(v, 1);
        if (!problem.HasParameterBlock(parameters)) continue;
        const std::array<int, 3> columns = length_columns(constraints, field.quaternions(), v);
        std::vector<int> held;
        unsigned which = 0;
        for (int axis = 0; axis < 3; ++axis)
            if (columns[axis] >= 0) {
                held.push_back(axis);
                which |= 1u << axis;
            }
        if (held.empty()) continue;
        if (held.size() == 3) {
            problem.SetParameterBlockConstant(parameters);
            continue;
        }
        auto& manifold = manifolds[which];
        if (!manifold) manifold = std::make_unique<ceres::SubsetManifold>(3, held);
        problem.SetManifold(parameters, manifold.get());
    }
}

void require_held(const BoundaryConstraints& constraints) {
    const auto none = [](VertexConstraint kind) { return info(kind).held_lengths == 0; };
    if (std::all_of(constraints.kind.begin(), constraints.kind.end(), none))
        throw InvalidInput(
            "odeco_lengths needs constraints: where no length is held, all of them would shrink to 0; hold the "
            "boundary (aligned or fixed) or choose another representation",
            "no_constraint");
}

}  // namespace

SmoothResult smooth_odeco_lengths(const Sampling& sampling, const BoundaryConstraints& constraints,
                                  const Quaternions& start, const SmoothOptions& options, const Progress& progress) {
    require_held(constraints);
    OdecoField field(start, start_lengths(constraints, start).array().log(), options.threads);
    Manifolds<> manifolds;
    LengthManifolds length_manifolds;
    ceres::Problem problem(problem_options(field));
    add_dirichlet_costs(problem, field, dirichlet_blocks(sampling), 1 / sampling.size);
    set_manifolds(problem, field.quaternions(), constraints, manifolds);
    hold_lengths(problem, field, constraints, length_manifolds);
    SmoothResult result = solve_with_ceres(
        problem, [&]() -> const Quaternions& { return field.quaternions(); }, sampling, options, progress);
    result.lengths = field.lengths();
    return result;
}

}  // namespace octafield::volume
