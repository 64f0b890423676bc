// The 24 rotations of the cube and their 48 unit quaternions, the symmetry of a frame.
//
// q and q*o are the same frame for every o in the group: the group acts on the RIGHT.
// Element numbers (the order AlgoHex uses for transitions): 0 identity; 1-3 half turns about x, y, z; 4-9 quarter turns
// about +x, -x, +y, -y, +z, -z; 10-15 half turns about (x+y), (y+z), (z+x), (y-x), (z-y), (x-z); 16-23 third turns
// about the diagonals (+++), (++-), (+-+), (+--), (-++), (-+-), (--+), (---).
#pragma once

#include <array>

#include "octafield/frames/quaternion.hpp"

namespace octafield::frames {

enum class OctahedralClass { identity, half_turn, quarter_turn, edge_half_turn, third_turn };

constexpr int octahedral_order = 24;

const std::array<Quaternion, octahedral_order>& octahedral_group();             // one quaternion (w >= 0) per rotation
const std::array<Quaternion, 2 * octahedral_order>& binary_octahedral_group();  // those, then their negatives
int octahedral_product(int a, int b);                                           // number of o_a * o_b
int octahedral_inverse(int a);
OctahedralClass octahedral_class(int a);

// Number of the element o that brings q1 * o closest to q2: the matching from frame q1 to frame q2.
// matching(q2, q1) is the inverse of matching(q1, q2), except in ties. Of equally close elements the lowest number, up
// to rounding.
int matching(const Quaternion& q1, const Quaternion& q2);

// Geodesic distance of two frames in radians: the angle of the smallest rotation taking one onto the other, in
// [0, 1.0961] (62.7994 degrees: Mackenzie 1958; Handscomb 1958).
double distance(const Quaternion& q1, const Quaternion& q2);

// q * o for the o that brings it closest to `reference`, with the sign that makes the quaternions' dot product
// positive.
Quaternion closest_representative(const Quaternion& q, const Quaternion& reference);

}  // namespace octafield::frames
