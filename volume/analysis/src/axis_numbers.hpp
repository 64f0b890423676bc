// The six directions of a frame's axes by number.
#pragma once

#include <array>

#include "octafield/arrays.hpp"
#include "octafield/frames/octahedral_group.hpp"

namespace octafield::volume {

// 0, 1, 2: +x, +y, +z of the frame; 3, 4, 5: their negatives.
inline constexpr int axis_count = 6;
inline int opposite_axis(int axis) { return (axis + 3) % axis_count; }

inline frames::Vector3 axis_unit(int axis) { return (axis < 3 ? 1 : -1) * frames::Vector3::Unit(axis % 3); }

inline int nearest_axis_number(const frames::Vector3& in_frame) {
    Eigen::Index largest;
    in_frame.cwiseAbs().maxCoeff(&largest);
    return static_cast<int>(largest) + (in_frame[largest] < 0 ? 3 : 0);
}

// Numbers of the elements 4 to 9, about +x, -x, +y, -y, +z, -z, by the axis they turn about, and back.
inline int quarter_turn_about(int axis) { return 4 + 2 * (axis % 3) + axis / 3; }
inline int axis_of_quarter_turn(int element) { return (element - 4) / 2 + 3 * (element % 2); }

// Number of o a, for the element o of the octahedral group and the axis a.
inline int turned_axis(int element, int axis) {
    static const auto table = [] {
        std::array<std::array<int, axis_count>, frames::octahedral_order> t;
        for (int o = 0; o < frames::octahedral_order; ++o)
            for (int a = 0; a < axis_count; ++a)
                t[o][a] = nearest_axis_number(frames::octahedral_group()[o] * axis_unit(a));
        return t;
    }();
    return table[element][axis];
}

}  // namespace octafield::volume
