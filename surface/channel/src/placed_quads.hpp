// Templates in their different positions on a polygon.
#pragma once

#include "octafield/surface/quad_templates.hpp"

namespace octafield::surface::detail {

// Its quads where corner 0 is at corner `shift`, and corners run the other way if mirrored. Vertices inside are
// numbered as a walk over the quads from the polygon's first side meets them, so positions that look alike are equal.
std::vector<std::array<int, 4>> placed_quads(const QuadTemplate& given, int shift, bool mirrored);

}  // namespace octafield::surface::detail
