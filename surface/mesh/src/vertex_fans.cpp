#include "vertex_fans.hpp"

#include <algorithm>

namespace octafield::surface::detail {
namespace {

// The corner across the given edge of triangle t at the same vertex, -1 where the surface ends.
Index corner_across(const TriangleMesh& mesh, const EdgeTopology& topology, Index corner, Index edge) {
    const Index t = corner / 3, vertex = mesh.triangles(t, corner % 3);
    const Index other =
        topology.edge_triangles(edge, 0) == t ? topology.edge_triangles(edge, 1) : topology.edge_triangles(edge, 0);
    if (other < 0) return -1;
    for (int k = 0; k < 3; ++k)
        if (mesh.triangles(other, k) == vertex) return 3 * other + k;
    return -1;
}

}  // namespace

VertexFans vertex_fans(const TriangleMesh& mesh, const EdgeTopology& topology) {
    const auto first_edge = [&](Index corner) { return topology.triangle_edges(corner / 3, corner % 3); };
    const auto second_edge = [&](Index corner) { return topology.triangle_edges(corner / 3, (corner % 3 + 2) % 3); };
    const Index corner_count = 3 * static_cast<Index>(mesh.triangles.rows());
    VertexFans result;
    result.corners.reserve(corner_count);
    std::vector<bool> done(corner_count, false);
    const auto run = [&](Index start, bool closed) {
        const Index first = static_cast<Index>(result.corners.size());
        for (Index c = start; c >= 0 && !done[c]; c = corner_across(mesh, topology, c, second_edge(c))) {
            done[c] = true;
            result.corners.push_back(c);
        }
        result.fans.push_back(
            {mesh.triangles(start / 3, start % 3), closed, first, static_cast<Index>(result.corners.size())});
    };
    for (Index c = 0; c < corner_count; ++c)
        if (topology.edge_triangles.row(first_edge(c)).minCoeff() < 0) run(c, false);
    for (Index c = 0; c < corner_count; ++c)
        if (!done[c]) run(c, true);
    std::stable_sort(result.fans.begin(), result.fans.end(),
                     [](const auto& a, const auto& b) { return a.vertex < b.vertex; });
    return result;
}

}  // namespace octafield::surface::detail
