// Prescribed fields, plates and sums, for the tests of direction fields.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <filesystem>
#include <functional>
#include <numeric>
#include <random>

#include "crouzeix_raviart.hpp"
#include "free_system.hpp"
#include "ginzburg_landau.hpp"
#include "line_search.hpp"
#include "mesh_fixtures.hpp"
#include "octafield/error.hpp"
#include "octafield/surface/directions.hpp"
#include "octafield/surface/read_write.hpp"
#include "octafield/surface/surface_singularities.hpp"

namespace octafield::surface {

using detail::Complex;
using testing::cube_surface;
using testing::disk;
using testing::icosphere;
using testing::make_mesh;
using testing::torus;
using Vector = Eigen::Vector3d;
constexpr const char* mbo = "mbo";  // diffusion and projection
using std::numbers::pi;

// The field that follows direction(x) at the edge midpoints x of a surface with normal(x).
inline DirectionField prescribed(const SurfaceDomain& domain, int symmetry,
                                 const std::function<Vector(const Vector&)>& direction,
                                 const std::function<Vector(const Vector&)>& normal) {
    DirectionField field;
    field.symmetry = symmetry;
    field.domain = domain;
    field.values.resize(domain.edge_count());
    const TriangleMesh& mesh = domain.mesh();
    const Edges& edges = domain.topology().edges;
    for (Index e = 0; e < field.values.size(); ++e) {
        const Vector low = mesh.vertices.row(edges(e, 0)), high = mesh.vertices.row(edges(e, 1));
        const Vector middle = (low + high) / 2, along = high - low, d = direction(middle);
        field.values[e] =
            std::polar(1.0, symmetry * std::atan2(normal(middle).normalized().cross(along).dot(d), along.dot(d)));
    }
    return field;
}

inline Complex flat(const Vector& x) { return {x.x(), x.y()}; }

inline Vector up(const Vector&) { return Vector::UnitZ(); }

// Round the z axis.
inline Vector azimuth(const Vector& x) { return Vector(-x.y(), x.x(), 0).normalized(); }

inline int index_sum(const std::vector<SurfaceSingularity>& singularities) {
    return std::accumulate(singularities.begin(), singularities.end(), 0,
                           [](int sum, const auto& s) { return sum + s.index_times_symmetry; });
}

inline std::vector<double> sorted_distances(const std::vector<SurfaceSingularity>& points) {
    std::vector<double> distances;
    for (std::size_t i = 0; i < points.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) distances.push_back((points[i].position - points[j].position).norm());
    std::sort(distances.begin(), distances.end());
    return distances;
}

inline TriangleMesh joined(const std::vector<TriangleMesh>& parts) {
    std::vector<Vector> points;
    std::vector<Eigen::Vector3i> triangles;
    for (const TriangleMesh& part : parts) {
        const int first = static_cast<int>(points.size());
        const Vector shift(3.0 * first, 0, 0);
        for (const auto& row : part.vertices.rowwise()) points.push_back(row.transpose() + shift);
        for (const auto& row : part.triangles.rowwise()) triangles.push_back(row.transpose().array() + first);
    }
    return make_mesh(points, triangles);
}

// n x n squares of two triangles in the unit square, those for which keep(x, y) of the middle is false left out.
inline TriangleMesh plate(int n, const std::function<bool(double, double)>& keep) {
    std::vector<Vector> points;
    std::vector<Eigen::Vector3i> triangles;
    std::map<std::pair<int, int>, int> ids;
    const auto vertex = [&](int i, int j) {
        const auto [place, fresh] = ids.try_emplace({i, j}, static_cast<int>(points.size()));
        if (fresh) points.emplace_back(static_cast<double>(i) / n, static_cast<double>(j) / n, 0);
        return place->second;
    };
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            if (!keep((i + 0.5) / n, (j + 0.5) / n)) continue;
            const int a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i + 1, j + 1), d = vertex(i, j + 1);
            triangles.insert(triangles.end(), {{a, b, c}, {a, c, d}});
        }
    return make_mesh(points, triangles);
}

inline TriangleMesh square(int n) {
    return plate(n, [](double, double) { return true; });
}

inline FeatureGraph all_edges(const TriangleMesh& mesh) { return {edge_topology(mesh).edges, {}}; }

}  // namespace octafield::surface
