#include "frozen_smoothing.hpp"

#include <algorithm>

#include "metric_smoothing.hpp"

namespace octafield::volume {

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

}  // namespace octafield::volume
