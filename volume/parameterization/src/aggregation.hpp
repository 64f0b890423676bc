// A multilevel preconditioner for Laplace-like matrices.
#pragma once

#include <Eigen/SparseCholesky>
#include <cstddef>
#include <vector>

#include "octafield/volume/operators.hpp"

namespace octafield::volume {

// Smoothed aggregation (Vanek, Mandel, Brezina, Computing 56, 1996): unknowns that are strongly coupled form groups; a
// step of Jacobi's method makes the groups' indicator functions smoother, and the matrix between these is that of the
// next level, until few are left, which are solved directly. The steps of conjugate gradients that it preconditions
// hardly grow with the mesh. Near linear; the same bits at any thread count.
class Aggregation {
public:
    // matrix: symmetric, positive semidefinite, rows of sum 0; it must outlive this. Throws SolverError.
    Aggregation(const SparseMatrix& matrix, int threads);

    // One symmetric cycle from 0 towards x with matrix x = right; right must be in the range of the matrix.
    Eigen::VectorXd cycle(const Eigen::VectorXd& right) const { return cycle(0, right); }

private:
    const SparseMatrix& matrix(std::size_t level) const { return level == 0 ? first_ : coarser_[level - 1]; }
    Eigen::VectorXd cycle(std::size_t level, const Eigen::VectorXd& right) const;

    const SparseMatrix& first_;
    int threads_;
    std::vector<SparseMatrix> coarser_;       // matrices of the levels above 0
    std::vector<SparseMatrix> prolongation_;  // from each of these to the level below
    std::vector<Eigen::VectorXd> inverse_;    // of the diagonals, of all levels but the last
    Eigen::SimplicialLDLT<SparseMatrix> last_;
};

}  // namespace octafield::volume
