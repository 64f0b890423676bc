// A kind of constraint outside the library (docs/extend.md): one axis of the frame lies in a plane, as
// fibres do in their ply.
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "octafield/volume/constraint_kinds.hpp"

namespace example {

using octafield::frames::Quaternion;
using octafield::frames::Sh4;
using octafield::frames::Vector3;
using octafield::volume::TangentBasis;
using octafield::volume::Turn;

// --8<-- [start:kind]
// Frames with an axis across the given one, the normal of the plane. The axis turns in the plane, the frame about the
// axis: two unknowns.
struct InPlane {
    static constexpr std::string_view name = "plane",
                                      meaning = "one axis of the frame is orthogonal to the given direction";
    static constexpr int unknowns = 2, held_lengths = 0;
    static constexpr bool takes_axis = true, takes_frame = false;
    class Space;

    explicit InPlane(const octafield::volume::SiteConstraint& given) : normal(given.axis) {}

    // By the least rotation that brings the axis nearest to the plane into it.
    Quaternion moved(const Quaternion& q) const {
        const Vector3 axis = q * Vector3::Unit(nearest_axis(q));
        const Vector3 across = axis - axis.dot(normal) * normal;
        return (octafield::frames::rotation_between(axis, across) * q).normalized();
    }
    TangentBasis<2> tangents(const Quaternion& q) const {
        TangentBasis<2> basis;
        basis << normal, q * Vector3::Unit(nearest_axis(q));
        return basis;
    }
    Quaternion turned(const Quaternion& q, const Turn<2>& turn) const {
        const Vector3 axis = q * Vector3::Unit(nearest_axis(q));
        return (octafield::frames::exp(turn[0] * normal) * octafield::frames::exp(turn[1] * axis) * q).normalized();
    }
    Turn<2> turn_between(const Quaternion& from, const Quaternion& to) const {
        const int k = nearest_axis(from);
        const Vector3 before = from * Vector3::Unit(k), after = to * Vector3::Unit(k);
        const double in_plane = std::atan2(normal.dot(before.cross(after)), before.dot(after));
        const Quaternion rest = octafield::frames::exp(-in_plane * normal) * to * from.conjugate();
        return {in_plane, before.dot(octafield::frames::log(rest))};
    }
    std::array<int, 3> length_columns(const Quaternion&) const { return {-1, -1, -1}; }

    int nearest_axis(const Quaternion& q) const {
        int axis = 0;
        (q.conjugate() * normal).cwiseAbs().minCoeff(&axis);
        return axis;
    }
    Vector3 normal;
};
// --8<-- [end:kind]

// --8<-- [start:space]
// Their sh4 vectors lie in no smaller linear space.
class InPlane::Space {
public:
    Space(const InPlane& kind, const Quaternion& reference) : kind_(kind), reference_(reference) {}
    Sh4::Vector centre() const { return Sh4::Vector::Zero(); }
    Sh4::Vector reached(const Sh4::Vector& v) const { return v; }
    Quaternion frame(const Sh4::Vector& point) const { return kind_.moved(Sh4::project(point).frame); }

    // All have norm 1, so that the nearest has the largest product with v: Newton's method from every local maximum on
    // a grid.
    Sh4::Vector nearest(const Sh4::Vector& v, const Sh4::Vector& fallback) const {
        if (!(v.norm() > 1e-14)) return fallback;
        constexpr int turns = 36, twists = 18;
        const auto at = [](int i, int j) {
            return Turn<2>{i * std::numbers::pi / turns, j * std::numbers::pi / 2 / twists};
        };
        std::vector<double> value(turns * twists);
        const auto known = [&](int i, int j) { return value[(i + turns) % turns * twists + (j + twists) % twists]; };
        for (int i = 0; i < turns; ++i)
            for (int j = 0; j < twists; ++j)
                value[i * twists + j] = v.dot(Sh4::embed(kind_.turned(reference_, at(i, j))));
        Sh4::Vector best = fallback;
        for (int i = 0; i < turns; ++i)
            for (int j = 0; j < twists; ++j) {
                if (known(i, j) < std::max({known(i + 1, j), known(i - 1, j), known(i, j + 1), known(i, j - 1)}) &&
                    i % (turns - 1) != 0)
                    continue;
                const Sh4::Vector found = Sh4::embed(climbed(kind_.turned(reference_, at(i, j)), v));
                if (v.dot(found) > v.dot(best)) best = found;
            }
        return best;
    }

private:
    Quaternion climbed(Quaternion q, const Sh4::Vector& v) const {
        for (int step = 0; step < 30; ++step) {
            const TangentBasis<2> basis = kind_.tangents(q);
            const Vector3 slope = Sh4::differential(q).transpose() * v;
            Eigen::Matrix2d curvature = basis.transpose() * Sh4::hessian(q, v) * basis;
            const double mixed = basis.col(0).cross(basis.col(1)).dot(slope) / 2;  // the two turns do not commute
            curvature(0, 1) += mixed, curvature(1, 0) += mixed;
            const Turn<2> gradient = basis.transpose() * slope;
            const Eigen::Matrix2d down = -curvature;
            const bool maximum = down(0, 0) > 0 && down.determinant() > 0;
            Turn<2> turn = maximum ? Turn<2>(down.inverse() * gradient) : Turn<2>(gradient / (20 * v.norm()));
            while (turn.norm() > 1e-9 && v.dot(Sh4::embed(kind_.turned(q, turn))) < v.dot(Sh4::embed(q))) turn /= 2;
            q = kind_.turned(q, turn);
            if (turn.norm() < 1e-12) break;
        }
        return q;
    }

    InPlane kind_;
    Quaternion reference_;
};
// --8<-- [end:space]

static_assert(octafield::volume::ConstraintKind<InPlane>);

}  // namespace example
