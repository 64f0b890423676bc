// Proven upper bounds of F(q) = v . embed(q), |v| = 1, near a quaternion.
//
// With f, g, H the value, gradient and Hessian of u -> F(q exp(u)) at 0, for |u| <= rho
//     F(q exp(u)) = f + g.u + 1/2 u.Hu + C(u) + Q(u), where
// - g.u + 1/2 u.Hu <= 1/2 g.(mu - H)^-1 g + 1/2 mu rho^2 for any mu >= 0 that makes mu - H positive definite;
// - C(u) = 1/6 w . G_u^3 a, w = v in body coordinates, a the identity frame, G_u the generator of turns about u. G_u^3
// a
//   has parts only in the representations T_1 and T_2 of O. That of T_1 is at most |G_u^3 a| <= 16 sqrt(20/3): with m
//   the orders of a about the axis u, weighted by their squared coefficients, <m^2> = 20/3 (isotropy) and m^2 <= 16
//   give <m^(2k)> <= 16^(k-1) 20/3. That of T_2 is sqrt(945) (u_1 (u_2^2 - u_3^2), ...), the one covariant of its kind,
//   of length at most sqrt(945) / 2. The parts of w are g / sqrt(20/3) and (h_23, h_31, h_12) / sqrt(35/3). So
//   C(u) <= (16 |g| + sqrt(945)/2 sqrt(3/35) |(h_23, h_31, h_12)|) rho^3 / 6;
// - Q(u) <= max |F''''| rho^4 / 24 along the geodesic, and |F''''| <= |G_u^4 a| <= sqrt(16^3 20/3).
// Rounding errors of f, g and H, below 1e-14, are covered by `rounding`.
#pragma once

#include "octafield/frames/quaternion.hpp"

namespace octafield::frames::sh4 {

constexpr double rounding = 1e-13;

struct LocalExpansion {
    double value;
    Vector3 gradient;
    Matrix3 hessian;
};

// Upper bound of F on the ball |u| <= rho. No effort is made to get below `enough`.
double upper_bound(const LocalExpansion& e, double rho, double enough);

// For a critical point: radius of a ball in which F stays below f + |g| radius, 0 if the Hessian is not negative
// definite.
double radius_below(const LocalExpansion& e);

}  // namespace octafield::frames::sh4
