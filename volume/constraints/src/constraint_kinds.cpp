#include "octafield/volume/constraint_kinds.hpp"

#include <cmath>
#include <numbers>

namespace octafield::volume {

using frames::Quaternion;
using frames::Sh4;
using frames::Vector3;

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

Quaternion FixedAxis::moved(const Quaternion& q) const {
    const Vector3 local = q.conjugate() * axis;
    int nearest = 0;
    local.cwiseAbs().maxCoeff(&nearest);
    const Vector3 from =
        q * Vector3(local[nearest] < 0 ? Vector3(-Vector3::Unit(nearest)) : Vector3(Vector3::Unit(nearest)));
    return (frames::rotation_between(from, axis) * q).normalized();
}

std::array<int, 3> FixedAxis::length_columns(const Quaternion& q) const {
    int held = 0;
    (q.conjugate() * axis).cwiseAbs().maxCoeff(&held);
    std::array<int, 3> columns = {-1, -1, -1};
    columns[held] = 0;
    return columns;
}

std::string listed_kinds() {
    std::string text;
    for (std::size_t k = 0; k < ConstraintKinds::info.size(); ++k)
        text += (k ? ", " : "") + std::to_string(k) + " " + std::string(ConstraintKinds::info[k].name);
    return text;
}

}  // namespace octafield::volume
