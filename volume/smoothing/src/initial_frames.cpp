#include <limits>

#include "constraints.hpp"
#include "field_projector.hpp"
#include "heat_solver.hpp"
#include "octafield/volume/smooth.hpp"

namespace octafield::volume {
namespace {

constexpr int linear_iterations = 10000;
constexpr double linear_tolerance = 1e-6;
constexpr int refinements = 2;  // of a solve in single precision, with residuals in double

// Vertices that hold the frame of `constraints`: fixed ones, and with `cross_field` the whole boundary except released
// corners, whose frames are as good as none.
BoundaryConstraints holding(const BoundaryConstraints& constraints, Start start) {
    BoundaryConstraints held = constraints;
    if (start == Start::constraints) return held;
    for (std::size_t v = 0; v < held.kind.size(); ++v)
        if (held.on_boundary[v] || held.kind[v] != VertexConstraint::free) held.kind[v] = VertexConstraint::fixed;
    for (const Index corner : held.released_corners) held.kind[corner] = VertexConstraint::free;
    return held;
}

}  // namespace

Quaternions initial_frames(const Sampling& sampling, const BoundaryConstraints& constraints, Start start, int threads) {
    require_fitting(sampling, constraints);
    const BoundaryConstraints held = holding(constraints, start);
    Quaternions frames = constrained_start(held, constraints.frames);
    const BlockLaplacian laplacian(sampling);
    const ConstraintSpaces spaces(held, frames, laplacian);
    HeatSolver solver(laplacian, spaces, threads);
    Sh4Field field = spaces.given();
    HeatSolution solution;
    for (int k = 0; k <= refinements; ++k)
        solution = solver.step(std::numeric_limits<double>::infinity(), field, linear_tolerance, linear_iterations);
    if (!solution.converged)
        throw SolverError("the start's linear solve did not converge in " + std::to_string(linear_iterations) +
                              " iterations; look for degenerate tets (octafield info)",
                          "conjugate_gradients");
    const FieldProjector projector(spaces, threads);
    projector.project(field, embedded(frames, threads), frames);
    projector.write_frames(field, frames);
    return frames;
}

}  // namespace octafield::volume
