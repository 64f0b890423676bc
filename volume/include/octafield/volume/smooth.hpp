// Smoothing: minimise the Dirichlet energy of an embedded frame field with one unit quaternion per vertex (Ceres).
#pragma once

#include <string>
#include <vector>

#include "octafield/progress.hpp"
#include "octafield/volume/boundary.hpp"
#include "octafield/volume/tet_mesh.hpp"

namespace octafield::volume {

enum class LinearSolver { automatic, cholesky, conjugate_gradients };

struct SmoothOptions {
    int max_iterations = 200;
    double tolerance = 1e-6;  // stop when an iteration lowers the energy by less than this fraction of it
    LinearSolver linear_solver = LinearSolver::automatic;  // automatic: sparse Cholesky up to 10,000 vertices
    int threads = 0;                                       // 0: all; the result does not depend on it
};

struct SmoothResult {
    Quaternions frames;  // (n, 4) unit quaternions w x y z
    double energy = 0;   // operators.hpp: dirichlet_energy
    int iterations = 0;
    bool converged = false;
    std::string message;                 // why the solver stopped
    std::vector<double> energy_history;  // at the start and after each accepted or rejected step
};

// The start: componentwise harmonic extension of the boundary frames' sh4 vectors (Ray, Sokolov, Levy 2016, without its
// normal constraint), projected. All boundary frames of `constraints` are held, free ones too, except at released
// corners. Throws InvalidInput, GeometryError (unsound mesh), SolverError.
Quaternions initial_frames(const TetMesh& mesh, const BoundaryConstraints& constraints, int threads = 0);

// Levenberg-Marquardt from `start` over tangent unknowns of size 3 (free), 1 (axis) and 0 (fixed). Constraints hold
// exactly: the start is first moved onto them. Cancelling keeps the best state. Sets the process to one OpenBLAS
// thread and silences glog below fatal: what Ceres would log is in the exception. Throws InvalidInput, GeometryError
// (unsound mesh), SolverError.
SmoothResult smooth(const TetMesh& mesh, const BoundaryConstraints& constraints, const Quaternions& start,
                    const SmoothOptions& options = {}, const Progress& progress = {});

}  // namespace octafield::volume
