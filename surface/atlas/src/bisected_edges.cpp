#include "octafield/surface/bisected_edges.hpp"

#include <string>

#include "bisected_mesh.hpp"
#include "octafield/error.hpp"

namespace octafield::surface {
namespace {

using detail::BisectedMesh;

BisectedEdges collected(const SurfaceDomain& domain, const BisectedMesh& mesh) {
    BisectedEdges result;
    TriangleMesh finer;
    finer.vertices.resize(static_cast<Eigen::Index>(mesh.positions().size()), 3);
    for (Eigen::Index v = 0; v < finer.vertices.rows(); ++v) finer.vertices.row(v) = mesh.positions()[v];
    finer.triangles.resize(static_cast<Eigen::Index>(mesh.triangles().size()), 3);
    std::vector<std::pair<Index, Index>> features;
    for (Eigen::Index t = 0; t < finer.triangles.rows(); ++t) {
        const BisectedMesh::Triangle& triangle = mesh.triangles()[t];
        for (int k = 0; k < 3; ++k) {
            finer.triangles(t, k) = triangle.corners[k];
            if (triangle.is_feature[k]) features.emplace_back(triangle.corners[k], triangle.corners[(k + 1) % 3]);
        }
        result.parents.push_back(triangle.origin);
    }
    FeatureGraph graph;
    graph.edges.resize(static_cast<Eigen::Index>(features.size()), 2);
    for (std::size_t i = 0; i < features.size(); ++i)
        graph.edges.row(static_cast<Eigen::Index>(i)) << features[i].first, features[i].second;
    graph.corners = domain.features().corners;  // vertices of the input keep their numbers
    result.domain = SurfaceDomain(std::move(finer), std::move(graph));
    return result;
}

}  // namespace

BisectedEdges bisected_edges(const SurfaceDomain& domain, const Eigen::VectorXd& longest, Index most_triangles) {
    if (longest.size() != domain.triangle_count() || !(longest.size() == 0 || longest.minCoeff() > 0))
        throw InvalidInput("the longest edges must be a number above 0 for each triangle", "bad_option");
    BisectedMesh mesh(domain, {});
    // Triangles made on the way are behind; one that is bisected keeps its number for a half.
    for (Index t = 0; t < static_cast<Index>(mesh.triangles().size()); ++t)
        while (mesh.longest(t) > longest[mesh.triangles()[t].origin]) {
            mesh.bisect(t);
            if (static_cast<Index>(mesh.triangles().size()) > most_triangles)
                throw InvalidInput(
                    "more than " + std::to_string(most_triangles) + " triangles would be needed; let edges be longer",
                    "too_many");
        }
    return collected(domain, mesh);
}

}  // namespace octafield::surface
