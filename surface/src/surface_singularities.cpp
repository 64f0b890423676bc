#include <cassert>
#include <cmath>
#include <numbers>
#include <unordered_map>

#include "crouzeix_raviart.hpp"
#include "octafield/surface/direction_field.hpp"
#include "vertex_fans.hpp"

namespace octafield::surface {
namespace {

// The integer that `turns` is but for rounding; at the boundary only where the field is aligned with it.
int whole(double turns, [[maybe_unused]] bool interior) {
    const double nearest = std::round(turns);
    assert(!interior || std::abs(turns - nearest) < 1e-6);
    return static_cast<int>(nearest);
}

// Zero of the linear function through the values at the edge midpoints; inside the triangle of the midpoints, as they
// wind round 0.
Eigen::Vector3d zero_position(const TriangleMesh& mesh, Index t, const std::array<detail::Complex, 3>& values) {
    const auto cross = [](detail::Complex a, detail::Complex b) { return (std::conj(a) * b).imag(); };
    Eigen::Vector3d weights;
    for (int k = 0; k < 3; ++k) weights[k] = cross(values[(k + 1) % 3], values[(k + 2) % 3]);
    if (weights.sum() == 0 || !weights.allFinite()) weights.setOnes();
    weights /= weights.sum();
    Eigen::RowVector3d position = Eigen::RowVector3d::Zero();
    for (int k = 0; k < 3; ++k) {
        const auto start = mesh.vertices.row(mesh.triangles(t, k)),
                   end = mesh.vertices.row(mesh.triangles(t, (k + 1) % 3));
        position += weights[k] * (start + end) / 2;
    }
    return position;
}

// The field is continuous at edge midpoints only, so a vertex and a triangle at it may carry opposite indices where the
// field does not turn at all on any path the mesh can tell apart from one round both. Such pairs are left out; the sum
// stays as it is.
void cancel_pairs(const TriangleMesh& mesh, std::vector<SurfaceSingularity>& found) {
    std::unordered_map<Index, std::size_t> at_vertex;
    for (std::size_t i = 0; i < found.size(); ++i)
        if (found[i].vertex >= 0) at_vertex.try_emplace(found[i].vertex, i);
    for (SurfaceSingularity& inner : found) {
        if (inner.triangle < 0) continue;
        for (const Index v : mesh.triangles.row(inner.triangle)) {
            const auto place = at_vertex.find(v);
            if (place == at_vertex.end()) continue;
            SurfaceSingularity& outer = found[place->second];
            if (inner.index_times_symmetry + outer.index_times_symmetry != 0) continue;
            inner.index_times_symmetry = outer.index_times_symmetry = 0;
            at_vertex.erase(place);
            break;
        }
    }
    std::erase_if(found, [](const SurfaceSingularity& singularity) { return singularity.index_times_symmetry == 0; });
}

}  // namespace

// N times the index of a vertex: the turns of the N-fold angle against the planes of the triangles round it, plus N
// times its angle defect in turns (from a straight line at the boundary). Each corner's turn enters its triangle's sum
// with the opposite sign, so the total is N times the sum of the angle defects: N times the Euler characteristic
// (Gauss-Bonnet).
std::vector<SurfaceSingularity> surface_singularities(const TriangleMesh& mesh, const DirectionField& field) {
    constexpr double pi = std::numbers::pi;
    const std::vector<detail::CornerLink> links = detail::corner_links(mesh, field.topology, field.symmetry);
    std::vector<double> turns(links.size());
    for (std::size_t c = 0; c < links.size(); ++c) turns[c] = detail::turn(links[c], field.values);

    std::vector<SurfaceSingularity> found;
    for (Index t = 0; t < mesh.triangles.rows(); ++t) {
        const int index = whole(-(turns[3 * t] + turns[3 * t + 1] + turns[3 * t + 2]) / (2 * pi), true);
        if (index == 0) continue;
        const Eigen::Vector3d position = zero_position(mesh, t, detail::local_values(links, field.values, t));
        found.push_back({position, index, static_cast<double>(index) / field.symmetry, t, -1, false});
    }
    const detail::VertexFans fans = detail::vertex_fans(mesh, field.topology);
    for (const auto& fan : fans.fans) {
        double sum = field.symmetry * (fan.closed ? 2 * pi : pi);
        for (Index i = fan.first; i < fan.last; ++i)
            sum += turns[fans.corners[i]] - field.symmetry * links[fans.corners[i]].angle;
        const int index = whole(sum / (2 * pi), fan.closed);
        if (index == 0) continue;
        found.push_back({mesh.vertices.row(fan.vertex), index, static_cast<double>(index) / field.symmetry, -1,
                         fan.vertex, !fan.closed});
    }
    cancel_pairs(mesh, found);
    return found;
}

}  // namespace octafield::surface
