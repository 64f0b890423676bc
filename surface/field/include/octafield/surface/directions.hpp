// One direction per vertex or triangle of an N-direction field.
#pragma once

#include "octafield/surface/direction_field.hpp"

namespace octafield::surface {

// One representative direction per vertex, from the mean of f over the incident edge midpoints, corner-angle weighted,
// parallel transported to the vertex's tangent plane (the polar map with angles scaled to 2 pi, Knoeppel et al. 2013).
// Unit rows, orthogonal to vertex_normals(mesh). Features of the field's domain and mesh boundary edges that the field
// follows (f = 1 there, as strong alignment makes it) decide at their vertices: at a vertex of one such edge the
// direction follows it; at a vertex of a curve, the curve's tangent; at a corner, the mean of its edges' crosses or,
// where they contradict each other, the first of the edges. Edges that are followed weakly or not at all count like any
// other. At a vertex in no triangle the row is zero. On a surface with its own edge lengths the one of an edge at the
// vertex, of the boundary where there is one: the four directions are not at right angles in space.
Points vertex_directions(const DirectionField& field);

// One representative direction per triangle: (F, 3) unit rows in the triangle's plane, from the value at the centroid.
Points triangle_directions(const DirectionField& field);

}  // namespace octafield::surface
