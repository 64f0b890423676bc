// Points at even spacing along curves of the surface.
#pragma once

#include <vector>

#include "surface_walk.hpp"

namespace octafield::volume {

// Vertices where curves meet, end, or have a corner of the features; then points between, at whole parts of the length
// in cells along the axis nearest to the curve: of closed curves without such a vertex three at least. curves: as of
// surface_curves. Each on an edge or at a vertex.
std::vector<FrontPlace> curve_points(const TetDomain& domain, const Edges& curves, const SurfaceWalker& walker,
                                     const FrontField& field);

}  // namespace octafield::volume
