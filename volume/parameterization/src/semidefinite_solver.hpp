// Laplace-like systems without boundary values: solved up to a constant in each connected part.
#pragma once

#include <vector>

#include "octafield/volume/operators.hpp"

namespace octafield::volume {

// Unknowns that the elements connect.
struct Parts {
    std::vector<Index> of_unknown;  // 0, 1, ... by lowest unknown
    Index count = 0;

    Parts(const Tets& elements, Index unknowns);
};

struct SemidefiniteSolution {
    Eigen::VectorXd values;  // of mean 0 in each part, weighted by `weights`, per element
    int iterations = 0;
};

// x with matrix x = right up to what is constant in a part; the matrix is symmetric, positive semidefinite, and 0 on
// those. Conjugate gradients with aggregation.hpp: the same bits at any thread count. Throws SolverError.
SemidefiniteSolution solve_semidefinite(const SparseMatrix& matrix, Eigen::VectorXd right, const Parts& parts,
                                        const Tets& elements, const Eigen::VectorXd& weights, int threads);

}  // namespace octafield::volume
