// The unknowns that are not held, and the stiffness matrix between them: complex Hermitian, or in real form for what is
// not complex-linear (the second derivative of Ginzburg-Landau).
#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "crouzeix_raviart.hpp"

namespace octafield::surface::detail {

class FreeSystem {
public:
    using Matrix = Eigen::SparseMatrix<Complex>;
    using RealMatrix = Eigen::SparseMatrix<double>;

    // `held` (E): edges whose value is given.
    FreeSystem(const std::vector<CornerLink>& links, const std::vector<bool>& held);

    Index size() const { return static_cast<Index>(edges_.size()); }
    const std::vector<Index>& edges() const { return edges_; }  // of the unknowns, ascending

    // Lower triangle of the stiffness matrix between free unknowns; each column starts with its diagonal entry.
    const Matrix& stiffness() const { return stiffness_; }
    Eigen::VectorXd diagonal() const;  // (size)

    Eigen::VectorXcd gather(const Eigen::VectorXcd& values) const;  // (E) -> (size)
    Eigen::VectorXd gather(const Eigen::VectorXd& values) const;
    Eigen::VectorXcd scatter(const Eigen::VectorXcd& unknowns,
                             Eigen::Index edges) const;  // (size) -> (E), held edges 0

    // A fill-reducing elimination order, the same on every run and thread.
    Eigen::VectorXi elimination_order() const;

    // Real form, (2 size): unknown i has the real part 2i and the imaginary part 2i + 1, as an array of complex numbers
    // has them in memory. Lower triangle; the 2 x 2 diagonal blocks are stored in full.
    RealMatrix real_stiffness() const;
    static Eigen::VectorXi real_order(const Eigen::VectorXi& order);
    // Makes [a b; b c] the diagonal block of unknown i.
    static void set_diagonal(RealMatrix& matrix, Index i, double a, double b, double c) {
        double* column = matrix.valuePtr() + matrix.outerIndexPtr()[2 * i];
        column[0] = a;
        column[1] = b;
        matrix.valuePtr()[matrix.outerIndexPtr()[2 * i + 1]] = c;
    }

private:
    std::vector<Index> edges_;
    Matrix stiffness_;
};

// The same numbers as real and imaginary parts in turn.
inline Eigen::Map<const Eigen::VectorXd> as_real(const Eigen::VectorXcd& values) {
    return {reinterpret_cast<const double*>(values.data()), 2 * values.size()};
}
inline Eigen::VectorXcd as_complex(const Eigen::VectorXd& parts) {
    return Eigen::Map<const Eigen::VectorXcd>(reinterpret_cast<const Complex*>(parts.data()), parts.size() / 2);
}

}  // namespace octafield::surface::detail
