// The loops of open edges of a surface.
#pragma once

#include <vector>

#include "octafield/surface/triangle_mesh.hpp"

namespace octafield::surface {

// One loop of open edges that passes each vertex once, in the sense in which triangles in the hole run it.
struct Rim {
    std::vector<Index> vertices;
    std::vector<Index> beyond;  // of the triangle at the edge from vertex k to k + 1 the third vertex
    bool pinched = false;       // another loop passes one of its vertices
};

// By their lowest vertices. Open edges that make no loop (triangles of opposite orientation meet) and rims of single
// triangles are left out.
std::vector<Rim> hole_rims(const TriangleMesh& mesh);

// Do the vertices lie in a plane (to 1 % of the rim's extent) from which the triangles beyond rise at more than 60
// degrees on average?
bool wants_lid(const TriangleMesh& mesh, const Rim& rim);

}  // namespace octafield::surface
