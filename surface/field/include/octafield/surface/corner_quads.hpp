// How many quads meet at a corner of the boundary.
#pragma once

#include "octafield/arrays.hpp"

namespace octafield::surface {

// A vertex of the boundary with other than the 2 quads of a smooth place, as a caller wants it or an angle gives it; its
// index is (2 - quads) / 4.
struct CornerQuads {
    Index vertex = 0;
    int quads = 2;
};

}  // namespace octafield::surface
