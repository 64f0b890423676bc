#include "diffusion_solver.hpp"

#include "definiteness.hpp"

namespace octafield::surface::detail {

DiffusionSolver::DiffusionSolver(const FreeSystem& system)
    : diagonal_(system.diagonal()),
      matrix_(system.stiffness()),
      order_(system.elimination_order()),
      cholesky_(matrix_, order_) {}

void DiffusionSolver::factorize(const Eigen::VectorXd& diagonal) {
    for (Eigen::Index i = 0; i < diagonal_.size(); ++i)
        matrix_.valuePtr()[matrix_.outerIndexPtr()[i]] = diagonal_[i] + diagonal[i];
    if (!cholesky_.factorize(matrix_))
        throw SolverError("the smoothness matrix of the direction field is not positive definite to rounding",
                          not_definite);
}

}  // namespace octafield::surface::detail
