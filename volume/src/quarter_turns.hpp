// The type of a singularity from its holonomy.
#pragma once

#include "octafield/frames/octahedral_group.hpp"

namespace octafield::volume {

// Quarter turns of a frame that comes back as itself times `element`, turned forward about `axis` (world axes), about a
// curve that runs along `along`: positive when it turns about that direction, the way the loop goes round it; 0: complex.
inline int quarter_turns(int element, const Eigen::Vector3d& axis, const Eigen::Vector3d& along) {
    const frames::OctahedralClass kind = frames::octahedral_class(element);
    if (kind != frames::OctahedralClass::half_turn && kind != frames::OctahedralClass::quarter_turn) return 0;
    const int size = kind == frames::OctahedralClass::half_turn ? 2 : 1;
    return along.dot(axis) < 0 ? -size : size;
}

}  // namespace octafield::volume
