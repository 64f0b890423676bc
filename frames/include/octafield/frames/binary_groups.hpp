// Finite groups of unit quaternions and their invariant forms (Klein 1884; Du Val 1964, sections 20 and 39; Beaufort,
// thesis, UCLouvain 2019, chapter 4).
//
// A quaternion is the pair u = q0 + i q1, v = q2 + i q3, that is q = u + v j. Multiplication on the RIGHT by a + b j
// maps (u, v) linearly to (u a - v conj(b), u b + v conj(a)). Each group has three homogeneous polynomials f0, f1, f2
// in (u, v) that it leaves unchanged, joined by one relation f2^2 = P(f0, f1); two quaternions have equal invariants
// exactly if they differ by a group element. The axis n of a rotation in the group is the pair of roots of the form
// (n_y + i n_z) u^2 - 2 i n_x u v + (n_y - i n_z) v^2: u v for x, u^2 + v^2 for y, u^2 - v^2 for z.
#pragma once

#include <array>
#include <complex>
#include <string_view>
#include <vector>

#include "octafield/frames/quaternion.hpp"

namespace octafield::frames {

using Complex = std::complex<double>;
using Complex3 = Eigen::Matrix<Complex, 3, 1>;

enum class BinaryGroup { vierer, tetrahedral, octahedral, icosahedral };

inline constexpr std::array all_binary_groups = {BinaryGroup::vierer, BinaryGroup::tetrahedral, BinaryGroup::octahedral,
                                                 BinaryGroup::icosahedral};

std::string_view name_of(BinaryGroup group);      // "vierer", ...
BinaryGroup binary_group(std::string_view name);  // throws InvalidInput that lists the names

// All elements: 8, 24, 48, 120 unit quaternions, the identity first. Vierer < tetrahedral < octahedral (these in the
// order of binary_octahedral_group()), and tetrahedral < icosahedral: the icosahedron whose 2-fold axes include x, y, z
// and whose vertices are the cyclic permutations of (0, +-golden ratio, +-1).
const std::vector<Quaternion>& elements(BinaryGroup group);

// Rotation orders (p, q, 2) of three generators with a^p = b^q = c^2 = abc = -1 (thesis 4.16, 4.17), and those: half
// angles pi/p, pi/q, pi/2. (2, 2, 2), (3, 3, 2), (4, 3, 2), (5, 3, 2).
struct Generators {
    int p, q;
    Quaternion a, b, c;
};
Generators generators(BinaryGroup group);

// Degrees of f0, f1, f2: (4, 4, 6), (6, 8, 12), (8, 12, 18), (12, 20, 30).
std::array<int, 3> invariant_degrees(BinaryGroup group);

// f0, f1, f2 at q, which need not be a unit quaternion; throws InvalidInput if it is not finite.
//   vierer (thesis 4.20):       (u v)^2, u^4 + v^4, u v (u^4 - v^4);           f2^2 = f0 (f1^2 - 4 f0^2)
//   tetrahedral (thesis 4.21):  g0 = u v (u^4 - v^4), g1 = u^8 + 14 u^4 v^4 + v^8,
//                               g2 = u^12 - 33 u^4 v^4 (u^4 + v^4) + v^12;     g2^2 = g1^3 - 108 g0^4
//   octahedral (thesis 4.23):   g1, g0^2, g0 g2;                               f2^2 = f1 (f0^3 - 108 f1^2)
//   icosahedral (Klein's forms in the position of the group above, where they are forms in g0, g1, g2):
//                               f0 = g2 + 22/sqrt5 g0^2, its Hessian f1 = g1 (g2 - 38 sqrt5/3 g0^2), their Jacobian
//                               f2 = g0 (g2^2 - 116 sqrt5/45 g0^2 g2 + 3444/25 g0^4), both up to a constant factor;
//                                                                              f2^2 = (f0^5 - f1^3) / (60 sqrt5)
// The roots of the icosahedral f0, f1, f2 are the 6 five-fold, 10 three-fold and 15 two-fold axes.
Complex3 invariants(BinaryGroup group, const Quaternion& q);

// f2^2 - P(f0, f1): zero on the model surface.
Complex relation_residual(BinaryGroup group, const Complex3& f);

}  // namespace octafield::frames
