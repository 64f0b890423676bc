#include "matched_smoothing.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <set>
#include <utility>

#include "axis_numbers.hpp"
#include "octafield/frames/octahedral_group.hpp"

namespace octafield::volume::detail {
namespace {

using Eigen::Vector3d;
using frames::Quaternion;

constexpr int rings = 8, sweeps = 60;

std::vector<std::vector<Index>> neighbours_of(const TetDomain& domain) {
    std::vector<std::vector<Index>> neighbours(domain.vertex_count());
    for (const auto tet : domain.mesh().tets.rowwise())
        for (const Index v : tet)
            for (const Index w : tet)
                if (v != w) neighbours[v].push_back(w);
    for (auto& list : neighbours) {
        std::sort(list.begin(), list.end());
        list.erase(std::unique(list.begin(), list.end()), list.end());
    }
    return neighbours;
}

std::set<Index> rings_round(const std::vector<std::vector<Index>>& neighbours, const std::vector<Index>& vertices) {
    std::set<Index> near(vertices.begin(), vertices.end()), front = near;
    for (int ring = 0; ring < rings; ++ring) {
        std::set<Index> next;
        for (const Index v : front)
            for (const Index w : neighbours[v])
                if (near.insert(w).second) next.insert(w);
        front = std::move(next);
    }
    return near;
}

std::vector<Vector3d> normals_of(const TetDomain& domain) {
    const BoundarySurface& surface = domain.surface();
    std::vector<Vector3d> normals(domain.vertex_count(), Vector3d::Zero());
    for (const auto t : surface.mesh.triangles.rowwise()) {
        const auto corner = [&](int k) { return Vector3d(surface.mesh.vertices.row(t[k]).transpose()); };
        const Vector3d normal = (corner(1) - corner(0)).cross(corner(2) - corner(0));
        for (const Index v : t) normals[surface.vertex_map[v]] += normal;
    }
    return normals;
}

}  // namespace

void smooth_matched(const TetDomain& domain, const EdgeMatchings& matchings, const std::vector<Index>& vertices,
                    Quaternions& frames) {
    if (vertices.empty()) return;
    const auto neighbours = neighbours_of(domain);
    const std::vector<Vector3d> normals = normals_of(domain);
    std::set<Index> free = rings_round(neighbours, vertices);
    for (const Index v : domain.features().edges.reshaped()) free.erase(domain.surface().vertex_map[v]);
    for (const Index v : domain.features().corners) free.erase(domain.surface().vertex_map[v]);
    for (int sweep = 0; sweep < sweeps; ++sweep)
        for (const Index v : free) {
            Eigen::Vector4d sum = Eigen::Vector4d::Zero();
            for (const Index w : neighbours[v]) {
                const Eigen::Vector4d said =
                    frames::to_wxyz(frames::from_wxyz(frames.row(w)) * frames::octahedral_group()[matchings(w, v)]);
                const double same = said.dot(sum.norm() > 0 ? sum : Eigen::Vector4d(frames.row(v).transpose()));
                sum += same < 0 ? Eigen::Vector4d(-said) : said;
            }
            if (!(sum.norm() > 1e-6)) continue;
            const Quaternion old = frames::from_wxyz(frames.row(v));
            Quaternion now = frames::from_wxyz(Eigen::RowVector4d(sum.normalized().transpose()));
            if (normals[v].norm() > 0) {
                const Vector3d unit = axis_unit(nearest_axis_number(old.conjugate() * normals[v]));
                now = Quaternion::FromTwoVectors(now * unit, old * unit) * now;
            }
            frames.row(v) = frames::to_wxyz(now).transpose();
        }
}

}  // namespace octafield::volume::detail
