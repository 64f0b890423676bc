// How far directions at boundary vertices are from the axes of their frames.
#pragma once

#include <vector>

#include "octafield/frames/quaternion.hpp"
#include "octafield/volume/tet_domain.hpp"

namespace octafield::volume {

// Between a unit direction and the nearest of the frame's six axis directions (radians).
double angle_to_nearest_axis(const frames::Quaternion& frame, const frames::Vector3& direction);

// Radians, one per direction; `vertex`: boundary-mesh ids, `direction`: (k, 3) unit, `frames`: one per tet-mesh vertex.
// Throws InvalidInput for frames that are missing or not unit.
Eigen::VectorXd angles_to_nearest_axis(const BoundarySurface& surface, const std::vector<Index>& vertex,
                                       const Points& direction, const Quaternions& frames);

}  // namespace octafield::volume
