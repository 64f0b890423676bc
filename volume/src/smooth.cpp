#include "octafield/volume/smooth.hpp"

#include <ceres/problem.h>
#include <ceres/solver.h>
#include <glog/logging.h>

#include <array>
#include <cmath>
#include <limits>
#include <memory>

#include "constraints.hpp"
#include "dirichlet_costs.hpp"
#include "frame_manifolds.hpp"
#include "octafield/frames/registry.hpp"
#include "octafield/library_threads.hpp"
#include "octafield/volume/operators.hpp"
#include "trust_region.hpp"

namespace octafield::volume {
namespace {

using frames::Quaternion;
using frames::Vector3;
using frames::Vector4;

// Vertices; beyond, the fill of a 3D factorization costs more than inexact steps.
constexpr Index cholesky_limit = 10000;

// Passes energies on, keeps the history, and stops the solver when the caller wishes.
class Reporter final : public ceres::IterationCallback {
public:
    Reporter(const SmoothOptions& options, double energy_scale, const Progress& progress, SmoothResult& result)
        : options_(options), scale_(energy_scale), progress_(progress), result_(result) {}

    ceres::CallbackReturnType operator()(const ceres::IterationSummary& step) override {
        // A rejected step's summary holds the cost of the state that was kept.
        result_.energy_history.push_back(scale_ * step.cost);
        const double fraction = options_.max_iterations > 0 ? double(step.iteration) / options_.max_iterations : 1;
        cancelled = !report(progress_, "smooth", fraction, scale_ * step.cost);
        return cancelled ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
    }

    bool cancelled = false;

private:
    const SmoothOptions& options_;
    double scale_;
    const Progress& progress_;
    SmoothResult& result_;
};

template <frames::Representation R>
void add_costs(ceres::Problem& problem, EmbeddedField<R>& field, const DirichletBlocks& blocks, double scale) {
    using Cost = LinearCombinationCost<R>;
    for (const auto& edge : blocks.edges) {
        const double w = std::sqrt(edge.weight * scale);
        typename Cost::Coefficients coefficients(1, 2);
        coefficients << w, -w;
        problem.AddResidualBlock(new Cost(field, {edge.i, edge.j}, coefficients), nullptr, field.parameters(edge.i),
                                 field.parameters(edge.j));
    }
    for (const auto& tet : blocks.tets) {
        std::vector<double*> parameters;
        for (const Index v : tet.vertices) parameters.push_back(field.parameters(v));
        problem.AddResidualBlock(
            new Cost(field, {tet.vertices.begin(), tet.vertices.end()}, std::sqrt(scale) * tet.gradient), nullptr,
            parameters);
    }
}

// One manifold per axis-constrained vertex; free vertices share one.
struct Manifolds {
    FrameManifold frame;
    std::vector<std::unique_ptr<TwistManifold>> twists;
};

template <frames::Representation R>
void set_manifolds(ceres::Problem& problem, EmbeddedField<R>& field, const BoundaryConstraints& constraints,
                   Manifolds& manifolds) {
    for (std::size_t v = 0; v < constraints.kind.size(); ++v) {
        double* parameters = field.parameters(static_cast<Index>(v));
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

ceres::Solver::Options solver_options(const SmoothOptions& options, Index vertex_count) {
    ceres::Solver::Options o;
    o.max_num_iterations = options.max_iterations;
    o.function_tolerance = options.tolerance;
    o.gradient_tolerance = 1e-14;  // of the problem scaled to unit size: reached only by fields of zero energy
    o.parameter_tolerance = 1e-14;
    // Ceres sums costs per thread, so more than one would change the last bits; embeddings are computed in parallel
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

// `start` is on the constraints.
template <frames::Representation R>
SmoothResult smooth_with_ceres(const TetMesh& mesh, const BoundaryConstraints& constraints, const Quaternions& start,
                               const SmoothOptions& options, const Progress& progress) {
    calm_library_threads();
    FLAGS_minloglevel = google::GLOG_FATAL;  // what Ceres would log is in the exception

    // The energy grows like a length: solved at unit size, so that no tolerance depends on the input's unit.
    const double length = surface::bounding_box_diagonal(mesh.vertices);
    EmbeddedField<R> field(start, options.threads);
    SmoothResult result;
    Reporter reporter(options, length, progress, result);
    Manifolds manifolds;

    ceres::Problem::Options problem_options;
    problem_options.evaluation_callback = &field;
    problem_options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    problem_options.disable_all_safety_checks = true;  // quadratic in the valence otherwise
    ceres::Problem problem(problem_options);
    add_costs(problem, field, dirichlet_blocks(mesh), 1 / length);
    set_manifolds(problem, field, constraints, manifolds);

    ceres::Solver::Options o = solver_options(options, static_cast<Index>(mesh.vertices.rows()));
    o.callbacks.push_back(&reporter);
    ceres::Solver::Summary summary;
    ceres::Solve(o, &problem, &summary);
    if (summary.termination_type == ceres::FAILURE)
        throw SolverError("smoothing failed: " + summary.message +
                              "; look for degenerate tets (octafield info), or try linear_solver=conjugate_gradients",
                          "smoothing");

    result.frames = field.quaternions();
    result.objective = length * summary.final_cost;
    result.iterations = std::max<int>(0, static_cast<int>(summary.iterations.size()) - 1);
    result.converged = !reporter.cancelled && summary.termination_type == ceres::CONVERGENCE;
    result.message = reporter.cancelled ? "cancelled" : summary.message;
    return result;
}

}  // namespace

SmoothResult smooth(const TetMesh& mesh, const BoundaryConstraints& constraints, const Quaternions& start,
                    const SmoothOptions& options, const Progress& progress) {
    require_fitting(mesh, constraints, start);
    if (options.max_iterations < 0) throw InvalidInput("max_iterations is negative; give 0 or more", "bad_option");
    if (!(options.tolerance >= 0)) throw InvalidInput("tolerance must not be negative", "bad_option");
    const Quaternions on_constraints = constrained_start(constraints, start);
    SmoothResult result;
    frames::with_representation(options.representation, [&]<frames::Representation R>() {
        result = options.solver == SmoothSolver::trust_region
                     ? trust_region<R>(mesh, constraints, on_constraints, options, progress)
                     : smooth_with_ceres<R>(mesh, constraints, on_constraints, options, progress);
    });
    result.energy = dirichlet_energy(mesh, result.frames, options.threads);
    return result;
}

}  // namespace octafield::volume
