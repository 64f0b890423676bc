// How far one surface lies from another, and how it is turned.
#pragma once

#include "octafield/surface/triangle_mesh.hpp"

namespace octafield::surface {

// Largest distance to `to` of the corners and centres of the triangles of `from`, input unit. Triangles of both with
// the same three points count as none. Requires triangles in `to`.
double one_sided_distance(const TriangleMesh& from, const TriangleMesh& to);

// (n, 3) of `to`, nearest to each. Requires triangles in `to`.
Points nearest_points(const Points& points, const TriangleMesh& to);

// Share of the area of `from` whose triangles are turned by more than `angle` (radians) from the nearest of `to`: details
// that `to` leaves out. Of an even choice of triangles where there are many. Of two sides of a thin wall the nearer may be
// the other: turns beyond a right angle count as those of the wall's other side. Requires triangles in `to`.
double turned_share(const TriangleMesh& from, const TriangleMesh& to, double angle);

}  // namespace octafield::surface
