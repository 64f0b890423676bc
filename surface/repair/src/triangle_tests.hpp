// Exact geometric tests on triangles (CGAL's filtered predicates), valid on any set of triangles, manifold or not.
#pragma once

#include <vector>

#include "octafield/surface/triangle_mesh.hpp"

namespace octafield::surface {

// Are the triangle's corners on one line, or does it use a vertex twice? Exact: nearly flat triangles are sound.
bool is_degenerate(const TriangleMesh& mesh, Index triangle);

// Ascending ids of triangles that meet another one anywhere but at shared vertices and edges. Degenerate triangles are
// not looked at. O(n log n + pairs of overlapping boxes). first: only pairs with a triangle from this number on count.
std::vector<Index> intersecting_triangles(const TriangleMesh& mesh, Index first = 0);

}  // namespace octafield::surface
