// Surfaces of quads and triangles: the boundaries of hex-dominant meshes, and quad meshes.
#pragma once

#include "octafield/cell_arrays.hpp"
#include "octafield/surface/triangle_mesh.hpp"

namespace octafield::surface {

// Faces are numbered: the triangles, then the quads.
struct QuadMesh {
    Points vertices;  // (V, 3), the input's length unit
    Triangles triangles{0, 3};
    Quads quads{0, 4};

    Index face_count() const { return static_cast<Index>(triangles.rows() + quads.rows()); }
};

// Throws GeometryError naming faces (edges: their two vertices): kinds "empty", "index_out_of_range",
// "non_finite_vertex", "repeated_vertex", "degenerate_face" (a corner whose angle, seen along the face's own normal, is
// not between 0 and pi: no area, a quad that is not convex or crosses itself), "non_manifold_edge",
// "inconsistent_orientation", and with `closed` "not_closed".
void require_valid(const QuadMesh& mesh, bool closed = true);

// Least scaled Jacobian of each face, triangles first: (face_count), in [-1, 1], 1 for squares and equilateral
// triangles (Knupp et al. 2006, Verdict: the least over the corners of the area that its two sides span over the
// product of their lengths, along the quad's normal; of a triangle over sqrt(3) / 2 of the largest product). Throws
// GeometryError (kind "index_out_of_range").
Eigen::VectorXd scaled_jacobians(const QuadMesh& mesh);

// The quads split along their shorter diagonal (the one from corner 0, where they are equal); triangles first, then two
// for each quad. Throws as scaled_jacobians.
TriangleMesh split_quads(const QuadMesh& mesh);

}  // namespace octafield::surface
