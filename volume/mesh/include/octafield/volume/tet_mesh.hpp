// Tetrahedral meshes: arrays, boundary and elementary geometry.
#pragma once

#include <vector>

#include "octafield/arrays.hpp"
#include "octafield/surface/triangle_mesh.hpp"

namespace octafield::volume {

struct TetMesh {
    Points vertices;  // (n, 3), the input's length unit
    Tets tets;        // (m, 4), 0-based, positively oriented
};

struct BoundarySurface {
    surface::TriangleMesh mesh;     // compact numbering, triangles outward
    std::vector<Index> vertex_map;  // boundary vertex -> tet-mesh vertex, ascending
};

Eigen::VectorXd tet_volumes(const TetMesh& mesh);  // (m), signed

// Triangles that belong to one tet only. Throws GeometryError (kind "non_manifold_face") where three tets share a
// triangle, (kind "folded_tet") where tets lie on the same side of a triangle they share: so they overlap. Whatever
// looks at the triangles of a mesh throws these.
BoundarySurface boundary_surface(const TetMesh& mesh);

// Throws GeometryError naming tets: kinds "empty", "index_out_of_range", "non_finite_vertex", "inverted_tet" (volume
// not above 0).
void require_valid(const TetMesh& mesh);

}  // namespace octafield::volume
