// Checks of hex-dominant meshes against the domain they were made in, by nothing of the library's.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "mixed_grids.hpp"
#include "octafield/volume/hex_dominant.hpp"

namespace octafield::volume::testing {

using Vector3 = Eigen::Vector3d;

// By the divergence theorem over faces of one cell, quads as four triangles about their middle.
inline double volume_inside(const MixedMesh& mesh) {
    double volume = 0;
    each_cell(mesh, [&](const std::vector<Index>& cell) {
        Vector3 middle = Vector3::Zero();
        const auto at = [&](Index v) { return Vector3(mesh.vertices.row(v)); };
        for (const Index v : cell) middle += at(v) / static_cast<double>(cell.size());
        for (const auto& face : reference(static_cast<int>(cell.size())).faces) {
            Vector3 centre = Vector3::Zero();
            for (const int k : face) centre += at(cell[k]) / static_cast<double>(face.size());
            double part = 0;
            for (std::size_t k = 0; k < face.size(); ++k) {
                const Vector3 a = at(cell[face[k]]), b = at(cell[face[(k + 1) % face.size()]]);
                part += (a - centre).cross(b - centre).dot(middle - centre) / 6;
            }
            volume += std::abs(part);
        }
    });
    return volume;
}

// Edges of the surface: those of faces of one cell, each as often as faces have it.
inline std::map<std::pair<Index, Index>, int> outside_edges(const MixedMesh& mesh) {
    std::map<std::pair<Index, Index>, int> edges;
    const std::set<std::vector<Index>> faces = outside(mesh);
    each_cell(mesh, [&](const std::vector<Index>& cell) {
        for (const auto& face : reference(static_cast<int>(cell.size())).faces) {
            std::vector<Index> ids;
            for (const int k : face) ids.push_back(cell[k]);
            std::vector<Index> sorted = ids;
            std::sort(sorted.begin(), sorted.end());
            if (!faces.count(sorted)) continue;
            for (std::size_t k = 0; k < ids.size(); ++k) ++edges[std::minmax(ids[k], ids[(k + 1) % ids.size()])];
        }
    });
    return edges;
}

// Faces match, corners are positive, the boundary is closed and the volume near the domain's.
inline void expect_mesh_of(const TetDomain& domain, const HexDominantMesh& result, double volume_error) {
    const MixedMesh& mesh = result.mesh;
    ASSERT_GT(mesh.cell_count(), 0);
    expect_sound(mesh, 0);
    for (const auto& [edge, count] : outside_edges(mesh)) ASSERT_EQ(count % 2, 0) << "the surface is open";
    EXPECT_NEAR(volume_inside(mesh) / tet_volumes(domain.mesh()).sum(), 1, volume_error);
    ASSERT_EQ(result.support.size(), static_cast<std::size_t>(mesh.vertices.rows()));
    std::set<Index> on_surface;
    for (const auto& [edge, count] : outside_edges(mesh)) on_surface.insert({edge.first, edge.second});
    for (Index v = 0; v < mesh.vertices.rows(); ++v) {
        if (domain.regions().empty()) {
            EXPECT_EQ(result.support[v] > 0, on_surface.count(v) > 0) << v;
        }
    }
}

// Straight feature edges of the domain are covered by edges of the mesh: equal length, ends on them; corners are
// vertices.
inline void expect_features_kept(const TetDomain& domain, const HexDominantMesh& result) {
    const MixedMesh& mesh = result.mesh;
    const Points& old = domain.surface().mesh.vertices;
    std::vector<std::pair<Vector3, Vector3>> curves;
    double wanted = 0, covered = 0;
    for (const auto& e : domain.features().edges.rowwise()) {
        curves.emplace_back(old.row(e[0]).transpose(), old.row(e[1]).transpose());
        wanted += (curves.back().second - curves.back().first).norm();
    }
    const auto off = [&](const Vector3& x) {
        double least = 1e9;
        for (const auto& [a, b] : curves) {
            const double t = std::clamp((x - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
            least = std::min(least, (a + t * (b - a) - x).norm());
        }
        return least;
    };
    std::set<std::pair<Index, Index>> edges;
    for (const auto& [edge, count] : outside_edges(mesh))
        if (result.support[edge.first] >= 2 && result.support[edge.second] >= 2) edges.insert(edge);
    for (const auto& [a, b] : edges) {
        const Vector3 p = mesh.vertices.row(a), q = mesh.vertices.row(b);
        if (off(p) < 1e-9 && off(q) < 1e-9 && off((p + q) / 2) < 1e-9) covered += (p - q).norm();
    }
    EXPECT_NEAR(covered, wanted, 1e-9 * wanted);
    for (const Index corner : domain.features().corners) {
        double nearest = 1e9;
        Index vertex = -1;
        for (Index v = 0; v < mesh.vertices.rows(); ++v)
            if (const double d = (mesh.vertices.row(v) - old.row(corner)).norm(); d < nearest) nearest = d, vertex = v;
        EXPECT_LT(nearest, 1e-12);
        EXPECT_EQ(result.support[vertex], 3);
    }
}

}  // namespace octafield::volume::testing
