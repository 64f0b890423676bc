// Segments of an outline.
#pragma once

#include "octafield/surface/planar_outline.hpp"

namespace octafield::surface::detail {

// Loops first, then lines: (L + M, 2).
Edges all_segments(const PlanarOutline& outline);

// Throws as require_planar, whatever the segments are: loops need not close.
void require_graph(const PlanePoints& points, const Edges& segments);

}  // namespace octafield::surface::detail
