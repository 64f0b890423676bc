// Whether the triangles of a surface can be turned so that neighbours agree.
#pragma once

#include <vector>

#include "octafield/surface/triangle_mesh.hpp"

namespace octafield::surface::detail {

// Triangles of the components that cannot be oriented (a Moebius strip), ascending; empty where turning some triangles
// over is enough. Edges of more than two triangles do not connect.
std::vector<Index> unorientable_triangles(const TriangleMesh& mesh);

// edge_topology, whose error for a surface that cannot be oriented has the kind "not_orientable" and names it.
EdgeTopology oriented_topology(const TriangleMesh& mesh);

}  // namespace octafield::surface::detail
