// Solvers of volume/: start, diffusion, smoothing and the recipe of all three.
#include "octafield/volume/frame_field.hpp"

#include <pybind11/eigen.h>

#include "arrays.hpp"
#include "bind.hpp"
#include "checks.hpp"
#include "interruptible.hpp"
#include "options.hpp"
#include "sampling.hpp"
#include "words.hpp"

namespace octafield::bindings {

using namespace volume;
using py::literals::operator""_a;

namespace {

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

    m.def(
        "diffuse",
        [](const MeshOrSampling& mesh, const BoundaryConstraints& constraints, const ArrayLike& start,
           const std::optional<ProgressCallable>& progress, const py::kwargs& given) {
            const auto [options] = options_of<DiffuseOptions>("diffuse", given);
            return run_on(
                mesh, constraints,
                [options = options, rows = from_python<Quaternions>(start, "start")](const auto& where,
                                                                                     const auto& held, Job& job) mutable {
                    check_unit(rows, where.count(), "start");
                    return diffuse(where, held, rows, options, job.progress());
                },
                progress);
        },
        "domain"_a, "constraints"_a, "start"_a, py::kw_only(), "progress"_a = py::none(),
        "Implicit heat flow of the sh4 vectors alternating with projection onto frames (modified MBO, Palmer et al. "
        "2020) and, after the last step, sweeps that set each frame to the best for its neighbours, from (n, 4) start "
        "frames, as a SmoothResult of the lowest energy met (of the last step, without keep_best): the start for "
        "smooth. first_time: of the first step over the squared size of the body; last_time: "
        "of the last over the squared mean boundary edge; step k lasts 1/k^time_exponent of the first, with a larger "
        "exponent where max_steps would not do; linear_tolerance: of the linear solves. domain: a TetDomain, a TetMesh or a Sampling. "
        "Cancelled by progress, the "
        "best state is returned with converged False. Raises InvalidInput, SolverError.");

    list_options<DiffuseOptions>(m, "diffuse");

    m.def(
        "smooth",
        [](const MeshOrSampling& mesh, const BoundaryConstraints& constraints, const ArrayLike& start,
           const std::optional<ProgressCallable>& progress, const py::kwargs& given) {
            const auto [options] = options_of<SmoothOptions>("smooth", given);
            return run_on(
                mesh, constraints,
                [options = options, rows = from_python<Quaternions>(start, "start")](const auto& where,
                                                                                     const auto& held, Job& job) mutable {
                    check_unit(rows, where.count(), "start");
                    return smooth(where, held, rows, options, job.progress());
                },
                progress);
        },
        "domain"_a, "constraints"_a, "start"_a, py::kw_only(), "progress"_a = py::none(),
        "Minimise the Dirichlet energy of a frame field from (n, 4) start frames, over one quaternion per vertex, "
        "constraints held exactly, as a SmoothResult. representation: a key of schemes: an embedding, "
        "odeco tensors with free axis lengths (\"odeco_lengths\", lengths of held axes are 1 unless "
        "constraints.lengths tells others), or a metric on frames, which wants a start near its minimum, as "
        "frame_field gives. solver: "
        "\"trust_region\" (Newton steps with the exact Hessian; embeddings of frames only), \"levenberg_marquardt\" or "
        "\"lbfgs\" (Ceres), or \"default\", the first that goes. tolerance: relative energy decrease at which to "
        "stop; "
        "linear_solver (of levenberg_marquardt): \"default\", \"cholesky\" or \"conjugate_gradients\"; "
        "midpoint_limit (of su2_midpoint, radians): beyond it edges are measured by the geodesic; the result does not "
        "depend on threads. Cancelled by progress, the best state is returned with converged False. domain: a TetDomain, a TetMesh or "
        "a Sampling. Raises "
        "InvalidInput, SolverError.");
    list_options<SmoothOptions>(m, "smooth");

    m.def(
        "frame_field",
        [](const MeshOrSampling& mesh, const BoundaryConstraints& constraints,
           const std::optional<ProgressCallable>& progress, const py::kwargs& given) {
            auto [options, diffuse, smooth] =
                options_of<FrameFieldOptions, DiffuseOptions, SmoothOptions>("frame_field", given);
            options.diffuse = diffuse;
            options.smooth = smooth;
            return run_on(
                mesh, constraints,
                [options = options](const auto& where, const auto& held, Job& job) {
                    return frame_field(where, held, options, job.progress());
                },
                progress);
        },
        "domain"_a, "constraints"_a, py::kw_only(), "progress"_a = py::none(),
        "The recipe: initial_frames, then rounds of diffuse and smooth, as a FrameFieldResult of the lowest energy. "
        "seed other than 0: a random start, with five times first_time. round_time: first_time of each round over that "
        "of the one before. Rounds polish in sh4 with the trust region; another representation or solver starts from "
        "the best of them. The "
        "other options are those of the parts. domain: a TetDomain, a TetMesh or a Sampling. Cancelled by progress, the best state is "
        "returned with converged "
        "False. Raises InvalidInput, SolverError.");
    list_options<FrameFieldOptions, DiffuseOptions, SmoothOptions>(m, "frame_field");
}

}  // namespace octafield::bindings
