// What a surface is, found from its arrays alone.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "octafield/surface/features.hpp"

namespace octafield::volume::testing {

using surface::TriangleMesh;

// How often the triangles run each edge up, and down.
inline std::map<std::pair<Index, Index>, std::pair<int, int>> edge_runs(const TriangleMesh& mesh) {
    std::map<std::pair<Index, Index>, std::pair<int, int>> runs;
    for (const auto t : mesh.triangles.rowwise())
        for (int k = 0; k < 3; ++k) {
            const Index a = t[k], b = t[(k + 1) % 3];
            auto& [up, down] = runs[std::minmax({a, b})];
            ++(a < b ? up : down);
        }
    return runs;
}

inline int euler(const TriangleMesh& mesh) {
    std::set<Index> used(mesh.triangles.data(), mesh.triangles.data() + mesh.triangles.size());
    return static_cast<int>(used.size()) - static_cast<int>(edge_runs(mesh).size()) +
           static_cast<int>(mesh.triangles.rows());
}

inline bool closed_and_oriented(const TriangleMesh& mesh) {
    const auto runs = edge_runs(mesh);
    return std::all_of(runs.begin(), runs.end(), [](const auto& r) { return r.second == std::pair(1, 1); });
}

// Triangles round each vertex, joined across edges, are one.
inline bool one_fan_at_each_vertex(const TriangleMesh& mesh) {
    std::map<Index, std::map<Index, Index>> next;
    for (const auto t : mesh.triangles.rowwise())
        for (int k = 0; k < 3; ++k)
            if (!next[t[k]].emplace(t[(k + 1) % 3], t[(k + 2) % 3]).second) return false;
    for (const auto& [v, ring] : next) {
        std::size_t count = 0;
        Index x = ring.begin()->first;
        do {
            const auto found = ring.find(x);
            if (found == ring.end()) return false;
            x = found->second;
            ++count;
        } while (x != ring.begin()->first && count <= ring.size());
        if (count != ring.size()) return false;
    }
    return true;
}

inline double volume_inside(const TriangleMesh& mesh) {
    double sum = 0;
    for (const auto t : mesh.triangles.rowwise()) {
        const Eigen::Vector3d a = mesh.vertices.row(t[0]), b = mesh.vertices.row(t[1]), c = mesh.vertices.row(t[2]);
        sum += a.cross(b).dot(c) / 6;
    }
    return sum;
}

inline Eigen::Vector3d normal_of(const TriangleMesh& mesh, Index t) {
    const auto at = [&](int k) -> Eigen::Vector3d { return mesh.vertices.row(mesh.triangles(t, k)); };
    return (at(1) - at(0)).cross(at(2) - at(0));
}

inline double area_of(const TriangleMesh& mesh) {
    double sum = 0;
    for (Index t = 0; t < mesh.triangles.rows(); ++t) sum += normal_of(mesh, t).norm() / 2;
    return sum;
}

inline double length_of(const TriangleMesh& mesh, const Edges& edges) {
    double sum = 0;
    for (const auto e : edges.rowwise()) sum += (mesh.vertices.row(e[0]) - mesh.vertices.row(e[1])).norm();
    return sum;
}

inline double distance_to_triangle(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                   const Eigen::Vector3d& c) {
    const Eigen::Vector3d n = (b - a).cross(c - a);
    const auto inside = [&](const Eigen::Vector3d& x, const Eigen::Vector3d& y) {
        return n.dot((y - x).cross(p - x)) >= 0;
    };
    if (inside(a, b) && inside(b, c) && inside(c, a)) return std::abs(n.normalized().dot(p - a));
    const auto to_segment = [&](const Eigen::Vector3d& x, const Eigen::Vector3d& y) {
        const double s = std::clamp((p - x).dot(y - x) / (y - x).squaredNorm(), 0.0, 1.0);
        return (p - x - s * (y - x)).norm();
    };
    return std::min({to_segment(a, b), to_segment(b, c), to_segment(c, a)});
}

// The greatest distance of vertices of `from` in use from the surface `to`.
inline double greatest_distance(const TriangleMesh& from, const TriangleMesh& to) {
    double greatest = 0;
    const std::set<Index> used(from.triangles.data(), from.triangles.data() + from.triangles.size());
    for (const Index v : used) {
        const Eigen::Vector3d p = from.vertices.row(v);
        double least = 1e300;
        for (const auto t : to.triangles.rowwise()) {
            const Eigen::Vector3d a = to.vertices.row(t[0]);
            if ((p - a).norm() > 1 && least < 1e300) continue;
            least = std::min(least, distance_to_triangle(p, a, to.vertices.row(t[1]), to.vertices.row(t[2])));
        }
        greatest = std::max(greatest, least);
    }
    return greatest;
}

}  // namespace octafield::volume::testing
