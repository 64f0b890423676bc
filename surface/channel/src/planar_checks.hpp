// Whether an outline is a plane straight-line graph.
#pragma once

#include "octafield/surface/fixed_boundary_quads.hpp"

namespace octafield::surface::detail {

// Throws as fixed_boundary_quads, but for what depends on regions.
void require_planar(const PlanarOutline& outline);

// Loops first, then lines: (L + M, 2).
Edges all_segments(const PlanarOutline& outline);

}  // namespace octafield::surface::detail
