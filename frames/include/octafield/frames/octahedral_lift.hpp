// Matchings lifted to the 48 unit quaternions of the binary octahedral group, which count turns modulo 4 pi.
//
// The step from a frame to the next is the smallest rotation between them, at most 62.8 degrees, so its quaternion of
// positive real part is the path itself. Products of such quaternions round a loop are elements of the binary group
// that tell a turn by +pi about an axis from one by -pi, and pi/2 from -3 pi/2: the class of the loop in the fundamental
// group of SO(3)/O, which is the binary octahedral group (docs/analysis.md).
// Elements are numbered as binary_octahedral_group(): 0-23 those of octahedral_group(), 24-47 their negatives.
#pragma once

#include "octafield/frames/octahedral_group.hpp"

namespace octafield::frames {

int lifted_product(int a, int b);
int lifted_inverse(int a);
inline int holonomy_of(int lift) { return lift % octahedral_order; }  // of octahedral_group()

struct LiftedMatching {
    int element;  // q1 * o is the quaternion of frame q1 closest to q2; element % 24 is matching(q1, q2)
    bool tie;     // another element of the octahedral group comes as close, to 1e-6 radians: which one was chosen is chance
};
LiftedMatching lifted_matching(const Quaternion& q1, const Quaternion& q2);

}  // namespace octafield::frames
