#include "octafield/surface/features.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "half_edges.hpp"
#include "octafield/error.hpp"

namespace octafield::surface {
namespace {

void require_angle(double angle, const char* name) {
    if (!(angle > 0 && angle < std::numbers::pi))
        throw InvalidInput(std::string(name) + " must lie between 0 and pi (radians)", "invalid_option");
}

double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b));
}

// Lower id first, lexicographic order, each once.
Edges normalized(const Edges& edges) {
    std::vector<std::pair<Index, Index>> pairs;
    for (const auto edge : edges.rowwise()) pairs.push_back(std::minmax({edge[0], edge[1]}));
    std::ranges::sort(pairs);
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    Edges result(pairs.size(), 2);
    for (std::size_t i = 0; i < pairs.size(); ++i) result.row(i) << pairs[i].first, pairs[i].second;
    return result;
}

void require_mesh_edges(const TriangleMesh& mesh, const Edges& edges) {
    if (edges.rows() == 0) return;
    std::vector<Index> missing;  // positions in `edges`
    for (Index e = 0; e < edges.rows(); ++e)
        if (edges.row(e).minCoeff() < 0 || edges.row(e).maxCoeff() >= mesh.vertices.rows()) missing.push_back(e);
    if (!missing.empty())
        throw InvalidInput("features: edges " + first_few(missing) + " name vertices that the mesh does not have; its " +
                               std::to_string(mesh.vertices.rows()) + " vertices are numbered from 0",
                           "index_out_of_range", missing);
    const std::vector<HalfEdge> sides = sorted_half_edges(mesh.triangles);
    const auto before = [](const HalfEdge& side, std::pair<Index, Index> edge) {
        return std::pair(side.low, side.high) < edge;
    };
    for (Index e = 0; e < edges.rows(); ++e) {
        const std::pair<Index, Index> edge = std::minmax({edges(e, 0), edges(e, 1)});
        const auto found = std::lower_bound(sides.begin(), sides.end(), edge, before);
        if (found == sides.end() || std::pair(found->low, found->high) != edge) missing.push_back(e);
    }
    if (!missing.empty())
        throw InvalidInput("features: edges " + first_few(missing) + " are no edges of the mesh", "not_an_edge", missing);
}

}  // namespace

FeatureGraph detect_features(const TriangleMesh& mesh, const FeatureOptions& options) {
    require_angle(options.angle, "the feature angle");
    const EdgeTopology topology = edge_topology(mesh);
    const Points normals = triangle_normals(mesh);
    std::vector<Index> kept;
    for (Index e = 0; e < topology.edges.rows(); ++e) {
        const auto pair = topology.edge_triangles.row(e);
        if (pair.minCoeff() < 0 || angle_between(normals.row(pair[0]), normals.row(pair[1])) > options.angle)
            kept.push_back(e);
    }
    return feature_graph(mesh, topology.edges(kept, Eigen::all), options.corner_angle);
}

FeatureGraph feature_graph(const TriangleMesh& mesh, const Edges& edges, double corner_angle) {
    require_angle(corner_angle, "the corner angle");
    require_mesh_edges(mesh, edges);
    FeatureGraph graph;
    graph.edges = normalized(edges);
    std::vector<std::pair<Index, Index>> ends;  // (vertex, its neighbour along a feature edge)
    for (const auto edge : graph.edges.rowwise()) ends.insert(ends.end(), {{edge[0], edge[1]}, {edge[1], edge[0]}});
    std::ranges::sort(ends);
    for (auto first = ends.begin(); first != ends.end();) {
        const Index v = first->first;
        const auto last = std::find_if(first, ends.end(), [v](const auto& end) { return end.first != v; });
        bool corner = last - first != 2;
        if (!corner) {
            const Eigen::Vector3d middle = mesh.vertices.row(v);
            const Eigen::Vector3d before = mesh.vertices.row(first->second),
                                  after = mesh.vertices.row((first + 1)->second);
            corner = angle_between(middle - before, after - middle) > corner_angle;
        }
        if (corner) graph.corners.push_back(v);
        first = last;
    }
    return graph;
}

FeatureGraph ordered_features(FeatureGraph features, const TriangleMesh& mesh) {
    require_mesh_edges(mesh, features.edges);
    std::vector<Index> lost;  // positions in `corners`
    for (std::size_t i = 0; i < features.corners.size(); ++i)
        if (features.corners[i] < 0 || features.corners[i] >= mesh.vertices.rows()) lost.push_back(static_cast<Index>(i));
    if (!lost.empty())
        throw InvalidInput("features: corners " + first_few(lost) + " are no vertices of the mesh; its " +
                               std::to_string(mesh.vertices.rows()) + " vertices are numbered from 0",
                           "index_out_of_range", lost);
    features.edges = normalized(features.edges);
    std::ranges::sort(features.corners);
    features.corners.erase(std::unique(features.corners.begin(), features.corners.end()), features.corners.end());
    return features;
}

}  // namespace octafield::surface
