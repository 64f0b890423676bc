// The unknowns that are not held, as a real system of twice their number, and its matrices' common pattern.
#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "crouzeix_raviart.hpp"

namespace octafield::surface::detail {

// Free edge number i has the real unknowns 2i (real part) and 2i + 1 (imaginary part).
class FreeSystem {
public:
    using Matrix = Eigen::SparseMatrix<double>;

    // `held` (E): edges whose value is given.
    FreeSystem(const std::vector<CornerLink>& links, const std::vector<bool>& held);

    Index size() const { return static_cast<Index>(edges_.size()); }
    const std::vector<Index>& edges() const { return edges_; }

    // Lower triangle of the stiffness matrix between free unknowns; the 2 x 2 diagonal blocks are stored in full.
    const Matrix& stiffness() const { return stiffness_; }

    // Adds the symmetric block [a b; b c] to the diagonal of free edge i, in a matrix of the stiffness's pattern.
    static void add_to_diagonal(Matrix& matrix, Index i, double a, double b, double c) {
        double* column = matrix.valuePtr() + matrix.outerIndexPtr()[2 * i];
        column[0] += a;
        column[1] += b;
        matrix.valuePtr()[matrix.outerIndexPtr()[2 * i + 1]] += c;
    }

    Eigen::VectorXd gather(const Eigen::VectorXcd& values) const;  // (E) -> (2 size)
    Eigen::VectorXcd scatter(const Eigen::VectorXd& unknowns,
                             Eigen::Index edges) const;  // (2 size) -> (E), held edges 0

    // A fill-reducing elimination order of the real unknowns, both parts of an edge side by side.
    Eigen::VectorXi elimination_order() const;

private:
    std::vector<Index> edges_;  // free edges, ascending
    Matrix stiffness_;
};

}  // namespace octafield::surface::detail
