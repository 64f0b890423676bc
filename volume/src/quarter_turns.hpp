// The type of a singularity from its holonomy.
#pragma once

#include "octafield/frames/octahedral_group.hpp"

namespace octafield::volume {

// Quarter turns of a frame q, which comes back as q `element`, about a curve that runs along `along`: positive when the
// frame turns about that direction, the way the loop goes round it; 0: complex.
inline int quarter_turns(int element, const frames::Quaternion& q, const Eigen::Vector3d& along) {
    switch (frames::octahedral_class(element)) {
        case frames::OctahedralClass::half_turn:
            return 2;
        case frames::OctahedralClass::quarter_turn:
            return along.dot(q * frames::octahedral_group()[element].vec()) < 0 ? -1 : 1;
        default:
            return 0;
    }
}

}  // namespace octafield::volume
