// The surface with a vertex at each place, in the middle of rings of small triangles.
#pragma once

#include "stars.hpp"

namespace octafield::surface::detail {

struct RingOptions {
    int sectors, rings;
    double ratio;
};

struct RingedMesh {
    TriangleMesh mesh;  // vertices of the bisected mesh first
    Edges features{0, 2};
    std::vector<Index> vertex_triangles;  // (V) in the input; -1: vertex of no triangle
    Points vertex_weights;                // (V, 3)
    std::vector<Index> origins;           // (F) triangle of the input
    std::vector<Index> parts;             // (F) triangle of the bisected mesh
    std::vector<Index> centres;           // (n) vertex at each place
};

// Round a place: equal sectors, with triangles whose size grows from the place by `ratio` from ring to ring, then to
// the sides of its star, which get a vertex where a sector's line meets them; triangles beside are split there. So all
// new triangles are parts of old ones, and the shape stays. `indices`: t of each place, for the number of sectors.
RingedMesh ringed(const BisectedMesh& mesh, const std::vector<int>& indices, const RingOptions& options);

}  // namespace octafield::surface::detail
