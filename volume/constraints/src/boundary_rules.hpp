// Frames that follow several directions, at vertices and tets of the surface.
#pragma once

#include <vector>

#include "octafield/frames/quaternion.hpp"

namespace octafield::volume {

using Directions = std::vector<frames::Vector3>;  // unit

// Whether each direction has an axis of the frame within `tolerance` (radians).
bool fits(const frames::Quaternion& frame, const Directions& directions, double tolerance);

// The frame whose axes best follow all the directions: it maximises the sum over them of the frame's quartic.
frames::Quaternion best_frame(const Directions& directions);

}  // namespace octafield::volume
