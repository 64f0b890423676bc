// Real orthonormal spherical harmonics of one degree l: evaluation, rotation, generators, and the invariant of O.
//
// A vector c holds the coefficients of f = sum_m c_m Y_lm, order m = -l..l (no Condon-Shortley phase: Y_11 ~ +x).
// A rotation g acts on functions by (g f)(x) = f(g^-1 x).
#pragma once

#include <array>

#include "octafield/frames/quaternion.hpp"

namespace octafield::frames {

// Instantiated for degrees 2, 4, 6, 8 and 9.
template <int degree>
struct Harmonics {
    static constexpr int size = 2 * degree + 1;
    using Vector = Eigen::Matrix<double, size, 1>;
    using Matrix = Eigen::Matrix<double, size, size>;
    using Derivatives = Eigen::Matrix<double, size, 3>;

    // Y_lm at a unit direction x, equally accurate everywhere: evaluate(R x) = rotation(g) evaluate(x) for R = R(g).
    // Throws InvalidInput unless |x| = 1 to 1e-6.
    static Vector evaluate(const Vector3& direction);

    // Wigner's D in the real basis (Pinchon and Hoggan 2007: turns about z between two constant exchanges of axes).
    // Orthogonal, and rotation(g h) = rotation(g) rotation(h). Throws InvalidInput unless |g| = 1 to 1e-6.
    static Matrix rotation(const Quaternion& g);
    // rotation(g) * c, without forming the matrix: O(l^2). Throws InvalidInput also if c is not finite.
    static Vector rotate(const Quaternion& g, const Vector& c);

    // G_k = d/dt rotation(exp(t e_k)) at t = 0: skew-symmetric, [G_x, G_y] = G_z and so on round,
    // G_x^2 + G_y^2 + G_z^2 = -l (l + 1).
    static const std::array<Matrix, 3>& generators();
    // Columns G_x c, G_y c, G_z c, without the matrices: O(l).
    static Derivatives derivatives(const Vector& c);

    // Unit vector fixed by the 24 rotations of the cube. Degrees 4, 6, 8, 9 have exactly one up to sign (degree 2
    // none: zero vector). Signs: degree 4 as in sh4.hpp; 6 positive at m = 0; 8 positive at m = 0;
    // 9 positive at m = -4.
    static const Vector& octahedral();
};

extern template struct Harmonics<2>;
extern template struct Harmonics<4>;
extern template struct Harmonics<6>;
extern template struct Harmonics<8>;
extern template struct Harmonics<9>;

}  // namespace octafield::frames
