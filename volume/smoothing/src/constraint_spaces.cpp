#include "constraint_spaces.hpp"

#include <cmath>
#include <numbers>

namespace octafield::volume {

using frames::Quaternion;
using frames::Sh4;
using frames::Vector3;
using frames::Vector4;

namespace {

// Of every circle: rotations about the fixed axis move the m = 4 part alone, whose share of the unit vector this is.
const double radius = std::sqrt(5.0 / 12.0);

}  // namespace

TwistCircle::TwistCircle(const Quaternion& reference, const Vector3& axis) : reference_(reference), axis_(axis) {
    const auto turned = [&](double angle) { return Sh4::embed(frames::exp(angle * axis) * reference); };
    const Sh4::Vector start = turned(0);
    centre_ = (start + turned(std::numbers::pi / 4)) / 2;
    plane_.col(0) = (start - centre_).normalized();
    plane_.col(1) = (turned(std::numbers::pi / 8) - centre_).normalized();
}

Sh4::Vector TwistCircle::nearest(const Sh4::Vector& v, const Sh4::Vector& fallback) const {
    const Eigen::Vector2d part = plane_.transpose() * v;
    const double length = part.norm();
    if (!(length > 1e-14)) return fallback;
    return centre_ + radius / length * (plane_ * part);
}

Quaternion TwistCircle::frame(const Sh4::Vector& point) const {
    const Eigen::Vector2d part = plane_.transpose() * point;
    return (frames::exp(std::atan2(part[1], part[0]) / 4 * axis_) * reference_).normalized();
}

ConstraintSpaces::ConstraintSpaces(const BoundaryConstraints& constraints, const Quaternions& frames,
                                   const BlockLaplacian& laplacian)
    : kind_(constraints.kind), circle_of_(constraints.kind.size(), -1) {
    given_ = Sh4Field::Zero(frames.rows(), Sh4::dimension);
    for (Index v = 0; v < frames.rows(); ++v) {
        const Quaternion q = frames::from_wxyz(Vector4(frames.row(v).transpose()));
        if (laplacian.is_isolated(v)) kind_[v] = VertexConstraint::fixed;
        if (kind_[v] == VertexConstraint::fixed) given_.row(v) = Sh4::embed(q).transpose();
        if (kind_[v] != VertexConstraint::axis) continue;
        circle_of_[v] = static_cast<Index>(circles_.size());
        circles_.emplace_back(q, Vector3(constraints.axis.row(v).transpose()));
        given_.row(v) = circles_.back().centre().transpose();
    }
}

}  // namespace octafield::volume
