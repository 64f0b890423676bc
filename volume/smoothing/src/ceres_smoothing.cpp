#include "ceres_smoothing.hpp"

#include <ceres/solver.h>
#include <glog/logging.h>

#include "octafield/library_threads.hpp"
#include "octafield/volume/operators.hpp"

namespace octafield::volume {
namespace {

// Vertices; beyond, the fill of a 3D factorization costs more than inexact steps.
constexpr Index cholesky_limit = 10000;

// Passes energies on, keeps the history, and stops the solver when the caller wishes.
class Reporter final : public ceres::IterationCallback {
public:
    Reporter(const SmoothOptions& options, const Sampling& sampling, const FramesNow& frames, const Progress& progress,
             SmoothResult& result)
        : options_(options), sampling_(sampling), frames_(frames), progress_(progress), result_(result) {}

    ceres::CallbackReturnType operator()(const ceres::IterationSummary& step) override {
        // The summary of a rejected step may hold the cost of what was rejected.
        const bool rejected = !step.step_is_successful && !result_.objective_history.empty();
        if (rejected)
            repeat();
        else
            add(step.cost);
        const double fraction = options_.max_iterations > 0 ? double(step.iteration) / options_.max_iterations : 1;
        cancelled = !report(progress_, "smooth", fraction, result_.objective_history.back());
        return cancelled ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
    }

    // Ceres keeps the unknowns at their best state (update_state_every_iteration).
    void add(double cost) {
        result_.objective_history.push_back(sampling_.size * cost);
        result_.energy_history.push_back(dirichlet_energy(sampling_, frames_(), options_.threads));
    }

    bool cancelled = false;

private:
    void repeat() {
        for (auto* history : {&result_.objective_history, &result_.energy_history}) history->push_back(history->back());
    }

    const SmoothOptions& options_;
    const Sampling& sampling_;
    const FramesNow& frames_;
    const Progress& progress_;
    SmoothResult& result_;
};

ceres::Solver::Options solver_options(const SmoothOptions& options, Index vertex_count) {
    ceres::Solver::Options o;
    o.max_num_iterations = options.max_iterations;
    o.function_tolerance = options.tolerance;
    o.gradient_tolerance = 1e-14;  // of the problem scaled to unit size: reached only by fields of zero energy
    o.parameter_tolerance = 1e-14;
    // Ceres sums costs per thread, so more than one would change the last bits; what costs read is computed in parallel
    // instead.
    o.num_threads = 1;
    o.logging_type = ceres::SILENT;
    if (options.solver == SmoothSolver::lbfgs) o.minimizer_type = ceres::LINE_SEARCH;  // LBFGS is its default
    const bool cholesky = options.linear_solver == LinearSolver::cholesky ||
                          (options.linear_solver == LinearSolver::default_ && vertex_count <= cholesky_limit);
    o.linear_solver_type = cholesky ? ceres::SPARSE_NORMAL_CHOLESKY : ceres::CGNR;
    o.preconditioner_type = ceres::JACOBI;
    return o;
}

}  // namespace

ceres::Problem::Options problem_options(ceres::EvaluationCallback& field) {
    ceres::Problem::Options options;
    options.evaluation_callback = &field;
    options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    options.disable_all_safety_checks = true;  // quadratic in the valence otherwise
    return options;
}

SmoothResult solve_with_ceres(ceres::Problem& problem, const FramesNow& frames, const Sampling& sampling,
                              const SmoothOptions& options, const Progress& progress) {
    calm_library_threads();
    FLAGS_minloglevel = google::GLOG_FATAL;  // what Ceres would log is in the exception

    SmoothResult result;
    Reporter reporter(options, sampling, frames, progress, result);
    ceres::Solver::Options o = solver_options(options, static_cast<Index>(frames().rows()));
    o.callbacks.push_back(&reporter);
    o.update_state_every_iteration = true;
    ceres::Solver::Summary summary;
    ceres::Solve(o, &problem, &summary);
    if (summary.termination_type == ceres::FAILURE)
        throw SolverError("smoothing failed: " + summary.message +
                              "; look for degenerate tets (octafield info), or try linear_solver=conjugate_gradients",
                          "smoothing");

    result.frames = frames();
    result.objective = sampling.size * summary.final_cost;
    // A line search reports neither a start at a minimum nor the step after which it is content.
    if (result.objective_history.empty() || result.objective_history.back() != result.objective)
        reporter.add(summary.final_cost);
    result.iterations = std::max<int>(0, static_cast<int>(summary.iterations.size()) - 1);
    result.converged = !reporter.cancelled && summary.termination_type == ceres::CONVERGENCE;
    result.message = reporter.cancelled ? "cancelled" : summary.message;
    return result;
}

}  // namespace octafield::volume
