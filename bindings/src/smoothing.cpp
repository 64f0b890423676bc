// Solvers of volume/: start, diffusion, smoothing and the recipe of all three.
#include "octafield/volume/frame_field.hpp"

#include <pybind11/eigen.h>

#include <cmath>

#include "arrays.hpp"
#include "bind.hpp"
#include "checks.hpp"
#include "interruptible.hpp"
#include "sampling.hpp"
#include "words.hpp"

namespace octafield::bindings {

using namespace volume;
using py::literals::operator""_a;

namespace {

// The keyword arguments that several solvers share, checked.
DiffuseOptions diffuse_options(double first_time, double last_time, double time_exponent, int max_steps,
                               double linear_tolerance, bool keep_best, int threads) {
    return {.first_time = finite(first_time, "first_time"),
            .last_time = finite(last_time, "last_time"),
            .time_exponent = finite(time_exponent, "time_exponent"),
            .max_steps = max_steps,
            .linear_tolerance = finite(linear_tolerance, "linear_tolerance"),
            .keep_best = keep_best,
            .threads = threads_option(threads)};
}

SmoothOptions smooth_options(std::string representation, const std::string& solver, int max_iterations,
                             double tolerance, const std::string& linear_solver, double midpoint_limit, int threads) {
    if (std::isnan(midpoint_limit)) throw InvalidInput("midpoint_limit is not a number", "bad_option");
    return {.representation = std::move(representation),
            .solver = from_word<SmoothSolver>(solver, "solver"),
            .max_iterations = max_iterations,
            .tolerance = finite(tolerance, "tolerance"),
            .linear_solver = from_word<LinearSolver>(linear_solver, "linear_solver"),
            .threads = threads_option(threads),
            .midpoint_limit = midpoint_limit};
}

// body(sampling, constraints, job) on checked copies, away from Python's lock.
template <class Body>
auto run_on(const MeshOrSampling& mesh, const BoundaryConstraints& constraints, Body body,
            const std::optional<ProgressCallable>& progress = {}) {
    return run_interruptible(
        [mesh = mesh, constraints = constraints, body = std::move(body)](Job& job) mutable {
            const std::shared_ptr<const Sampling> sampling = sampling_of(mesh);
            check(constraints, sampling->count());
            return body(*sampling, constraints, job);
        },
        progress);
}

}  // namespace

void bind_smoothing(py::module_& m) {
    const FrameFieldOptions recipe;
    m.def(
        "initial_frames",
        [](const MeshOrSampling& mesh, const BoundaryConstraints& constraints, const std::string& start, int threads) {
            const Start given = from_word<Start>(start, "start");
            threads_option(threads);
            return own(run_on(mesh, constraints, [given, threads](const auto& where, const auto& held, Job&) {
                return initial_frames(where, held, given, threads);
            }));
        },
        "domain"_a, "constraints"_a, py::kw_only(), "start"_a = to_word(recipe.start), "threads"_a = recipe.threads,
        "(n, 4) start frames: the sh4 field of least Dirichlet energy, one linear solve, projected. domain: a TetDomain or TetMesh "
        "(frames "
        "at its vertices) or a Sampling. start: what it "
        "takes as given, \"constraints\" (a fixed axis leaves the plane of its twist free; Ray et al. 2016) or "
        "\"cross_field\" (every boundary frame, except at released corners). Raises InvalidInput, SolverError.");

    const DiffuseOptions& diffusion = recipe.diffuse;
    m.def(
        "diffuse",
        [](const MeshOrSampling& mesh, const BoundaryConstraints& constraints, const ArrayLike& start,
           double first_time, double last_time, double time_exponent, int max_steps, double linear_tolerance,
           bool keep_best, int threads, const std::optional<ProgressCallable>& progress) {
            const DiffuseOptions options =
                diffuse_options(first_time, last_time, time_exponent, max_steps, linear_tolerance, keep_best, threads);
            return run_on(
                mesh, constraints,
                [options, rows = from_python<Quaternions>(start, "start")](const auto& where, const auto& held,
                                                                           Job& job) mutable {
                    check_unit(rows, where.count(), "start");
                    return diffuse(where, held, rows, options, job.progress());
                },
                progress);
        },
        "domain"_a, "constraints"_a, "start"_a, py::kw_only(), "first_time"_a = diffusion.first_time,
        "last_time"_a = diffusion.last_time, "time_exponent"_a = diffusion.time_exponent,
        "max_steps"_a = diffusion.max_steps, "linear_tolerance"_a = diffusion.linear_tolerance,
        "keep_best"_a = diffusion.keep_best, "threads"_a = diffusion.threads, "progress"_a = py::none(),
        "Implicit heat flow of the sh4 vectors alternating with projection onto frames (modified MBO, Palmer et al. "
        "2020) and, after the last step, sweeps that set each frame to the best for its neighbours, from (n, 4) start "
        "frames, as a SmoothResult of the lowest energy met (of the last step, without keep_best): the start for "
        "smooth. first_time: of the first step over the squared size of the body; last_time: "
        "of the last over the squared mean boundary edge; step k lasts 1/k^time_exponent of the first, with a larger "
        "exponent where max_steps would not do; linear_tolerance: of the linear solves. domain: a TetDomain, a TetMesh or a Sampling. "
        "Cancelled by progress, the "
        "best state is returned with converged False. Raises InvalidInput, SolverError.");

    const SmoothOptions& smoothing = recipe.smooth;
    m.def(
        "smooth",
        [](const MeshOrSampling& mesh, const BoundaryConstraints& constraints, const ArrayLike& start,
           const std::string& representation, const std::string& solver, int max_iterations, double tolerance,
           const std::string& linear_solver, double midpoint_limit, int threads,
           const std::optional<ProgressCallable>& progress) {
            const SmoothOptions options = smooth_options(representation, solver, max_iterations, tolerance,
                                                         linear_solver, midpoint_limit, threads);
            return run_on(
                mesh, constraints,
                [options, rows = from_python<Quaternions>(start, "start")](const auto& where, const auto& held,
                                                                           Job& job) mutable {
                    check_unit(rows, where.count(), "start");
                    return smooth(where, held, rows, options, job.progress());
                },
                progress);
        },
        "domain"_a, "constraints"_a, "start"_a, py::kw_only(), "representation"_a = smoothing.representation,
        "solver"_a = to_word(smoothing.solver), "max_iterations"_a = smoothing.max_iterations,
        "tolerance"_a = smoothing.tolerance, "linear_solver"_a = to_word(smoothing.linear_solver),
        "midpoint_limit"_a = smoothing.midpoint_limit, "threads"_a = smoothing.threads, "progress"_a = py::none(),
        "Minimise the Dirichlet energy of a frame field from (n, 4) start frames, over one quaternion per vertex, "
        "constraints held exactly, as a SmoothResult. representation: a key of schemes: an embedding, "
        "odeco tensors with free axis lengths (\"odeco_lengths\", lengths of held axes are 1 unless "
        "constraints.lengths tells others), or a metric on frames, which wants a start near its minimum, as "
        "frame_field gives. solver: "
        "\"trust_region\" (Newton steps with the exact Hessian; embeddings of frames only), \"levenberg_marquardt\" or "
        "\"lbfgs\" (Ceres), or \"automatic\", the first that goes. tolerance: relative energy decrease at which to "
        "stop; "
        "linear_solver (of levenberg_marquardt): \"automatic\", \"cholesky\" or \"conjugate_gradients\"; "
        "midpoint_limit (of su2_midpoint, radians): beyond it edges are measured by the geodesic; the result does not "
        "depend on threads. Cancelled by progress, the best state is returned with converged False. domain: a TetDomain, a TetMesh or "
        "a Sampling. Raises "
        "InvalidInput, SolverError.");
    m.def(
        "frame_field",
        [](const MeshOrSampling& mesh, const BoundaryConstraints& constraints, const std::string& start,
           std::uint64_t seed, int rounds, double round_time, double first_time, double last_time, double time_exponent,
           int max_steps, double linear_tolerance, const std::string& representation, const std::string& solver,
           int max_iterations, double tolerance, const std::string& linear_solver, double midpoint_limit, int threads,
           const std::optional<ProgressCallable>& progress) {
            const FrameFieldOptions options{.start = from_word<Start>(start, "start"),
                                            .seed = seed,
                                            .diffuse = diffuse_options(first_time, last_time, time_exponent, max_steps,
                                                                       linear_tolerance, true, threads),
                                            .smooth = smooth_options(representation, solver, max_iterations, tolerance,
                                                                     linear_solver, midpoint_limit, threads),
                                            .rounds = rounds,
                                            .round_time = finite(round_time, "round_time"),
                                            .threads = threads_option(threads)};
            return run_on(
                mesh, constraints,
                [options](const auto& where, const auto& held, Job& job) {
                    return frame_field(where, held, options, job.progress());
                },
                progress);
        },
        "domain"_a, "constraints"_a, py::kw_only(), "start"_a = to_word(recipe.start), "seed"_a = recipe.seed,
        "rounds"_a = recipe.rounds, "round_time"_a = recipe.round_time, "first_time"_a = diffusion.first_time,
        "last_time"_a = diffusion.last_time, "time_exponent"_a = diffusion.time_exponent,
        "max_steps"_a = diffusion.max_steps, "linear_tolerance"_a = diffusion.linear_tolerance,
        "representation"_a = smoothing.representation, "solver"_a = to_word(smoothing.solver),
        "max_iterations"_a = smoothing.max_iterations, "tolerance"_a = smoothing.tolerance,
        "linear_solver"_a = to_word(smoothing.linear_solver), "midpoint_limit"_a = smoothing.midpoint_limit,
        "threads"_a = recipe.threads, "progress"_a = py::none(),
        "The recipe: initial_frames, then rounds of diffuse and smooth, as a FrameFieldResult of the lowest energy. "
        "seed other than 0: a random start, with five times first_time. round_time: first_time of each round over that "
        "of the one before. Rounds polish in sh4 with the trust region; another representation or solver starts from "
        "the best of them. The "
        "other options are those of the parts. domain: a TetDomain, a TetMesh or a Sampling. Cancelled by progress, the best state is "
        "returned with converged "
        "False. Raises InvalidInput, SolverError.");
}

}  // namespace octafield::bindings
