// Points on open edges that are one point up to the precision of the coordinates.
#pragma once

#include "octafield/surface/triangle_mesh.hpp"

namespace octafield::surface {

struct NearMerge {
    std::size_t points = 0, triangles = 0;  // merged away; collapsed by that
    double largest_move = 0;
};

// Merges vertices of open edges into the first one whose whole group lies within `tolerance`. So a triangle vanishes
// only where one of its edges is no longer than that. Leaves the mesh alone where three triangles would share an edge
// that two or fewer share now. Vertices that were merged away are dropped.
NearMerge merge_near_points(TriangleMesh& mesh, double tolerance);

// Splits triangles with an open edge at the vertices of other open edges on it (T-junctions), up to `tolerance`, where
// that closes an edge at least. Number of triangles split.
std::size_t split_open_edges(TriangleMesh& mesh, double tolerance);

}  // namespace octafield::surface
