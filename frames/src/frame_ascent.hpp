// Global maximum over SO(3) of F(R) = p(r_1) + p(r_2) + p(r_3), p a quartic: the core of nearest-frame projections.
#pragma once

#include "octafield/frames/quaternion.hpp"
#include "quartic.hpp"

namespace octafield::frames {

// Newton ascent with the absolute Hessian from eight seeds (the identity and the 45-degree turns about x, y, z, the
// three face diagonals and (1,1,1)), the best of all; `guess`, when given, is one more seed. Returns a unit quaternion.
Quaternion maximise_over_frames(const Quartic& p, const Quaternion* guess);

}  // namespace octafield::frames
