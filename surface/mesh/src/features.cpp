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
    std::vector<Index> missing;  // positions in `edges`
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
        throw InvalidInput(std::to_string(missing.size()) + " feature edges are no edges of the mesh: feature edge " +
                               first_few(missing),
                           "not_an_edge", missing);
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

}  // namespace octafield::surface
