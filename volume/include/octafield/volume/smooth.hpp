// Smoothing: minimise the Dirichlet energy of an embedded frame field with one unit quaternion per vertex.
#pragma once

#include <string>
#include <vector>

#include "octafield/progress.hpp"
#include "octafield/volume/boundary.hpp"
#include "octafield/volume/tet_mesh.hpp"

namespace octafield::volume {

enum class SmoothSolver {
    // Newton steps with the exact Hessian in a trust region (Palmer, Bommes, Solomon 2020): follows negative curvature,
    // so that it does not stop at saddles.
    trust_region,
    levenberg_marquardt,  // Ceres; Gauss-Newton steps
    lbfgs,                // Ceres; gradients only
};

// Of levenberg_marquardt.
enum class LinearSolver { automatic, cholesky, conjugate_gradients };

struct SmoothOptions {
    // The embedding whose Dirichlet energy is minimised: a name of frames/registry.hpp.
    std::string representation = "sh4";
    SmoothSolver solver = SmoothSolver::trust_region;
    int max_iterations = 200;
    double tolerance = 1e-6;  // stop when an iteration lowers the energy by less than this fraction of it
    LinearSolver linear_solver = LinearSolver::automatic;  // automatic: sparse Cholesky up to 10,000 vertices
    int threads = 0;                                       // 0: all; the result does not depend on it
};

struct SmoothResult {
    Quaternions frames;    // (n, 4) unit quaternions w x y z
    double energy = 0;     // operators.hpp: dirichlet_energy, of sh4 whatever was minimised
    double objective = 0;  // 1/2 sum_c a_c^T L a_c of the representation that was smoothed
    int iterations = 0;
    bool converged = false;
    std::string message;                 // why the solver stopped
    std::vector<double> energy_history;  // the objective at the start and after each accepted or rejected step
};

// What the linear start takes as given.
enum class Start {
    constraints,  // the constraints alone: a fixed axis leaves the plane of its twist free (Ray, Sokolov, Levy 2016)
    cross_field,  // all boundary frames of `constraints`, free ones too, except at released corners
};

// The start: the field of sh4 vectors of least Dirichlet energy with what is given, linear in the unknowns, projected
// onto frames. Without anything given: identities. Throws InvalidInput, GeometryError (unsound mesh), SolverError.
Quaternions initial_frames(const TetMesh& mesh, const BoundaryConstraints& constraints,
                           Start start = Start::constraints, int threads = 0);

// Minimises from `start` over tangent unknowns of size 3 (free), 1 (axis) and 0 (fixed). Constraints hold exactly: the
// start is first moved onto them. Cancelling keeps the best state. Ceres' solvers set the process to one OpenBLAS
// thread and silence glog below fatal: what Ceres would log is in the exception. Throws InvalidInput, GeometryError
// (unsound mesh), SolverError.
SmoothResult smooth(const TetMesh& mesh, const BoundaryConstraints& constraints, const Quaternions& start,
                    const SmoothOptions& options = {}, const Progress& progress = {});

}  // namespace octafield::volume
