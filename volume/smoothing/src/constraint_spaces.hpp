// The affine spaces that boundary constraints leave to the sh4 vectors of a field (Ray, Sokolov, Levy 2016, section 3;
// Palmer, Bommes, Solomon 2020, section 4.2).
#pragma once

#include <vector>

#include "block_laplacian.hpp"
#include "octafield/frames/sh4.hpp"
#include "octafield/volume/boundary.hpp"
#include "sh4_field.hpp"

namespace octafield::volume {

// Frames with one fixed axis have the sh4 vectors centre + radius (cos(4t) u + sin(4t) v): a circle in a plane.
class TwistCircle {
public:
    TwistCircle(const frames::Quaternion& reference, const frames::Vector3& axis);

    const frames::Sh4::Vector& centre() const { return centre_; }
    frames::Sh4::Vector in_plane(const frames::Sh4::Vector& v) const { return plane_ * (plane_.transpose() * v); }
    // The point of the circle nearest to a vector; `fallback`, a point of the circle, where all are.
    frames::Sh4::Vector nearest(const frames::Sh4::Vector& v, const frames::Sh4::Vector& fallback) const;
    frames::Quaternion frame(const frames::Sh4::Vector& point) const;  // of a point of the circle

private:
    frames::Quaternion reference_;
    frames::Vector3 axis_;
    frames::Sh4::Vector centre_;
    Eigen::Matrix<double, frames::Sh4::dimension, 2> plane_;  // orthonormal columns u, v
};

// Of one field: nine unknowns at a free vertex, a plane at one with a fixed axis, a point at a fixed one. Vertices of
// no tet count as fixed: no equation tells their frame.
class ConstraintSpaces {
public:
    // frames: (n, 4), on the constraints.
    ConstraintSpaces(const BoundaryConstraints& constraints, const Quaternions& frames,
                     const BlockLaplacian& laplacian);

    VertexConstraint kind(Index v) const { return kind_[v]; }
    const TwistCircle& circle(Index v) const { return circles_[circle_of_[v]]; }
    // The part of a field that the constraints give: centres of circles, fixed vectors, 0 at free vertices.
    const Sh4Field& given() const { return given_; }
    // The part of v that the unknowns of a vertex reach (orthogonal projection; linear).
    frames::Sh4::Vector reached(Index vertex, const frames::Sh4::Vector& v) const {
        switch (kind_[vertex]) {
            case VertexConstraint::free:
                return v;
            case VertexConstraint::axis:
                return circle(vertex).in_plane(v);
            default:
                return frames::Sh4::Vector::Zero();
        }
    }

private:
    std::vector<VertexConstraint> kind_;
    std::vector<Index> circle_of_;  // where kind is axis
    std::vector<TwistCircle> circles_;
    Sh4Field given_;
};

}  // namespace octafield::volume
