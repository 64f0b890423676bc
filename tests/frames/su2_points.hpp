// Points of the model surface in C^3, for the tests of su2.
#pragma once

#include "octafield/frames/su2.hpp"

namespace octafield::frames {

inline Complex3 point(const Quaternion& q) { return Su2::complex(Su2::embed(q)); }

}  // namespace octafield::frames
