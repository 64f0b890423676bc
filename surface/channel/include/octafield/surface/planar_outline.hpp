// Regions of the plane by their boundary, segment by segment.
#pragma once

#include "octafield/cell_arrays.hpp"
#include "octafield/surface/plane_points.hpp"
#include "octafield/surface/triangle_mesh.hpp"

namespace octafield::surface {

// A plane straight-line graph. Inside is what an odd number of loops goes round, so holes and islands in them are loops
// as well, in either sense.
struct PlanarOutline {
    PlanePoints points{0, 2};  // (P, 2), the input's length unit
    Edges loops{0, 2};         // (L, 2) ids of points: each in two of these segments or in none
    Edges lines{0, 2};         // (M, 2) ids of points: segments inside that become edges; they may end anywhere
};

// Throws InvalidInput (kinds "empty", "index_out_of_range", "non_finite_vertex") and GeometryError naming points or
// segments (loops first, then lines): "repeated_point" (two points at one place), "no_length", "open_loop",
// "touching_loops" (more than two segments of loops at a point), "crossing" (segments that cross, overlap or end on one
// another).
void require_planar(const PlanarOutline& outline);

// Of a graph whose segments do not tell what they are: loops lie between the inside and the outside, lines have the
// inside on both sides. Outside is what can be reached from far away or from one of the holes' points (H, 2) without
// crossing a segment; segments within it are left out. Throws as require_planar, and InvalidInput "empty" where nothing
// is inside.
PlanarOutline outline_of_graph(const PlanePoints& points, const Edges& segments, const PlanePoints& holes);

// Triangles of what is inside, counter-clockwise in the plane z = 0: a constrained Delaunay triangulation of the points,
// whose ids are kept, with loops and lines as edges. Points that are nowhere inside are in no triangle. Throws as
// require_planar.
TriangleMesh outline_triangles(const PlanarOutline& outline);

}  // namespace octafield::surface
