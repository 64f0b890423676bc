// Seeds, plates and checks of polylines, for the tests of streamlines and separatrices.
#pragma once

#include <limits>

#include "direction_field_fixtures.hpp"
#include "octafield/surface/streamlines.hpp"

namespace octafield::surface {

using End = StreamlineEnd;

inline Vector at_angle(double angle) { return Vector(std::cos(angle), std::sin(angle), 0); }
inline Vector outward(const Vector& x) { return x; }
inline Vector from_tube(const Vector& x) { return x - Vector(x.x(), x.y(), 0).normalized(); }

inline Index triangle_at(const TriangleMesh& mesh, const Vector& place) {
    Index best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (Index t = 0; t < mesh.triangles.rows(); ++t) {
        const Vector middle = (mesh.vertices.row(mesh.triangles(t, 0)) + mesh.vertices.row(mesh.triangles(t, 1)) +
                               mesh.vertices.row(mesh.triangles(t, 2))) /
                              3;
        if ((middle - place).norm() < least) {
            least = (middle - place).norm();
            best = t;
        }
    }
    return best;
}

struct Traced {
    SurfaceSingularities singularities;
    std::vector<Streamline> lines;
};

inline Traced trace(const DirectionField& field, const std::vector<StreamlineSeed>& seeds,
                    const StreamlineOptions& options = {}) {
    const SurfaceSingularities singularities = surface_singularities(field);
    return {singularities, streamlines(field, singularities, seeds, options)};
}

inline double distance_to_triangle_plane_and_sides(const TriangleMesh& mesh, Index t, const Vector& p) {
    const Vector a = mesh.vertices.row(mesh.triangles(t, 0)), b = mesh.vertices.row(mesh.triangles(t, 1)),
                 c = mesh.vertices.row(mesh.triangles(t, 2)), n = (b - a).cross(c - a).normalized();
    double outside = std::abs(n.dot(p - a));
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
        outside = std::max(outside, -n.cross((to - from).normalized()).dot(p - from));
    return outside;
}

// Sizes fit, lengths add up, every segment lies in its triangle.
inline void expect_sound(const TriangleMesh& mesh, const std::vector<Streamline>& lines) {
    const double tolerance = 1e-5 * mean_edge_length(mesh);
    for (const Streamline& line : lines) {
        ASSERT_GE(line.points.rows(), 1);
        ASSERT_TRUE(line.points.allFinite());
        ASSERT_EQ(static_cast<Eigen::Index>(line.triangles.size()), line.points.rows() - 1);
        double length = 0;
        for (std::size_t i = 0; i < line.triangles.size(); ++i) {
            const Vector a = line.points.row(i), b = line.points.row(i + 1);
            length += (b - a).norm();
            // A closing segment ends at the first point, beside the curve.
            const bool closing = line.last_end == End::closed && i + 1 == line.triangles.size();
            EXPECT_LT(distance_to_triangle_plane_and_sides(mesh, line.triangles[i], (a + b) / 2),
                      closing ? 0.2 * mean_edge_length(mesh) : tolerance);
        }
        EXPECT_NEAR(length, line.length, 1e-9 * length);
    }
}

}  // namespace octafield::surface
