// Principal curvatures and directions against closed forms.
#include "octafield/surface/principal_directions.hpp"

#include <random>

#include "direction_field_fixtures.hpp"

namespace octafield::surface {
namespace {

Vector middle_of(const TriangleMesh& mesh, Index t) {
    return (mesh.vertices.row(mesh.triangles(t, 0)) + mesh.vertices.row(mesh.triangles(t, 1)) +
            mesh.vertices.row(mesh.triangles(t, 2)))
               .transpose() /
           3;
}

double angle_between_lines(const Vector& a, const Vector& b) {
    return std::atan2(a.cross(b).norm(), std::abs(a.dot(b)));
}

// The open cylinder of the given radius round the z axis, z in [0, height], its grid sheared.
TriangleMesh cylinder(int around, int along, double radius, double height) {
    std::vector<Vector> points;
    std::vector<Eigen::Vector3i> triangles;
    for (int j = 0; j <= along; ++j)
        for (int i = 0; i < around; ++i) {
            const double angle = 2 * pi * (i + 0.3 * j) / around;
            points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), height * j / along);
        }
    for (int j = 0; j < along; ++j)
        for (int i = 0; i < around; ++i) {
            const int a = j * around + i, b = j * around + (i + 1) % around;
            triangles.insert(triangles.end(), {{a, b, b + around}, {a, b + around, a + around}});
        }
    return make_mesh(points, triangles);
}

TEST(PrincipalDirections, SphereBendsAlikeInAllDirections) {
    for (const double radius : {1e-6, 1.0, 1e6}) {
        const TriangleMesh mesh = icosphere(3, radius);
        const PrincipalDirections found = principal_directions(mesh);
        EXPECT_NEAR((found.curvatures.array() * radius - 1).abs().maxCoeff(), 0, 1e-6);
        EXPECT_LT(found.anisotropy.maxCoeff(), 1e-6);
        EXPECT_NEAR((found.directions.rowwise().norm().array() - 1).abs().maxCoeff(), 0, 1e-12);
    }
}

TEST(PrincipalDirections, PlaneAndCubeHaveNone) {
    EXPECT_EQ(principal_directions(disk(6)).anisotropy.maxCoeff(), 0);
    const TriangleMesh cube = cube_surface(4);
    const PrincipalDirections found = principal_directions({cube, detect_features(cube)});
    EXPECT_NEAR(found.curvatures.cwiseAbs().maxCoeff(), 0, 1e-12);
    EXPECT_LT(found.anisotropy.maxCoeff(), 1e-12);
    // Without features the edges are bends.
    EXPECT_GT(principal_directions(cube).anisotropy.maxCoeff(), 0.5);
}

TEST(PrincipalDirections, CylinderBendsRoundItsAxisUpToTheBoundary) {
    for (const double unit : {1e-6, 1.0, 1e6}) {
        const TriangleMesh mesh = cylinder(60, 30, 0.7 * unit, 2 * unit);
        const PrincipalDirections found = principal_directions(mesh);
        for (Index t = 0; t < found.anisotropy.size(); ++t) {
            EXPECT_NEAR(found.curvatures(t, 0) * 0.7 * unit, 1, 0.01);
            EXPECT_NEAR(found.curvatures(t, 1) * 0.7 * unit, 0, 0.01);
            EXPECT_LT(angle_between_lines(found.directions.row(t), azimuth(middle_of(mesh, t))), 0.03);
            // |k1| / (|k1| + 1 / diagonal)
            EXPECT_NEAR(found.anisotropy[t], 1 / (1 + 0.7 / std::hypot(1.4, 1.4, 2)), 0.01);
        }
    }
}

TEST(PrincipalDirections, InnerSideOfACylinderHasTheOppositeSign) {
    TriangleMesh mesh = cylinder(40, 10, 1, 1);
    mesh.triangles.col(1).swap(mesh.triangles.col(2));
    const PrincipalDirections found = principal_directions(mesh);
    EXPECT_NEAR(found.curvatures.col(0).mean(), -1, 0.01);
    for (Index t = 0; t < found.anisotropy.size(); ++t)
        EXPECT_LT(angle_between_lines(found.directions.row(t), azimuth(middle_of(mesh, t))), 0.06);
}

