// Connected pieces of a surface, and how they nest.
#pragma once

#include <vector>

#include "half_edges.hpp"
#include "octafield/surface/triangle_mesh.hpp"

namespace octafield::surface {

// Piece number per triangle: triangles joined by edges, numbered by their lowest triangle.
std::vector<Index> connected_pieces(const TriangleMesh& mesh, const std::vector<HalfEdge>& sides);

// Triangles of closed pieces that face the wrong way: outer shells must enclose a positive volume, shells inside an odd
// number of others (cavities) a negative one. Ascending. Pieces with a boundary are left out.
// Requires an edge-manifold, consistently oriented mesh without degenerate triangles.
std::vector<Index> wrong_way_triangles(const TriangleMesh& mesh, const std::vector<HalfEdge>& sides);

}  // namespace octafield::surface
