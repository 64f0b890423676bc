#include "octafield/surface/feature_cut.hpp"

#include "octafield/disjoint_sets.hpp"

namespace octafield::surface {

FeatureCut cut_along_features(const SurfaceDomain& domain) {
    const Triangles& triangles = domain.mesh().triangles;
    const EdgeTopology& topology = domain.topology();
    DisjointSets corners(3 * static_cast<std::size_t>(triangles.rows()));
    const auto corner = [&](Index t, Index vertex) {
        int k = 0;
        while (triangles(t, k) != vertex) ++k;
        return 3 * t + k;
    };
    for (Index e = 0; e < domain.edge_count(); ++e) {
        const auto beside = topology.edge_triangles.row(e);
        if (beside.minCoeff() < 0 || domain.is_feature()[e]) continue;
        for (int k = 0; k < 2; ++k) {
            const Index vertex = topology.edges(e, k);
            corners.join(corner(beside[0], vertex), corner(beside[1], vertex));
        }
    }
    Index count = 0;
    const std::vector<Index> vertex_of = std::move(corners).numbers(count);
    TriangleMesh mesh{Points(count, 3), Triangles(triangles.rows(), 3)};
    FeatureCut result;
    result.origins.resize(count);
    for (Index t = 0; t < triangles.rows(); ++t)
        for (int k = 0; k < 3; ++k) {
            const Index v = vertex_of[3 * t + k];
            mesh.triangles(t, k) = v;
            result.origins[v] = triangles(t, k);
            mesh.vertices.row(v) = domain.mesh().vertices.row(triangles(t, k));
        }
    result.domain = SurfaceDomain(std::move(mesh));
    return result;
}

}  // namespace octafield::surface
