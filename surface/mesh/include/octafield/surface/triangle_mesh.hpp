// Triangle meshes: arrays, edge topology and elementary geometry. Everything else in surface/ builds on this header.
#pragma once

#include <vector>

#include "octafield/arrays.hpp"

namespace octafield::surface {

struct TriangleMesh {
    Points vertices;      // (V, 3), the input's length unit
    Triangles triangles;  // (F, 3), 0-based, counter-clockwise seen from outside
};

// The edges of an edge-manifold, consistently oriented mesh.
struct EdgeTopology {
    Edges edges;               // (E, 2), lower vertex id first, in lexicographic order
    Triangles triangle_edges;  // (F, 3), column k: the edge from corner k to corner k+1 (mod 3)
    Edges edge_triangles;      // (E, 2): the triangle that runs the edge low to high, then the other; -1: none
};

// Throws GeometryError (kind "non_manifold_edge", "inconsistent_orientation" or "degenerate_triangle") where three
// triangles share an edge, two run it alike, or a triangle uses a vertex twice.
EdgeTopology edge_topology(const TriangleMesh& mesh);

double bounding_box_diagonal(const Points& points);  // of the box along the axes: for tolerances
// The size that lengths are fractions of: 3 times the root mean square distance of the surface from its centroid, which
// is within 14 % of the diagonal of a box (bar 0.87, cube 1.12, square plate 0.87) and the same whichever way it lies. 0
// without area.
double shape_size(const TriangleMesh& mesh);
double signed_volume(const TriangleMesh& mesh);
Eigen::VectorXd triangle_areas(const TriangleMesh& mesh);  // (F)
Points triangle_normals(const TriangleMesh& mesh);         // (F, 3), unit; zero where the area is zero
Points vertex_normals(const TriangleMesh& mesh);           // (V, 3), unit, weighted by incident triangle area
double mean_edge_length(const TriangleMesh& mesh);
// V - E + F over the vertices in use. Requires what edge_topology requires.
int euler_characteristic(const TriangleMesh& mesh);

}  // namespace octafield::surface
