// Homogeneous polynomials of degree 4 on R^3, evaluated through their symmetric 6x6 matrix on quadratic monomials.
#pragma once

#include <Eigen/Core>

namespace octafield::frames {

using Vector15 = Eigen::Matrix<double, 15, 1>;

// Exponents (i, j, k) of the 15 monomials x^i y^j z^k, lexicographic from x^4 down to z^4.
inline constexpr int quartic_exponents[15][3] = {{4, 0, 0}, {3, 1, 0}, {3, 0, 1}, {2, 2, 0}, {2, 1, 1},
                                                 {2, 0, 2}, {1, 3, 0}, {1, 2, 1}, {1, 1, 2}, {1, 0, 3},
                                                 {0, 4, 0}, {0, 3, 1}, {0, 2, 2}, {0, 1, 3}, {0, 0, 4}};

// The 15 monomials at x.
Vector15 quartic_monomials(const Eigen::Vector3d& x);
// Their gradient: row r is the gradient of monomial r.
Eigen::Matrix<double, 15, 3> quartic_monomial_gradients(const Eigen::Vector3d& x);

// p(x) = sum_ijkl T_ijkl x_i x_j x_k x_l with T fully symmetric, given by its monomial coefficients.
class Quartic {
public:
    explicit Quartic(const Vector15& coefficients);
    // M_ij = sum_kl T_ijkl x_k x_l. Then p = x.Mx, grad p = 4 M x, Hessian p = 12 M.
    Eigen::Matrix3d contract(const Eigen::Vector3d& x) const;

private:
    Eigen::Matrix<double, 6, 6>
        pairs_;  // rows: entries (xx, yy, zz, yz, zx, xy) of M; columns: monomials of x in the same order
};

}  // namespace octafield::frames
