// The type of a singularity from its lifted holonomy.
#pragma once

#include <cmath>

#include "octafield/frames/octahedral_lift.hpp"

namespace octafield::volume {

// How a frame q comes back that returns as q times the element `lift` of the binary octahedral group, counted modulo
// 4 pi.
struct Turn {
    int size;              // quarter turns forward about `axis`, 1 to 4; 0: none, or about no axis of the frame (complex)
    frames::Vector3 axis;  // world axes, unit; zero where size is 0 or 4
};

inline Turn turn_of(int lift, const frames::Quaternion& q) {
    const frames::Quaternion& h = frames::binary_octahedral_group()[lift];
    switch (frames::octahedral_class(frames::holonomy_of(lift))) {
        case frames::OctahedralClass::identity:
            return {lift == 0 ? 0 : 4, frames::Vector3::Zero()};
        case frames::OctahedralClass::half_turn:
            return {2, q * h.vec().normalized()};
        case frames::OctahedralClass::quarter_turn:
            return {h.w() > 0 ? 1 : 3, q * h.vec().normalized()};
        default:
            return {0, frames::Vector3::Zero()};
    }
}

// Quarter turns about a curve that runs along `along`: positive when the frame turns about that direction, the way the
// loop goes round it. A whole turn has no axis; it is -4, valence 8, as +4 would leave no hexahedra. 0: complex.
inline int quarter_turns(const Turn& turn, const Eigen::Vector3d& along) {
    return turn.size == 4 || along.dot(turn.axis) < 0 ? -turn.size : turn.size;
}

// Whether the axis of the turn is at right angles to the curve, to 1e-6 radians: the sign of the turns is chance.
inline bool across(const Turn& turn, const Eigen::Vector3d& along) {
    return turn.size > 0 && turn.size < 4 && std::abs(along.dot(turn.axis)) <= 1e-6 * along.norm();
}

}  // namespace octafield::volume
