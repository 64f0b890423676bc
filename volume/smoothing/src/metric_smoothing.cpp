#include "metric_smoothing.hpp"

#include <cmath>

#include "ceres_smoothing.hpp"
#include "difference_field.hpp"
#include "dirichlet_blocks.hpp"

namespace octafield::volume {
namespace {

// A tet kept whole has its differences taken from its first vertex: to second order they are coordinates of the frames
// at its corners.
template <class Scheme>
void add_costs(ceres::Problem& problem, DifferenceField<Scheme>& field, const DirichletBlocks& blocks, double scale) {
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

template <class Scheme>
class MetricProblem {
public:
    MetricProblem(const Sampling& sampling, const BoundaryConstraints& constraints, const Quaternions& start,
                  Scheme scheme, const SmoothOptions& options)
        : sampling_(sampling),
          field(start, std::move(scheme), options.threads),
          problem_(problem_options(field)) {
        // The energy grows like a length: solved at unit size, so that no tolerance depends on the input's unit.
        add_costs(problem_, field, dirichlet_blocks(sampling), 1 / sampling.size);
        set_manifolds(problem_, field.quaternions(), constraints, manifolds_);
    }

    SmoothResult solve(const SmoothOptions& options, const Progress& progress) {
        return solve_with_ceres(problem_, field.quaternions(), sampling_, options, progress);
    }

private:
    const Sampling& sampling_;
    Manifolds manifolds_;

public:
    DifferenceField<Scheme> field;

private:
    ceres::Problem problem_;
};

// The metric is taken at the field that each round starts from. Its fixed points are not stationary in any energy: what
// ends the rounds is that one lowers its own energy by less than the tolerance.
SmoothResult smooth_frozen(const Sampling& sampling, const BoundaryConstraints& constraints, const Quaternions& start,
                           const SmoothOptions& options, const Progress& progress) {
    constexpr int steps_per_round = 4;
    MetricProblem<FrozenScheme> problem(sampling, constraints, start, {}, options);
    auto& field = problem.field;
    SmoothResult result;
    result.frames = start;
    SmoothOptions round = options;
    for (;;) {
        field.scheme.metrics.resize(field.pairs().size());
        parallel_for(static_cast<std::int64_t>(field.pairs().size()), options.threads, [&](std::int64_t k) {
            field.scheme.metrics[k] =
                FrozenScheme::metric(field.frame(field.pairs()[k].i), field.frame(field.pairs()[k].j));
        });
        round.max_iterations = std::min(steps_per_round, options.max_iterations - result.iterations);
        const SmoothResult step = problem.solve(round, progress);
        // Objectives of a metric re-evaluated: that of the last field is only known if it starts one more round.
        result.objective = step.objective_history.front();
        result.objective_history.push_back(result.objective);
        result.energy_history.push_back(step.energy_history.front());
        result.message = step.message;
        const double gain = result.objective - step.objective;
        result.converged =
            round.max_iterations > 0 && step.message != "cancelled" && gain <= options.tolerance * result.objective;
        if (step.message == "cancelled" || result.converged || round.max_iterations == 0) return result;
        result.frames = step.frames;
        result.iterations += std::max(1, step.iterations);
    }
}

}  // namespace

SmoothResult smooth_metric(const Sampling& sampling, const BoundaryConstraints& constraints, const Quaternions& start,
                           const SmoothOptions& options, const Progress& progress) {
    const auto solve = [&]<class Scheme>(Scheme scheme) {
        return MetricProblem<Scheme>(sampling, constraints, start, std::move(scheme), options).solve(options, progress);
    };
    const std::string& name = options.representation;
    if (name == "su2_frozen") return smooth_frozen(sampling, constraints, start, options, progress);
    if (name == "su2_midpoint") return solve(MidpointScheme{options.midpoint_limit});
    if (name == "su2_symmetric") return solve(SymmetricScheme{});
    if (name == "su2_geodesic") return solve(Su2GeodesicScheme{});
    return solve(GeodesicScheme{});
}

}  // namespace octafield::volume
