// Normals and tangents as the rotation of stretched frames has to follow them (axes_stretch.hpp).
#pragma once

#include "octafield/volume/axes_stretch.hpp"

namespace octafield::volume {

// A row (xx, yy, zz, yz, xz, xy) of a symmetric matrix.
inline Eigen::Matrix<double, 1, 6> packed(const frames::Matrix3& s) {
    return {s(0, 0), s(1, 1), s(2, 2), s(1, 2), s(0, 2), s(0, 1)};
}

inline frames::Matrix3 unpacked(const Eigen::Matrix<double, 1, 6>& s) {
    frames::Matrix3 full;
    full << s[0], s[5], s[4], s[5], s[1], s[3], s[4], s[3], s[2];
    return full;
}

class StretchedDirections {
public:
    StretchedDirections() : StretchedDirections(frames::Matrix3::Identity()) {}
    explicit StretchedDirections(const frames::Matrix3& stretch);

    frames::Vector3 normal(const frames::Vector3& n) const { return is_identity_ ? n : (stretch_ * n).normalized(); }
    // 0 stays 0: there is no cross direction at vertices in no triangle.
    frames::Vector3 tangent(const frames::Vector3& t) const { return is_identity_ ? t : (inverse_ * t).normalized(); }

private:
    frames::Matrix3 stretch_, inverse_;
    bool is_identity_;
};

StretchedDirections stretched_directions(const Stretches& stretch, Index vertex);

// Throws InvalidInput (kinds "wrong_size", "not_positive") unless there is a positive definite matrix for each of
// `count` vertices.
void require_stretch(const Stretches& stretch, Index count);

// None where there are no rows: frames at right angles. Throws as require_stretch.
const Stretches* stretch_or_none(const Stretches& stretch, Index count);

// Radians in [0, pi / 2] between a direction and the nearest column.
double angle_to_nearest_column(const frames::Matrix3& columns, const frames::Vector3& direction);

}  // namespace octafield::volume
