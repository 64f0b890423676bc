// The corners round each vertex, counter-clockwise seen from outside.
#pragma once

#include <vector>

#include "octafield/surface/triangle_mesh.hpp"

namespace octafield::surface::detail {

// One fan per vertex in use; several where parts of the surface touch at a vertex only.
struct VertexFans {
    struct Fan {
        Index vertex;
        bool closed;        // goes all the way round; otherwise it runs from boundary edge to boundary edge
        Index first, last;  // its corners are corners[first .. last)
    };
    std::vector<Fan> fans;       // by vertex
    std::vector<Index> corners;  // (3F), 3t + k is corner k of triangle t; the next one lies across its second edge
};

VertexFans vertex_fans(const TriangleMesh& mesh, const EdgeTopology& topology);

}  // namespace octafield::surface::detail
