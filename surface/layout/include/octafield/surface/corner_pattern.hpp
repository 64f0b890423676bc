// The singular points of a computed field with other numbers of quads at corners: computed fields have corners without
// quads at acute angles, which are infinitely long in quad coordinates, and corners of three quads on smooth boundary.
#pragma once

#include "octafield/surface/singular_pattern.hpp"

namespace octafield::surface {

// The pattern with `corners` and no others (default_corner_quads, say). What the index of the boundary changes by is
// made good on each connected part, so that the sum stays: changes of opposite sign cancel, those nearest to one
// another first; then points inside of the opposite sign, of one quarter turn, are taken away, the nearest first; what
// is left becomes points of valence 3 or 5 in the triangles nearest to the corner that have no other point, with a
// vertex inside the surface where there is one. Throws InvalidInput (kinds "not_on_boundary", "outside_surface"),
// GeometryError (kind "no_room", elements: vertices) where each triangle has a point.
SingularPattern with_corner_quads(const SurfaceDomain& domain, SingularPattern pattern,
                                  const std::vector<CornerQuads>& corners);

// The quads that the pattern has at corners, but 1 where it has fewer. Such a corner often comes with one of more quads
// than its angle has, one or two edges along the boundary, where the computed field made up for it: the nearest within
// four mean edge lengths gets its quads by the angle.
std::vector<CornerQuads> finite_corner_quads(const SurfaceDomain& domain, const SingularPattern& pattern);

}  // namespace octafield::surface
