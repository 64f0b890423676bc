// Meshes with known geometry, for tests.
#pragma once

#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "octafield/surface/triangle_mesh.hpp"

namespace octafield::surface::testing {

inline constexpr double degree = std::numbers::pi / 180;

inline TriangleMesh make_mesh(const std::vector<Eigen::Vector3d>& points,
                              const std::vector<Eigen::Vector3i>& triangles) {
    TriangleMesh mesh;
    mesh.vertices.resize(static_cast<Eigen::Index>(points.size()), 3);
    mesh.triangles.resize(static_cast<Eigen::Index>(triangles.size()), 3);
    for (std::size_t i = 0; i < points.size(); ++i) mesh.vertices.row(i) = points[i];
    for (std::size_t i = 0; i < triangles.size(); ++i) mesh.triangles.row(i) = triangles[i];
    return mesh;
}

// An icosahedron, each triangle split in four `subdivisions` times: 10 * 4^s + 2 vertices.
inline TriangleMesh icosphere(int subdivisions, double radius = 1) {
    const double g = std::numbers::phi;
    std::vector<Eigen::Vector3d> points = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                                           {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    std::vector<Eigen::Vector3i> triangles = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                              {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                              {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                              {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
    for (int level = 0; level < subdivisions; ++level) {
        std::map<std::pair<int, int>, int> middles;
        const auto middle = [&](int a, int b) {
            const auto [place, fresh] = middles.try_emplace(std::minmax(a, b), static_cast<int>(points.size()));
            if (fresh) points.push_back(points[a] + points[b]);
            return place->second;
        };
        for (auto& point : points) point.normalize();
        std::vector<Eigen::Vector3i> finer;
        for (const auto& t : triangles) {
            const int a = middle(t[0], t[1]), b = middle(t[1], t[2]), c = middle(t[2], t[0]);
            finer.insert(finer.end(), {{t[0], a, c}, {t[1], b, a}, {t[2], c, b}, {a, b, c}});
        }
        triangles = std::move(finer);
    }
    for (auto& point : points) point *= radius / point.norm();
    return make_mesh(points, triangles);
}

// The unit cube [0, 1]^3, n x n squares of two triangles per side: 6 n^2 + 2 vertices.
inline TriangleMesh cube_surface(int n) {
    std::vector<Eigen::Vector3d> points;
    std::vector<Eigen::Vector3i> triangles;
    std::map<std::vector<int>, int> ids;
    const auto vertex = [&](int axis, int side, int i, int j) {
        std::vector<int> place(3);
        place[axis] = side * n;
        place[(axis + 1) % 3] = i;
        place[(axis + 2) % 3] = j;
        const auto [id, fresh] = ids.try_emplace(place, static_cast<int>(points.size()));
        if (fresh) points.emplace_back(Eigen::Vector3d(place[0], place[1], place[2]) / n);
        return id->second;
    };
    for (int axis = 0; axis < 3; ++axis)
        for (int side = 0; side < 2; ++side)
            for (int i = 0; i < n; ++i)
                for (int j = 0; j < n; ++j) {
                    const int a = vertex(axis, side, i, j), b = vertex(axis, side, i + 1, j);
                    const int c = vertex(axis, side, i + 1, j + 1), d = vertex(axis, side, i, j + 1);
                    if (side == 1) {
                        triangles.insert(triangles.end(), {{a, b, c}, {a, c, d}});
                    } else {
                        triangles.insert(triangles.end(), {{a, c, b}, {a, d, c}});
                    }
                }
    return make_mesh(points, triangles);
}

// Round the z axis, R from the axis to the middle of the tube of radius r; n_major x n_minor vertices.
inline TriangleMesh torus(int n_major, int n_minor, double R, double r) {
    std::vector<Eigen::Vector3d> points;
    std::vector<Eigen::Vector3i> triangles;
    const auto vertex = [&](int i, int j) { return (i % n_major) * n_minor + j % n_minor; };
    for (int i = 0; i < n_major; ++i)
        for (int j = 0; j < n_minor; ++j) {
            const double u = 2 * std::numbers::pi * i / n_major, v = 2 * std::numbers::pi * j / n_minor;
            const double distance = R + r * std::cos(v);
            points.emplace_back(distance * std::cos(u), distance * std::sin(u), r * std::sin(v));
            const int a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i + 1, j + 1), d = vertex(i, j + 1);
            triangles.insert(triangles.end(), {{a, b, c}, {a, c, d}});
        }
    return make_mesh(points, triangles);
}

// Of a vertex in the middle and rings round it, ring k with `sides` k vertices: sectors of triangles.
inline std::vector<Eigen::Vector3i> concentric_triangles(int sides, int rings) {
    std::vector<Eigen::Vector3i> triangles;
    const auto vertex = [=](int ring, int i) {
        return ring == 0 ? 0 : 1 + sides * ring * (ring - 1) / 2 + i % (sides * ring);
    };
    for (int ring = 1; ring <= rings; ++ring)
        for (int sector = 0; sector < sides; ++sector)
            for (int i = 0; i < ring; ++i) {
                const int outer = sector * ring + i, inner = sector * (ring - 1) + i;
                triangles.emplace_back(vertex(ring, outer), vertex(ring, outer + 1), vertex(ring - 1, inner));
                if (i + 1 < ring)
                    triangles.emplace_back(vertex(ring - 1, inner), vertex(ring, outer + 1),
                                           vertex(ring - 1, inner + 1));
            }
    return triangles;
}

// The open unit disk in z = 0, seen from +z, of concentric rings: ring k has 6 k vertices, nearly equilateral
// triangles.
inline TriangleMesh disk(int rings) {
    std::vector<Eigen::Vector3d> points = {{0, 0, 0}};
    for (int ring = 1; ring <= rings; ++ring)
        for (int i = 0; i < 6 * ring; ++i) {
            const double angle = 2 * std::numbers::pi * i / (6 * ring);
            points.emplace_back(std::cos(angle) * ring / rings, std::sin(angle) * ring / rings, 0);
        }
    return make_mesh(points, concentric_triangles(6, rings));
}

// Every triangle with its own three vertices.
inline TriangleMesh as_soup(const TriangleMesh& mesh) {
    TriangleMesh soup;
    soup.vertices.resize(3 * mesh.triangles.rows(), 3);
    soup.triangles.resize(mesh.triangles.rows(), 3);
    for (Index t = 0; t < mesh.triangles.rows(); ++t)
        for (int k = 0; k < 3; ++k) {
            soup.vertices.row(3 * t + k) = mesh.vertices.row(mesh.triangles(t, k));
            soup.triangles(t, k) = 3 * t + k;
        }
    return soup;
}

}  // namespace octafield::surface::testing
