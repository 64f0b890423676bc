// Starts of the nearest-frame search that su2 knows of: the inverse map applied off the model surface.
#pragma once

#include <vector>

#include "octafield/frames/su2.hpp"

namespace octafield::frames {

// Unit quaternions, none for points where the inverse map breaks down. h finite.
std::vector<Quaternion> su2_starts(const Complex3& h);

}  // namespace octafield::frames
