#include "octafield/volume/feature_alignment.hpp"

#include <cmath>

#include "alignment.hpp"
#include "boundary_star.hpp"
#include "octafield/frames/quaternion.hpp"

namespace octafield::volume {
namespace {

using frames::Vector3;

// Unit vectors away from the vertex in, tangents out.
std::vector<Vector3> tangents(const std::vector<Vector3>& edges, bool corner) {
    if (edges.size() != 2 || corner) return edges;
    const Vector3 mean = edges[0] - edges[1];
    if (mean.norm() < 1e-9) return edges;  // of unit vectors: the curve turns back on itself
    return {mean.normalized()};
}

}  // namespace

FeatureTangents feature_tangents(const TetDomain& domain) {
    const BoundaryStars stars(domain.surface().mesh, domain.features());
    std::vector<std::uint8_t> corner(stars.vertex_count(), 0);
    for (const Index v : domain.features().corners) corner[v] = 1;
    FeatureTangents result;
    std::vector<Vector3> all;
    for (Index v = 0; v < stars.vertex_count(); ++v)
        for (const Vector3& tangent : tangents(stars.feature_directions(v), corner[v])) {
            result.vertex.push_back(v);
            all.push_back(tangent);
        }
    result.tangent.resize(static_cast<Eigen::Index>(all.size()), 3);
    for (std::size_t i = 0; i < all.size(); ++i) result.tangent.row(i) = all[i].transpose();
    return result;
}

Eigen::VectorXd feature_alignment_angles(const TetDomain& domain, const Quaternions& frames) {
    const FeatureTangents found = feature_tangents(domain);
    return angles_to_nearest_axis(domain.surface(), found.vertex, found.tangent, frames);
}

}  // namespace octafield::volume
