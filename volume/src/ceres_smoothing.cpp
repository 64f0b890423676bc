#include "ceres_smoothing.hpp"

#include <ceres/solver.h>
#include <glog/logging.h>

#include "octafield/library_threads.hpp"

namespace octafield::volume {
namespace {

using frames::Vector3;

// Vertices; beyond, the fill of a 3D factorization costs more than inexact steps.
constexpr Index cholesky_limit = 10000;

// Passes energies on, keeps the history, and stops the solver when the caller wishes.
class Reporter final : public ceres::IterationCallback {
public:
    Reporter(const SmoothOptions& options, double energy_scale, const Progress& progress, SmoothResult& result)
        : options_(options), scale_(energy_scale), progress_(progress), result_(result) {}

    ceres::CallbackReturnType operator()(const ceres::IterationSummary& step) override {
        auto& history = result_.energy_history;
        // The summary of a rejected step may hold the cost of what was rejected.
        const bool rejected = !step.step_is_successful && !history.empty();
        const double energy = rejected ? history.back() : scale_ * step.cost;
        history.push_back(energy);
        const double fraction = options_.max_iterations > 0 ? double(step.iteration) / options_.max_iterations : 1;
        cancelled = !report(progress_, "smooth", fraction, energy);
        return cancelled ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
    }

    bool cancelled = false;

private:
    const SmoothOptions& options_;
    double scale_;
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
                          (options.linear_solver == LinearSolver::automatic && vertex_count <= cholesky_limit);
    o.linear_solver_type = cholesky ? ceres::SPARSE_NORMAL_CHOLESKY : ceres::CGNR;
    o.preconditioner_type = ceres::JACOBI;
    return o;
}

}  // namespace

void set_manifolds(ceres::Problem& problem, Quaternions& quaternions, const BoundaryConstraints& constraints,
                   Manifolds& manifolds) {
    for (std::size_t v = 0; v < constraints.kind.size(); ++v) {
        double* parameters = quaternions.row(static_cast<Eigen::Index>(v)).data();
        if (!problem.HasParameterBlock(parameters)) continue;
        switch (constraints.kind[v]) {
            case VertexConstraint::fixed:
                problem.SetParameterBlockConstant(parameters);
                break;
            case VertexConstraint::axis:
                manifolds.twists.push_back(
                    std::make_unique<TwistManifold>(Vector3(constraints.axis.row(v).transpose())));
                problem.SetManifold(parameters, manifolds.twists.back().get());
                break;
            case VertexConstraint::free:
                problem.SetManifold(parameters, &manifolds.frame);
                break;
        }
    }
}

ceres::Problem::Options problem_options(ceres::EvaluationCallback& field) {
    ceres::Problem::Options options;
    options.evaluation_callback = &field;
    options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    options.disable_all_safety_checks = true;  // quadratic in the valence otherwise
    return options;
}

SmoothResult solve_with_ceres(ceres::Problem& problem, const Quaternions& quaternions, double energy_scale,
                              const SmoothOptions& options, const Progress& progress) {
    calm_library_threads();
    FLAGS_minloglevel = google::GLOG_FATAL;  // what Ceres would log is in the exception

    SmoothResult result;
    Reporter reporter(options, energy_scale, progress, result);
    ceres::Solver::Options o = solver_options(options, static_cast<Index>(quaternions.rows()));
    o.callbacks.push_back(&reporter);
    ceres::Solver::Summary summary;
    ceres::Solve(o, &problem, &summary);
    if (summary.termination_type == ceres::FAILURE)
        throw SolverError("smoothing failed: " + summary.message +
                              "; look for degenerate tets (octafield info), or try linear_solver=conjugate_gradients",
                          "smoothing");

    // A line search that starts at a minimum makes no report.
    if (result.energy_history.empty()) result.energy_history.push_back(energy_scale * summary.final_cost);
    result.frames = quaternions;
    result.objective = energy_scale * summary.final_cost;
    result.iterations = std::max<int>(0, static_cast<int>(summary.iterations.size()) - 1);
    result.converged = !reporter.cancelled && summary.termination_type == ceres::CONVERGENCE;
    result.message = reporter.cancelled ? "cancelled" : summary.message;
    return result;
}

}  // namespace octafield::volume
