// sh4: frames as degree-4 spherical harmonics (Huang et al. 2011; Ray, Sokolov, Levy 2016).
//
// A frame with axes r_1, r_2, r_3 is the vector a with a_m = c (Y_4m(r_1) + Y_4m(r_2) + Y_4m(r_3)), Y_4m the
// orthonormal real spherical harmonics, order m = -4..4, c = sqrt(16 pi / 189) so that |a| = 1. The identity frame has
// sqrt(7/12) at m = 0 and sqrt(5/12) at m = 4. A rotation by t radians about any axis moves a at speed sqrt(20/3).
#pragma once

#include <string_view>

#include "octafield/frames/quaternion.hpp"
#include "octafield/frames/representation.hpp"

namespace octafield::frames {

struct Sh4 {
    static constexpr std::string_view name = "sh4";
    static constexpr int dimension = 9;
    static constexpr BandWeights band_weights = {1, 0, 0};
    static constexpr double speed = 2.581988897471611;  // sqrt(20/3)
    using Vector = Eigen::Matrix<double, dimension, 1>;
    using Differential = Eigen::Matrix<double, dimension, 3>;

    // c Y_4m(direction) for a unit direction, of norm sqrt(4/21): embed(q) is the sum of axis() over the three axes of
    // q.
    static Vector axis(const Vector3& direction);

    static Vector embed(const Quaternion& q);

    // Column k: d/dt embed(exp(t e_k) q) at t = 0, e_k the k-th WORLD axis. Columns are orthogonal with norm
    // sqrt(20/3).
    static Differential differential(const Quaternion& q);

    // Hessian of v . embed(exp(w) q) by w at w = 0.
    static Matrix3 hessian(const Quaternion& q, const Vector& v);

    // The coefficients of the function turned by g: rotate(g, embed(q)) = embed(g q).
    static Vector rotate(const Quaternion& g, const Vector& v);

    // The frame nearest to v in R^9. v = 0 gives the identity. Throws InvalidInput if v is not finite.
    static Projection project(const Vector& v, const Quaternion* guess = nullptr);
};

static_assert(Equivariant<Sh4>);

}  // namespace octafield::frames
