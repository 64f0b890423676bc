// Constrained Delaunay triangles of points and segments in the plane.
#pragma once

#include <vector>

#include "octafield/surface/planar_outline.hpp"

namespace octafield::surface::detail {

// Triangles of the convex hull, counter-clockwise. Side k is opposite to corner k, from corner k + 1 to k + 2.
struct PlaneTriangulation {
    Triangles triangles{0, 3};
    Triangles neighbours{0, 3};  // across each side; -1: none
    Triangles segments{0, 3};    // which of the given segments each side is; -1: none
};

// Segments may meet at their ends only, and no two points may be at one place.
PlaneTriangulation triangulate(const PlanePoints& points, const Edges& segments);

// Of each triangle, whether an odd number of the first `loops` segments lies between it and the outside.
std::vector<char> inside_loops(const PlaneTriangulation& made, Index loops);

// Number of the connected part of each triangle, between segments; -1 where not `wanted`.
std::vector<Index> parts_of(const PlaneTriangulation& made, const std::vector<char>& wanted, Index& count);

// The triangles that hold a place: two or more where it is on a side or a vertex.
std::vector<Index> triangles_at(const PlaneTriangulation& made, const PlanePoints& points,
                                const Eigen::Vector2d& place);

}  // namespace octafield::surface::detail
