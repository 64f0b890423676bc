// Normals and tangents as the rotation of stretched frames has to follow them (axes_stretch.hpp).
#pragma once

#include "octafield/volume/axes_stretch.hpp"

namespace octafield::volume {

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

}  // namespace octafield::volume
