// Smoothing in a metric on frames: the sum of squares of dirichlet_blocks.hpp with differences of frames for those of
// vectors.
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "ceres_smoothing.hpp"
#include "difference_field.hpp"
#include "dirichlet_blocks.hpp"

namespace octafield::volume {

// A tet kept whole has its differences taken from its first vertex: to second order they are coordinates of the frames
// at its corners.
template <DifferenceScheme Scheme>
void add_difference_costs(ceres::Problem& problem, DifferenceField<Scheme>& field, const DirichletBlocks& blocks,
                          double scale) {
    using Cost = DifferenceCost<Scheme>;
    for (const auto& edge : blocks.edges) {
        typename Cost::Coefficients weight(1, 1);
        weight << std::sqrt(edge.weight * scale);
        problem.AddResidualBlock(new Cost(field, field.add_pair(edge.i, edge.j), weight), nullptr,
                                 field.parameters(edge.i), field.parameters(edge.j));
    }
    for (const auto& tet : blocks.tets) {
        const std::size_t first = field.pairs().size();
        std::vector<double*> parameters{field.parameters(tet.vertices[0])};
        for (int k = 1; k < 4; ++k) {
            field.add_pair(tet.vertices[0], tet.vertices[k]);
            parameters.push_back(field.parameters(tet.vertices[k]));
        }
        problem.AddResidualBlock(new Cost(field, first, std::sqrt(scale) * tet.gradient.rightCols<3>()), nullptr,
                                 parameters);
    }
}

template <DifferenceScheme Scheme>
class MetricProblem {
public:
    MetricProblem(const Sampling& sampling, const BoundaryConstraints& constraints, const Quaternions& start,
                  Scheme scheme, const SmoothOptions& options)
        : sampling_(sampling), field(start, std::move(scheme), options.threads), problem_(problem_options(field)) {
        // The energy grows like a length: solved at unit size, so that no tolerance depends on the input's unit.
        add_difference_costs(problem_, field, dirichlet_blocks(sampling), 1 / sampling.size);
        set_manifolds(problem_, field.rows(), constraints, manifolds_);
    }

    SmoothResult solve(const SmoothOptions& options, const Progress& progress) {
        return solve_with_ceres(
            problem_, [this]() -> const Quaternions& { return field.quaternions(); }, sampling_, options, progress);
    }

private:
    const Sampling& sampling_;
    Manifolds<typename UnknownsOf<Scheme>::type> manifolds_;

public:
    DifferenceField<Scheme> field;

private:
    ceres::Problem problem_;
};

// A Minimise of scheme_table.hpp.
template <DifferenceScheme Scheme>
SmoothResult smooth_metric(const Sampling& sampling, const BoundaryConstraints& constraints, const Quaternions& start,
                           const SmoothOptions& options, const Progress& progress) {
    return MetricProblem<Scheme>(sampling, constraints, start, Scheme::made(options), options).solve(options, progress);
}

}  // namespace octafield::volume
