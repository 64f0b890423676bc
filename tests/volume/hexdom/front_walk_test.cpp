// Ways through tets and over surfaces.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <random>

#include "../../surface/mesh_fixtures.hpp"
#include "curve_points.hpp"
#include "map_fixtures.hpp"
#include "octafield/volume/integrability.hpp"
#include "octafield/volume/locate_points.hpp"
#include "octafield/volume/tetrahedralize.hpp"
#include "surface_walk.hpp"
#include "tet_walk.hpp"

namespace octafield::volume {
namespace {

using Vector3 = Eigen::Vector3d;

Vector3 position(const TetDomain& domain, const FrontPlace& place) {
    Vector3 at = Vector3::Zero();
    for (int k = 0; k < 4; ++k)
        at += place.weights[k] * domain.mesh().vertices.row(domain.mesh().tets(place.tet, k)).transpose();
    return at;
}

FrontPlace located(const TetDomain& domain, const Vector3& at) {
    const LocatedPoints found = locate_points(domain, at.transpose());
    return {found.tet[0], found.weights.row(0).transpose(), -1};
}

// A square corner is missing: x, y > 0.5.
TetDomain l_shape() {
    return testing::with_detected_features(
        testing::kuhn_grid(4, 4, 2, 0.25, Vector3::Zero(), [](int i, int j, int) { return i < 2 || j < 2; }));
}

TEST(TetWalker, ReachesWhatIsInSightAndNothingElse) {
    const TetDomain domain = l_shape();
    const TetWalker walker(domain);
    const auto inside = [](const Vector3& x) {
        return x.minCoeff() > 1e-6 && x.x() < 1 && x.y() < 1 && x.z() < 0.5 && (x.x() < 0.5 || x.y() < 0.5);
    };
    std::mt19937 random(3);
    std::uniform_real_distribution<double> part(0.01, 0.99);
    int reached = 0, blocked = 0;
    while (reached + blocked < 500) {
        const Vector3 a(part(random), part(random), part(random) / 2), b(part(random), part(random), part(random) / 2);
        if (!inside(a)) continue;
        bool in_sight = true;
        for (int i = 1; i <= 1000; ++i) in_sight &= inside(a + (b - a) * i / 1000.0);
        const FrontStep step = walker.along(located(domain, a), b - a);
        ASSERT_EQ(step.place.tet >= 0, in_sight);
        if (in_sight) {
            EXPECT_LT((position(domain, step.place) - b).norm(), 1e-8);
        }
        ++(in_sight ? reached : blocked);
    }
    EXPECT_GT(reached, 50);
    EXPECT_GT(blocked, 50);
}

TEST(TetWalker, BeginsAtVerticesEdgesAndTrianglesInTheTetThatTheWayLeadsInto) {
    const TetDomain domain(testing::jittered_cube(3, 0.2, 1));
    const TetWalker walker(domain);
    const SurfaceWalker surface(domain, surface_curves(domain));
    const Vector3 goal(0.52, 0.47, 0.55);
    for (Index v = 0; v < domain.surface().mesh.vertices.rows(); ++v) {
        const FrontPlace from = surface.at_vertex(v);
        const Vector3 way = goal - position(domain, from);
        const FrontStep step = walker.along(from, way);
        ASSERT_GE(step.place.tet, 0) << v;
        EXPECT_LT((position(domain, step.place) - goal).norm(), 1e-8);
        EXPECT_GT(step.place.weights.minCoeff(), 0);
        EXPECT_LT(walker.along(from, -way).place.tet, 0) << v;
    }
    for (Index t = 0; t < domain.surface().mesh.triangles.rows(); ++t)
        for (const Vector3& weights : {Vector3(0.3, 0.3, 0.4), Vector3(0, 0.4, 0.6)}) {
            const FrontPlace from = surface.place(t, weights);
            const Vector3 way = goal - position(domain, from);
            EXPECT_GE(walker.along(from, way).place.tet, 0) << t;
            EXPECT_LT(walker.along(from, -way).place.tet, 0) << t;
        }
}

// The side of a tube, flat when it is unrolled.
TEST(SurfaceWalker, ArrivesWhereTheUnrolledWayLeadsTo) {
    const TetDomain domain = testing::with_detected_features(testing::tube_quarter(24));
    const SurfaceWalker walker(domain, surface_curves(domain));
    const auto& mesh = domain.surface().mesh;
    const auto on_tube = [](const Vector3& x) { return std::abs(x.head<2>().norm() - 2) < 1e-9; };
    int tried = 0;
    for (Index v = 0; v < mesh.vertices.rows(); ++v) {
        const Vector3 from = mesh.vertices.row(v).transpose();
        const double angle = std::atan2(from.y(), from.x());
        if (!on_tube(from) || angle < 0.1 || angle > 0.8 || from.z() < 0.1 || from.z() > 0.5) continue;
        const Vector3 around(-std::sin(angle), std::cos(angle), 0), up(0, 0, 1);
        const FrontStep step = walker.along(walker.at_vertex(v), 0.8 * around + 0.3 * up);
        ASSERT_GE(step.place.tet, 0);
        const Vector3 at = position(domain, step.place);
        EXPECT_NEAR(at.z(), from.z() + 0.3, 0.01);
        EXPECT_NEAR(2 * std::atan2(at.y(), at.x()), 2 * angle + 0.8, 0.01);
        EXPECT_NEAR(step.direction.norm(), 1, 1e-12);
        EXPECT_NEAR(step.direction.z(), 0.3 / std::hypot(0.8, 0.3), 0.01);
        EXPECT_EQ((step.place.weights.array() == 0).count() > 0, true);
        ++tried;
    }
    EXPECT_GT(tried, 50);
}

TEST(SurfaceWalker, StopsAtCurvesAndDoesNotGoAlongNormals) {
    const TetDomain domain = testing::with_detected_features(testing::jittered_cube(4, 0.2, 2));
    const SurfaceWalker walker(domain, surface_curves(domain));
    const auto& mesh = domain.surface().mesh;
    int tried = 0;
    for (Index t = 0; t < mesh.triangles.rows(); ++t) {
        const FrontPlace from = walker.place(t, Vector3::Constant(1.0 / 3));
        const Vector3 at = position(domain, from);
        if (at.z() < 1 - 1e-9) continue;
        EXPECT_LT(walker.along(from, {0, 0, 0.1}).place.tet, 0);
        EXPECT_LT(walker.along(from, {1.01 - at.x(), 0, 0}).place.tet, 0);
        const FrontStep step = walker.along(from, {0.99 - at.x(), 0, 0});
        ASSERT_GE(step.place.tet, 0);
        EXPECT_LT((position(domain, step.place) - Vector3(0.99, at.y(), 1)).norm(), 1e-9);
        ++tried;
    }
    EXPECT_EQ(tried, 32);
}

TEST(SurfaceWalker, TurnsADirectionAsTheAxisAtTheMiddleIsTurned) {
    const TetDomain domain = testing::with_detected_features(testing::jittered_cube(4, 0.2, 2));
    const SurfaceWalker walker(domain, surface_curves(domain));
    for (Index t = 0; t < domain.surface().mesh.triangles.rows(); ++t) {
        const FrontPlace from = walker.place(t, Vector3::Constant(1.0 / 3));
        if (position(domain, from).z() < 1 - 1e-9) continue;
        const FrontStep half = walker.along(from, {0.01, 0, 0});
        ASSERT_GE(half.place.tet, 0);
        const Vector3 axis = Vector3(std::cos(0.2), std::sin(0.2), 0.3).normalized();
        const Vector3 turned = walker.corrected(half, Vector3(1, 0, 0), axis).normalized();
        EXPECT_LT((turned - Vector3(std::cos(0.2), std::sin(0.2), 0)).norm(), 1e-9);
    }
}

TEST(CurvePoints, AreEvenBetweenCornersAndRoundClosedCurves) {
    const TetDomain cube = testing::with_detected_features(testing::jittered_cube(4, 0.2, 2));
    const Quaternions frames =
        testing::sample(cube.mesh(), [](const Vector3&) { return frames::Quaternion::Identity(); });
    TetAxes axes{tet_frames(cube, frames), Points::Zero(cube.tet_count(), 3)};
    axes.lengths.rowwise() = Eigen::RowVector3d(0.26, 0.34, 5);
    const FrontField field(cube, frames, axes, 1);
    const Edges curves = surface_curves(cube);
    const std::vector<FrontPlace> points = curve_points(cube, curves, SurfaceWalker(cube, curves), field);
    // 4 parts along x, 3 along y, 1 along z.
    ASSERT_EQ(points.size(), 8u + 4 * 3 + 4 * 2);
    for (const FrontPlace& place : points) {
        const Vector3 at = position(cube, place);
        EXPECT_NEAR(at.x() * 4, std::round(at.x() * 4), 1e-9);
        EXPECT_NEAR(at.y() * 3, std::round(at.y() * 3), 1e-9);
        EXPECT_NEAR(at.z(), std::round(at.z()), 1e-9);
    }
}

TEST(CurvePoints, OfAClosedCurveAreThreeAtLeast) {
    // A cylinder: two circles.
    TetMesh mesh = testing::moved_mesh(testing::kuhn_cube(6), [](const Vector3& x) {
        const Eigen::Vector2d square = 2 * x.head<2>() - Eigen::Vector2d::Ones();
        const double longest = square.cwiseAbs().maxCoeff();
        const Eigen::Vector2d disk = longest > 0 ? Eigen::Vector2d(square.normalized() * longest) : square;
        return Vector3(disk.x(), disk.y(), x.z());
    });
    const TetDomain domain = testing::with_detected_features(mesh);
    ASSERT_TRUE(domain.features().corners.empty());
    const Quaternions frames = testing::sample(domain.mesh(), testing::along_cylinder);
    const Edges curves = surface_curves(domain);
    for (const auto& [length, expected] : {std::pair(0.2, 31), {1.1, 6}, {100.0, 3}}) {
        TetAxes axes{tet_frames(domain, frames), Points::Constant(domain.tet_count(), 3, length)};
        const FrontField field(domain, frames, axes, 1);
        const std::vector<FrontPlace> points = curve_points(domain, curves, SurfaceWalker(domain, curves), field);
        EXPECT_NEAR(double(points.size()), 2.0 * expected, 2.1);
        const double spacing = 2 * std::numbers::pi / (double(points.size()) / 2);
        for (const FrontPlace& p : points) {
            double nearest = 10;
            const Vector3 at = position(domain, p);
            EXPECT_TRUE(std::abs(at.z()) < 1e-9 || std::abs(at.z() - 1) < 1e-9);
            for (const FrontPlace& q : points) {
                const Vector3 other = position(domain, q);
                if (&p == &q || std::abs(at.z() - other.z()) > 0.5) continue;
                nearest = std::min(
                    nearest,
                    std::acos(std::clamp(at.head<2>().normalized().dot(other.head<2>().normalized()), -1.0, 1.0)));
            }
            EXPECT_NEAR(nearest, spacing, 0.15 * spacing);
        }
    }
}

}  // namespace
}  // namespace octafield::volume
