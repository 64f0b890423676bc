// The channel between an outline and a mesh inside.
#pragma once

#include "inside_mesh.hpp"
#include "plane_triangulation.hpp"

namespace octafield::surface::detail {

struct Channel {
    PlanePoints points;       // of the outline, then those of the mesh inside
    PlaneTriangulation made;  // segments: those of the outline, then the rim of the mesh inside
    std::vector<char> open;   // triangles of the channel
};

// Neither inside the mesh nor outside of the loops.
Channel channel_of(const Outline& outline, const InsideMesh& inside);

}  // namespace octafield::surface::detail
