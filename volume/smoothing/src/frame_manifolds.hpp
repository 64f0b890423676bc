// Ceres manifolds of unit quaternions (w, x, y, z): rotation from the left by a world rotation vector, and, within it,
// the frames that a constraint allows.
#pragma once

#include <ceres/manifold.h>

#include "octafield/frames/quaternion.hpp"
#include "octafield/volume/constraint_kinds.hpp"

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

inline frames::Quaternion load_quaternion(const double* x) { return {x[0], x[1], x[2], x[3]}; }
inline void store_quaternion(const frames::Quaternion& q, double* x) {
    Eigen::Map<Eigen::Vector4d> row(x);
    row = frames::to_wxyz(q);
}

// The frames that a constraint allows, in its kind's chart. Tangent size 1 or 2: coefficients of its tangents().
template <PartialConstraintKind Kind>
class ConstraintManifold final : public ceres::Manifold {
    static constexpr int unknowns = Kind::unknowns;

public:
    explicit ConstraintManifold(const Kind& kind) : kind_(kind) {}
    int AmbientSize() const override { return 4; }
    int TangentSize() const override { return unknowns; }
    bool Plus(const double* x, const double* delta, double* x_plus_delta) const override {
        store_quaternion(kind_.turned(load_quaternion(x), Eigen::Map<const Turn<unknowns>>(delta)), x_plus_delta);
        return true;
    }
    bool PlusJacobian(const double* x, double* jacobian) const override {  // (4, unknowns) row-major
        Eigen::Map<Eigen::Matrix<double, 4, unknowns, row_major_of(unknowns)>>(jacobian, 4, unknowns) = by_turn(x);
        return true;
    }
    bool Minus(const double* y, const double* x, double* y_minus_x) const override {
        Eigen::Map<Turn<unknowns>> result(y_minus_x);
        result = kind_.turn_between(load_quaternion(x), load_quaternion(y));
        return true;
    }
    bool MinusJacobian(const double* x, double* jacobian) const override {  // (unknowns, 4) row-major
        Eigen::Map<Eigen::Matrix<double, unknowns, 4, Eigen::RowMajor>>(jacobian, unknowns, 4) =
            4 * by_turn(x).transpose();
        return true;
    }

private:
    static constexpr int row_major_of(int columns) { return columns == 1 ? Eigen::ColMajor : Eigen::RowMajor; }
    Eigen::Matrix<double, 4, unknowns> by_turn(const double* x) const {
        Eigen::Matrix<double, 4, 3, Eigen::RowMajor> by_rotation;
        FrameManifold().PlusJacobian(x, by_rotation.data());
        return by_rotation * kind_.tangents(load_quaternion(x));
    }

    Kind kind_;
};

}  // namespace octafield::volume
