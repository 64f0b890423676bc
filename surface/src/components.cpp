#include "components.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>

namespace octafield::surface::detail {
namespace {

Index root_of(std::vector<Index>& parent, Index e) {
    while (parent[e] != e) e = parent[e] = parent[parent[e]];
    return e;
}

}  // namespace

Components components(const TriangleMesh& mesh, const EdgeTopology& topology, const std::vector<CornerLink>& links,
                      const Eigen::VectorXd& masses) {
    std::vector<Index> parent(masses.size());
    std::iota(parent.begin(), parent.end(), 0);
    for (const CornerLink& link : links) {
        const Index a = root_of(parent, link.first), b = root_of(parent, link.second);
        parent[std::max(a, b)] = std::min(a, b);
    }
    Components result;
    result.of_edge.resize(parent.size());
    std::vector<Eigen::AlignedBox3d> boxes;
    for (Index e = 0; e < masses.size(); ++e) {
        if (parent[e] == e) {
            result.of_edge[e] = static_cast<Index>(boxes.size());
            boxes.emplace_back();
            result.areas.push_back(0);
        } else {
            result.of_edge[e] = result.of_edge[root_of(parent, e)];
        }
        const Index c = result.of_edge[e];
        result.areas[c] += masses[e];
        for (int k = 0; k < 2; ++k) boxes[c].extend(mesh.vertices.row(topology.edges(e, k)).transpose());
    }
    for (const auto& box : boxes) result.diagonals.push_back(box.diagonal().norm());
    result.anchored.assign(boxes.size(), false);
    return result;
}

}  // namespace octafield::surface::detail
