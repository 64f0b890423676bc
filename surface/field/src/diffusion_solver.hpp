// Solves (K + D) x = b for several real diagonals D: one analysis of the pattern, one factorization per D.
#pragma once

#include "free_system.hpp"
#include "sparse_cholesky.hpp"

namespace octafield::surface::detail {

class DiffusionSolver {
public:
    // Keeps a reference to system, which must not be empty.
    explicit DiffusionSolver(const FreeSystem& system);

    // Factorizes K + D; throws SolverError where that is not positive definite to rounding.
    void factorize(const Eigen::VectorXd& diagonal);
    // x for the D last factorized.
    Eigen::VectorXcd solve(const Eigen::VectorXcd& right) { return cholesky_.solve(right); }
    const Eigen::VectorXi& order() const { return order_; }

private:
    Eigen::VectorXd diagonal_;  // of K
    FreeSystem::Matrix matrix_;
    Eigen::VectorXi order_;
    SparseCholesky<Complex> cholesky_;
};

}  // namespace octafield::surface::detail