TEST(PrincipalDirections, TorusConvergesToSecondOrder) {
    double curvature_error[2], angle_error[2];
    for (const int level : {0, 1}) {
        const TriangleMesh mesh = torus(48 << level, 24 << level, 1, 0.4);
        const PrincipalDirections found = principal_directions(mesh);
        const Points normals = triangle_normals(mesh);
        curvature_error[level] = angle_error[level] = 0;
        for (Index t = 0; t < found.anisotropy.size(); ++t) {
            const Vector x = middle_of(mesh, t), radial = Vector(x.x(), x.y(), 0).normalized(),
                         n = (x - radial).normalized();
            const double cosine = n.dot(radial), exact = cosine / (1 + 0.4 * cosine);
            curvature_error[level] = std::max({curvature_error[level], std::abs(found.curvatures(t, 0) * 0.4 - 1),
                                               std::abs(found.curvatures(t, 1) - exact)});
            // In the triangle's plane, which is off the tangent plane at its middle by O(h).
            const Vector meridian = n.cross(azimuth(x)), face = normals.row(t);
            angle_error[level] = std::max(
                angle_error[level], angle_between_lines(found.directions.row(t), meridian - meridian.dot(face) * face));
        }
    }
    EXPECT_LT(curvature_error[1], 0.02);
    EXPECT_LT(angle_error[1], 0.02);
    EXPECT_GT(curvature_error[0] / curvature_error[1], 3);
    EXPECT_GT(angle_error[0] / angle_error[1], 3);
}

TEST(PrincipalDirections, EllipsoidConverges) {
    // x^2 + y^2 + (z / 2)^2 = 1: meridian and parallel curvatures 2 / w^3 and 2 / w with
    // w^2 = 4 cos^2 u + sin^2 u at the parametric latitude u.
    double errors[2];
    for (const int level : {0, 1}) {
        TriangleMesh mesh = icosphere(4 + level);
        mesh.vertices.col(2) *= 2;
        const PrincipalDirections found = principal_directions(mesh);
        double sum = 0, worst_angle = 0;
        for (Index t = 0; t < found.anisotropy.size(); ++t) {
            const Vector x = middle_of(mesh, t);
            const double sine = std::clamp(x.z() / 2, -1.0, 1.0), w = std::sqrt(4 * (1 - sine * sine) + sine * sine);
            const double parallel = 2 / w, meridian = 2 / (w * w * w);
            const double large = std::max(parallel, meridian), small = std::min(parallel, meridian);
            sum += std::abs(found.curvatures(t, 0) - large) + std::abs(found.curvatures(t, 1) - small);
            if (std::abs(x.z()) < 1)
                worst_angle = std::max(worst_angle, angle_between_lines(found.directions.row(t), azimuth(x)));
        }
        errors[level] = sum / static_cast<double>(found.anisotropy.size());
        EXPECT_LT(worst_angle, 0.06);
    }
    EXPECT_LT(errors[1], 0.01);
    EXPECT_GT(errors[0] / errors[1], 2);
}

TEST(PrincipalDirections, IrregularMeshesKeepTheDirections) {
    // Vertices moved along the cylinder by up to a fifth of the spacing.
    TriangleMesh mesh = cylinder(48, 24, 1, 3);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> shift(-1, 1);
    for (Index v = 0; v < mesh.vertices.rows(); ++v) {
        const double turn = shift(random) * 2 * pi / 48 / 5, z = mesh.vertices(v, 2);
        const bool rim = z < 1e-9 || z > 3 - 1e-9;
        mesh.vertices.row(v) = (Eigen::AngleAxisd(turn, Vector::UnitZ()) * Vector(mesh.vertices.row(v))).transpose();
        if (!rim) mesh.vertices(v, 2) += shift(random) * 3.0 / 24 / 5;
    }
    const PrincipalDirections found = principal_directions(mesh);
    double mean = 0;
    for (Index t = 0; t < found.anisotropy.size(); ++t) {
        const double angle = angle_between_lines(found.directions.row(t), azimuth(middle_of(mesh, t)));
        mean += angle / static_cast<double>(found.anisotropy.size());
        EXPECT_LT(angle, 0.3);
    }
    EXPECT_LT(mean, 0.05);
}

TEST(PrincipalDirections, RefusesTrianglesWithoutArea) {
    const TriangleMesh mesh = make_mesh({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}});
    EXPECT_THROW(principal_directions(mesh), GeometryError);
}

}  // namespace
}  // namespace octafield::surface
