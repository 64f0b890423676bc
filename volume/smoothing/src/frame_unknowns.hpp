// What stands for the frame of a site among the unknowns of a metric scheme: a row of numbers, with Ceres' manifolds.
#pragma once

#include "frame_manifolds.hpp"
#include "octafield/frames/octahedral_group.hpp"
#include "octafield/frames/su2_surface.hpp"

namespace octafield::volume {

// Unit quaternions w x y z.
struct QuaternionUnknowns {
    static constexpr int size = 4;
    using FreeManifold = FrameManifold;
    template <PartialConstraintKind Kind>
    using HeldManifold = ConstraintManifold<Kind>;
    using Point = frames::Quaternion;  // as schemes see it

    static frames::Vector4 row(const frames::Quaternion& q) { return frames::to_wxyz(q); }
    static Point point(const double* x) { return load_quaternion(x); }
    static frames::Quaternion frame(const double* x) { return load_quaternion(x); }
};

// Points of the model surface of su2 in R^6 (frames/su2_surface.hpp), moved on it by world rotation vectors. Tangent
// size 3.
class SurfaceManifold final : public ceres::Manifold {
public:
    using Row = frames::Su2::Vector;
    int AmbientSize() const override { return 6; }
    int TangentSize() const override { return 3; }
    bool Plus(const double* x, const double* delta, double* x_plus_delta) const override {
        const auto moved = frames::su2_surface::retracted(load(x), frames::Vector3(delta));
        if (moved) Eigen::Map<Row>(x_plus_delta, 6) = *moved;
        return moved.has_value();  // else Ceres takes a shorter step
    }
    bool PlusJacobian(const double* x, double* jacobian) const override {  // (6, 3) row-major
        Eigen::Map<Eigen::Matrix<double, 6, 3, Eigen::RowMajor>>(jacobian, 6, 3) =
            frames::su2_surface::point(load(x)).turns;
        return true;
    }
    bool Minus(const double* y, const double* x, double* y_minus_x) const override {
        const auto turn = frames::su2_surface::turn_between(load(x), load(y));
        if (turn) Eigen::Map<frames::Vector3>(y_minus_x, 3) = *turn;
        return turn.has_value();
    }
    bool MinusJacobian(const double* x, double* jacobian) const override {  // (3, 6) row-major
        Eigen::Map<Eigen::Matrix<double, 3, 6, Eigen::RowMajor>>(jacobian, 3, 6) =
            frames::su2_surface::inverse_turns(frames::su2_surface::point(load(x)).turns);
        return true;
    }
    static Row load(const double* x) { return Eigen::Map<const Row>(x, 6); }
};

// The points of the model surface that a constraint allows: for a held axis a closed curve (Su2Axis). A kind is
// described by frames (constraint_kinds.hpp), so its chart is read through the inverse map; a kind knows no other.
template <PartialConstraintKind Kind>
class HeldSurfaceManifold final : public ceres::Manifold {
    static constexpr int unknowns = Kind::unknowns;

public:
    explicit HeldSurfaceManifold(const Kind& kind) : kind_(kind) {}
    int AmbientSize() const override { return 6; }
    int TangentSize() const override { return unknowns; }
    bool Plus(const double* x, const double* delta, double* x_plus_delta) const override {
        const frames::Quaternion turned = kind_.turned(frame(x), Eigen::Map<const Turn<unknowns>>(delta));
        // The inverse map's rounding does not add up.
        Eigen::Map<frames::Su2::Vector>(x_plus_delta, 6) = frames::Su2::embed(kind_.moved(turned));
        return true;
    }
    bool PlusJacobian(const double* x, double* jacobian) const override {  // (6, unknowns) row-major
        Eigen::Map<Eigen::Matrix<double, 6, unknowns, unknowns == 1 ? Eigen::ColMajor : Eigen::RowMajor>>(
            jacobian, 6, unknowns) = point(x).turns * kind_.tangents(frame(x));
        return true;
    }
    bool Minus(const double* y, const double* x, double* y_minus_x) const override {
        const frames::Quaternion p = frame(x);
        Eigen::Map<Turn<unknowns>> result(y_minus_x);
        result = kind_.turn_between(p, frames::closest_representative(frame(y), p));
        return true;
    }
    bool MinusJacobian(const double* x, double* jacobian) const override {  // (unknowns, 6) row-major
        Eigen::Map<Eigen::Matrix<double, unknowns, 6, Eigen::RowMajor>>(jacobian, unknowns, 6) =
            kind_.tangents(frame(x)).transpose() * frames::su2_surface::inverse_turns(point(x).turns);
        return true;
    }

private:
    static frames::Quaternion frame(const double* x) {
        return frames::Su2::inverse_frame(frames::Su2::complex(SurfaceManifold::load(x)));
    }
    static frames::su2_surface::Point point(const double* x) {
        return frames::su2_surface::point(SurfaceManifold::load(x));
    }

    Kind kind_;
};

// Points (re, im of h0, h1, h2) of the model surface.
struct SurfaceUnknowns {
    static constexpr int size = 6;
    using FreeManifold = SurfaceManifold;
    template <PartialConstraintKind Kind>
    using HeldManifold = HeldSurfaceManifold<Kind>;
    using Point = frames::Su2::Vector;

    static Point row(const frames::Quaternion& q) { return frames::Su2::embed(q); }
    static Point point(const double* x) { return SurfaceManifold::load(x); }
    static frames::Quaternion frame(const double* x) {
        return frames::Su2::inverse_frame(frames::Su2::complex(point(x)));
    }
};

}  // namespace octafield::volume
