// The model surface of su2 for itself: frames as points h of a 3-dimensional submanifold M of C^3 = R^6, its tangents,
// a retraction and geodesics, from h alone. No quaternion of the frame is computed: what Beaufort (thesis, UCLouvain
// 2019, section 4.4 and conclusion) asks for.
//
// Equations. With A = |h0|^2, B = |h1|^2, E = |h2|^2, C = Re(h0^3 conj(h1)^2), M is where
//   F = h2^2 - h1 (h0^3 - 108 h1^2) = 0           (Klein's relation, complex) and
//   P = 2^-20 sum of 32 monomials in A, B, E, C = 0 (the norm relation, real: src/su2_surface.cpp).
// P is the only polynomial in A, B, E, C that vanishes on M with degree 96 or less in the quaternion, up to a factor
// and Klein's relation (tests/frames/test_su2_norm_relation.py, in exact arithmetic). On M, |dF| > 0, and P grows like
// (|q|^2 - 1) times 0.386 to 0.911: the three real equations are independent everywhere, axes along x and double roots
// included, where |q|^2 as written in Su2::squared_norm has no derivative.
//
// Tangents. e = (8 h0, 12 h1, 18 h2) (Euler) and t = J (-conj(v), conj(u)) span the complex tangents of F = 0, and the
// world rotation vectors x, y, z move h by i e / 2, t / 2, i t / 2. The 2 x 2 minors of J are 8 grad F (Klein's
// Jacobians, in vector form J_u x J_v), so that e x t = 8 grad F, and P does not change along t. These two determine t:
//   t = s - (p . s) / (p . e) e,   s = 8 grad F x conj(e) / |e|^2,   p = dP/dh.
// The metric of angles is the one in which the three are orthonormal; no metric tensor is inverted.
#pragma once

#include <optional>

#include "octafield/frames/su2.hpp"

namespace octafield::frames::su2_surface {

// re F, im F, P.
Vector3 residual(const Su2::Vector& h);

// A point of M and, columns, how world rotation vectors move it: Su2::differential of its frames.
struct Point {
    Su2::Vector h;
    Su2::Differential turns;
};
Point point(const Su2::Vector& h);

// The rotation vector whose motion is nearest to `step` (in C^3), and its matrix: the pseudo-inverse of `turns`.
Vector3 turn_of(const Su2::Differential& turns, const Su2::Vector& step);
Eigen::Matrix<double, 3, 6> inverse_turns(const Su2::Differential& turns);

// The point of M that Gauss-Newton steps on the equations, each the shortest, lead to. None if they do not converge.
std::optional<Su2::Vector> restored(const Su2::Vector& h);

// Retraction: an ambient step and what restores it to M, twice (the midpoint rule): the middle from h + turns(h) w / 2,
// the end from h + turns(middle) w. Of second order in the metric of angles: O(|w|^3) from the geodesic. (A single step
// with its orthogonal projection is of second order in the metric of C^3, and in that of angles of first order only.)
// Beyond 0.05 radians, and where it fails, in halves. None beyond 20 radians.
std::optional<Su2::Vector> retracted(const Su2::Vector& h, const Vector3& w);
// w such that retracted(h, w) = k, by iteration. None if that does not converge: k is too far from h.
std::optional<Vector3> turn_between(const Su2::Vector& h, const Su2::Vector& k);

// Rotation vector of the shortest geodesic from p to q. A path of points of M is bisected; over each piece, its ends
// and its middle m, the collocation h(q) - h(p) = (turns(p) + 4 turns(m) + turns(q)) / 6 w (Simpson) gives w to fourth
// order. The rotations of the pieces compose to that from p to q whichever the path, since the connection that the
// tangents make is flat; extrapolated (Romberg) until two levels agree to 1e-7, with errors of the order of 1e-9.
// None if they do not, or if the result is longer than 40 degrees. Any shorter one is the shortest: with another path
// it closes a loop, which turns by 90 degrees at least. Finds all up to 15 degrees, 99 % at 20, none beyond 40
// (tests/frames/su2_surface_test.cpp).
std::optional<Vector3> log(const Point& p, const Point& q);

}  // namespace octafield::frames::su2_surface
