// Linear solves in the spaces that constraints leave: one implicit step of the heat equation, or a harmonic field.
#pragma once

#include "constraint_spaces.hpp"

namespace octafield::volume {

struct HeatSolution {
    double energy = 0;  // of the field that the step began with
    int iterations = 0;
    bool converged = false;
};

// All nine components are one system with the scalar operator L + M / time, solved by conjugate gradients with its
// diagonal as preconditioner: both commute with the projections onto the constraint spaces. The unknown is the change
// of the field; it is held in single precision, which halves the memory to pass over: residuals are of the field in
// double precision, so a second step from the result refines it.
class HeatSolver {
public:
    HeatSolver(const BlockLaplacian& laplacian, const ConstraintSpaces& spaces, int threads);

    // Minimises 1/2 x . L x + 1/(2 time) |x - field|_M^2 over fields x on the constraints; time: input length squared,
    // infinity for a harmonic field. `field` is on the constraints and becomes x. tolerance: of the
    // residual's preconditioned norm over that of the right-hand side or, if it is larger, at the start; of finite
    // times it is halved at least. Throws SolverError.
    HeatSolution step(double time, Sh4Field& field, double tolerance, int max_iterations);

private:
    using Vector = Eigen::Matrix<float, frames::Sh4::dimension, 1>;
    using Field = Rows<float, frames::Sh4::dimension>;

    // Sums body(v) over sites.
    template <class Body>
    double sum(const Body& body) const;
    double begin(const Sh4Field& field, double& energy);
    double multiply();

    const BlockLaplacian& laplacian_;
    const ConstraintSpaces& spaces_;
    int threads_;
    std::vector<float> inverse_, pull_;  // of the diagonal; M / time
    Field load_;                         // -L given, as far as the unknowns reach
    Field change_, residual_, direction_, image_;
    Sh4Field product_;
};

}  // namespace octafield::volume
