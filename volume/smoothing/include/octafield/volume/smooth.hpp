// Smoothing: minimise the Dirichlet energy of a frame field with one unit quaternion per site of a sampling (vertices,
// unless another is given), in an embedding or in a metric on frames.
#pragma once

#include <memory>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "octafield/progress.hpp"
#include "octafield/volume/array_scheme.hpp"
#include "octafield/volume/boundary.hpp"
#include "octafield/volume/sampling.hpp"

namespace octafield::volume {

enum class SmoothSolver {
    default_,  // the scheme's first: trust_region for embeddings, levenberg_marquardt for metrics, lbfgs with lengths
    // Newton steps with the exact Hessian in a trust region (Palmer, Bommes, Solomon 2020): follows negative curvature,
    // so that it does not stop at saddles.
    trust_region,
    levenberg_marquardt,  // Ceres; Gauss-Newton steps
    lbfgs,                // Ceres; gradients only
};

// Of levenberg_marquardt.
enum class LinearSolver { default_, cholesky, conjugate_gradients };

struct SmoothOptions {
    // What is minimised, the name of a row of schemes.hpp. An embedding: the Dirichlet energy of vectors (su2 is the
    // naive scheme). odeco_lengths: of odeco tensors with axis lengths as further unknowns (Palmer, Bommes, Solomon
    // 2020): a fixed axis has length 1, a fixed frame lengths 1, unless BoundaryConstraints::lengths gives others; the
    // unknowns are logarithms, so that lengths stay positive. Held ones keep the rest from shrinking, but near singular
    // curves the two across them nearly vanish, which is how such a field is continuous there. A metric on frames:
    // edges ij have differences d_ij (world axes, radians) in place of a_j - a_i (docs/su2_smoothing.md).
    std::string representation = "sh4";
    SmoothSolver solver = SmoothSolver::default_;  // trust_region: embeddings of frames only
    int max_iterations = 200;
    // Stop when an iteration lowers the energy by less than this fraction of it; of trust_region also when five that
    // lower it do on average.
    double tolerance = 1e-6;
    LinearSolver linear_solver = LinearSolver::default_;  // default_: sparse Cholesky up to 10,000 vertices
    int threads = 0;                                      // 0: all; the result does not depend on it
    // Of su2_midpoint, radians: edges whose frames differ by more are measured by the geodesic, with a smooth
    // transition from half of it. Infinity: never.
    double midpoint_limit = 20 * std::numbers::pi / 180;
    // The user's own, minimised by the trust region in place of `representation`.
    std::shared_ptr<const ArrayScheme> own_scheme = nullptr;
};

struct SmoothResult {
    Quaternions frames;  // (n, 4) unit quaternions w x y z
    Points lengths;      // (n, 3) of the frames' axes (columns of R) where odeco_lengths was minimised; else no rows
    double energy = 0;   // operators.hpp: dirichlet_energy, of sh4 whatever was minimised
    // What was minimised: 1/2 sum_c a_c^T L a_c of an embedding or of tensors with lengths, 1/2 of the squared gradient
    // in radians of a metric.
    double objective = 0;
    int iterations = 0;
    bool converged = false;
    std::string message;  // why the solver stopped
    // At the start and after each accepted or rejected step: the energy above, of sh4 whatever was minimised, and the
    // objective. Both end with those of `frames`.
    std::vector<double> energy_history, objective_history;
};

// What the linear start takes as given.
enum class Start {
    constraints,  // the constraints alone: a fixed axis leaves the plane of its twist free (Ray, Sokolov, Levy 2016)
    cross_field,  // all boundary frames of `constraints`, free ones too, except at released corners
};

// The start: the field of sh4 vectors of least Dirichlet energy with what is given, linear in the unknowns, projected
// onto frames. Without anything given: identities. Throws InvalidInput, GeometryError (unsound mesh), SolverError.
Quaternions initial_frames(const Sampling& sampling, const BoundaryConstraints& constraints,
                           Start start = Start::constraints, int threads = 0);

// Metrics keep the matchings of a rough start, so begin them near a minimum of sh4 (frame_field does); su2_frozen does
// not lower any energy and may never converge.
//
// Minimises from `start` over tangent unknowns of size 3 (free), 1 (axis) and 0 (fixed). Constraints hold exactly: the
// start is first moved onto them. Cancelling keeps the best state. Ceres' solvers set the process to one OpenBLAS
// thread and silence glog below fatal: what Ceres would log is in the exception. Throws InvalidInput, GeometryError
// (unsound mesh), SolverError.
SmoothResult smooth(const Sampling& sampling, const BoundaryConstraints& constraints, const Quaternions& start,
                    const SmoothOptions& options = {}, const Progress& progress = {});

}  // namespace octafield::volume
