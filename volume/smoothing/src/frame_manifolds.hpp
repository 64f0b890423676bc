// Ceres manifolds of unit quaternions (w, x, y, z): rotation from the left by a world rotation vector.
// Tangents are world rotation vectors, so constraints read off directly: a twist about a fixed axis is one number.
#pragma once

#include <ceres/manifold.h>

#include "octafield/frames/quaternion.hpp"

namespace octafield::volume {

// q [+] w = exp(w) q, w in R^3 (radians, world axes). Tangent size 3.
class FrameManifold final : public ceres::Manifold {
public:
    int AmbientSize() const override { return 4; }
    int TangentSize() const override { return 3; }
    bool Plus(const double* x, const double* delta, double* x_plus_delta) const override;
    bool PlusJacobian(const double* x, double* jacobian) const override;  // (4, 3) row-major
    bool Minus(const double* y, const double* x, double* y_minus_x) const override;
    bool MinusJacobian(const double* x,
                       double* jacobian) const override;  // (3, 4) row-major, left inverse of PlusJacobian
};

// q [+] t = exp(t axis) q: keeps whatever of q is aligned with `axis` (unit, world) aligned. Tangent size 1.
class TwistManifold final : public ceres::Manifold {
public:
    explicit TwistManifold(const frames::Vector3& axis) : axis_(axis) {}
    int AmbientSize() const override { return 4; }
    int TangentSize() const override { return 1; }
    bool Plus(const double* x, const double* delta, double* x_plus_delta) const override;
    bool PlusJacobian(const double* x, double* jacobian) const override;             // (4, 1)
    bool Minus(const double* y, const double* x, double* y_minus_x) const override;  // component along the axis
    bool MinusJacobian(const double* x, double* jacobian) const override;            // (1, 4)

private:
    frames::Vector3 axis_;
};

}  // namespace octafield::volume
