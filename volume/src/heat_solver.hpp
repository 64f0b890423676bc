// Linear solves in the spaces that constraints leave: one implicit step of the heat equation, or a harmonic field.
#pragma once

#include "constraint_spaces.hpp"

namespace octafield::volume {

struct HeatSolution {
    int iterations = 0;
    bool converged = false;
};

// All nine components are one system with the scalar operator L + M / time, solved by conjugate gradients with its
// diagonal as preconditioner: both commute with the projections onto the constraint spaces.
class HeatSolver {
public:
    HeatSolver(const BlockLaplacian& laplacian, const ConstraintSpaces& spaces, int threads);

    // Minimises 1/2 x . L x + 1/(2 time) |x - field|_M^2 over fields x on the constraints; time: input length squared,
    // infinity for a harmonic field. `field` is on the constraints and becomes x. tolerance: of the residual's
    // preconditioned norm over that of the right-hand side or, if it is larger, at the start. Throws SolverError.
    HeatSolution step(double time, Sh4Field& field, double tolerance, int max_iterations);

private:
    using Vector = frames::Sh4::Vector;

    // Sums body(v) over vertices.
    template <class Body>
    double sum(const Body& body) const;

    const BlockLaplacian& laplacian_;
    const ConstraintSpaces& spaces_;
    int threads_;
    Sh4Field load_;  // -L given, as far as the unknowns reach
    Sh4Field residual_, direction_, image_;
};

}  // namespace octafield::volume
