#include "components.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace octafield::surface::detail {
namespace {

Index root_of(std::vector<Index>& parent, Index e) {
    while (parent[e] != e) e = parent[e] = parent[parent[e]];
    return e;
}

// Of a part, as shape_size: with the masses of edges at their midpoints it is the same number.
struct Moments {
    explicit Moments(const Eigen::Vector3d& place) : origin(place) {}
    void add(const Eigen::Vector3d& point, double by) {
        mass += by;
        first += by * (point - origin);
        second += by * (point - origin).squaredNorm();
    }
    double size() const {
        return mass > 0 ? 3 * std::sqrt(std::max(0.0, second / mass - (first / mass).squaredNorm())) : 0;
    }
    Eigen::Vector3d origin, first = Eigen::Vector3d::Zero();
    double mass = 0, second = 0;
};

}  // namespace

Components components(const SurfaceDomain& domain, const std::vector<CornerLink>& links,
                      const Eigen::VectorXd& masses) {
    const TriangleMesh& mesh = domain.mesh();
    const EdgeTopology& topology = domain.topology();
    std::vector<Index> parent(masses.size());
    std::iota(parent.begin(), parent.end(), 0);
    for (const CornerLink& link : links) {
        const Index a = root_of(parent, link.first), b = root_of(parent, link.second);
        parent[std::max(a, b)] = std::min(a, b);
    }
    Components result;
    result.of_edge.resize(parent.size());
    std::vector<Moments> moments;
    for (Index e = 0; e < masses.size(); ++e) {
        if (parent[e] == e) {
            result.of_edge[e] = static_cast<Index>(moments.size());
            moments.emplace_back(mesh.vertices.row(topology.edges(e, 0)).transpose());
            result.areas.push_back(0);
        } else {
            result.of_edge[e] = result.of_edge[root_of(parent, e)];
        }
        const Index c = result.of_edge[e];
        result.areas[c] += masses[e];
        const Eigen::RowVector3d ends =
            mesh.vertices.row(topology.edges(e, 0)) + mesh.vertices.row(topology.edges(e, 1));
        moments[c].add(ends.transpose() / 2, masses[e]);
    }
    for (const Moments& of_part : moments) result.sizes.push_back(of_part.size());
    result.anchored.assign(moments.size(), false);
    return result;
}

}  // namespace octafield::surface::detail
