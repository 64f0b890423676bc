// Polygons and sums for the tests of non-orthogonal fields.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <functional>

#include "mesh_fixtures.hpp"
#include "octafield/error.hpp"
#include "octafield/surface/non_orthogonal_field.hpp"
#include "octafield/surface/remesh.hpp"

namespace octafield::surface {

using std::numbers::pi;
using testing::degree;
using testing::disk;
using testing::icosphere;
using testing::make_mesh;
using Vector = Eigen::Vector3d;

// Triangles of edge length about h in a convex polygon in z = 0, corners counter-clockwise.
inline TriangleMesh polygon(const std::vector<Vector>& corners, double h) {
    Vector middle = Vector::Zero();
    for (const Vector& corner : corners) middle += corner / static_cast<double>(corners.size());
    std::vector<Vector> points = corners;
    points.push_back(middle);
    std::vector<Eigen::Vector3i> triangles;
    const int n = static_cast<int>(corners.size());
    Edges boundary(n, 2);
    for (int i = 0; i < n; ++i) {
        const int next = (i + 1) % n;
        triangles.emplace_back(i, next, n);
        boundary.row(i) << std::min(i, next), std::max(i, next);
    }
    const TriangleMesh coarse = make_mesh(points, triangles);
    RemeshOptions options;
    options.edge_length = h;
    return remesh(coarse, feature_graph(coarse, boundary, 0.02), options).mesh;
}

// Sides of length 1 and 1.3.
inline TriangleMesh parallelogram(double angle, double h) {
    const Vector slant(std::cos(angle), std::sin(angle), 0);
    return polygon({{0, 0, 0}, {1.3, 0, 0}, Vector(1.3, 0, 0) + slant, slant}, h);
}

// Right angles on the left, `angle` at the bottom right; height 1.
inline TriangleMesh right_trapezoid(double angle, double h, double top = 0.8) {
    return polygon({{0, 0, 0}, {top + 1 / std::tan(angle), 0, 0}, {top, 1, 0}, {0, 1, 0}}, h);
}

// Triangle with two sides of length 1 and `angle` between them, at the origin, symmetric to the x axis.
inline TriangleMesh wedge(double angle, double h) {
    const double c = std::cos(angle / 2), s = std::sin(angle / 2);
    return polygon({{0, 0, 0}, {c, -s, 0}, {c, s, 0}}, h);
}

inline TriangleMesh moved(TriangleMesh mesh, const std::function<Vector(const Vector&)>& move) {
    for (Index v = 0; v < mesh.vertices.rows(); ++v)
        mesh.vertices.row(v) = move(mesh.vertices.row(v).transpose()).transpose();
    return mesh;
}

inline Index vertex_at(const TriangleMesh& mesh, const Vector& place) {
    Index best = 0;
    (mesh.vertices.rowwise() - place.transpose()).rowwise().squaredNorm().minCoeff(&best);
    return best;
}

inline std::vector<SurfaceSingularity> inside(const SurfaceSingularities& all) {
    std::vector<SurfaceSingularity> points;
    for (const auto& point : all.points)
        if (!point.boundary) points.push_back(point);
    return points;
}

// The angle between a line and a direction.
inline double off(const Eigen::RowVector3d& line, const Vector& direction) {
    const Vector a = line.transpose().normalized(), b = direction.normalized();
    return std::atan2(a.cross(b).norm(), std::abs(a.dot(b)));
}

}  // namespace octafield::surface
