// Remeshing for its own sake: vertices on the input, good triangles, as many as wanted.
#include "octafield/surface/close_remesh.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "mesh_fixtures.hpp"
#include "octafield/error.hpp"
#include "octafield/surface/triangle_quality.hpp"
#include "octafield/surface/validate.hpp"
#include "surface_walk.hpp"

namespace octafield::surface {
namespace {

using namespace testing;

Eigen::VectorXd all(const TriangleMesh& mesh, double length) {
    return Eigen::VectorXd::Constant(mesh.vertices.rows(), length);
}

// A sheet rolled up, three turns that are `gap` apart: angle along, height across.
TriangleMesh rolled(double gap, int along, int across) {
    std::vector<Eigen::Vector3d> points;
    std::vector<Eigen::Vector3i> triangles;
    for (int i = 0; i <= along; ++i)
        for (int j = 0; j <= across; ++j) {
            const double turns = 3. * i / along, r = 0.5 + gap * turns;
            points.emplace_back(r * std::cos(2 * std::numbers::pi * turns), r * std::sin(2 * std::numbers::pi * turns),
                                static_cast<double>(j) / across);
            if (i == along || j == across) continue;
            const int a = i * (across + 1) + j, b = a + across + 1;
            triangles.insert(triangles.end(), {{a, b, b + 1}, {a, b + 1, a + 1}});
        }
    return make_mesh(points, triangles);
}

TEST(TriangleQuality, IsOneForEquilateralTrianglesAndAProductOfSinesForOthers) {
    const TriangleMesh mesh = make_mesh({{0, 0, 0}, {1, 0, 0}, {0.5, std::sqrt(0.75), 0}, {0.2, 0.1, 0}, {2, 0, 0}},
                                        {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}});
    const Eigen::VectorXd qualities = triangle_qualities(mesh);
    EXPECT_NEAR(qualities[0], 1, 1e-15);
    const double a = std::atan2(0.1, 0.2), b = std::atan2(0.1, 0.8), c = std::numbers::pi - a - b;
    EXPECT_NEAR(qualities[1], 8 * std::sin(a / 2) * std::sin(b / 2) * std::sin(c / 2), 1e-14);
    EXPECT_EQ(qualities[2], 0) << "three points on a line";
}

class CloseRemeshAtSizes : public ::testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(InputUnits, CloseRemeshAtSizes, ::testing::Values(1e-6, 1.0, 1e6));

TEST_P(CloseRemeshAtSizes, CornersStayAndVerticesLieOnTheCube) {
    TriangleMesh cube = cube_surface(3);
    cube.vertices *= GetParam();
    const FeatureGraph features = detect_features(cube);
    const CloseRemeshResult result = close_remesh(cube, features, all(cube, 0.15 * GetParam()));
    EXPECT_TRUE(find_defects(result.mesh).empty());
    EXPECT_EQ(result.features.corners.size(), 8u);
    EXPECT_NEAR(triangle_areas(result.mesh).sum() / (GetParam() * GetParam()), 6, 1e-12);
    for (const auto point : result.mesh.vertices.rowwise())
        EXPECT_LT((point / GetParam()).cwiseMin((1 - (point / GetParam()).array()).matrix()).minCoeff(), 1e-12);
    EXPECT_GT(triangle_qualities(result.mesh).minCoeff(), 0.3);
    EXPECT_EQ(result.poor, 0);
}

TEST(CloseRemesh, MeetsTheNumberOfVerticesWithGoodTriangles) {
    const TriangleMesh ring = torus(60, 24, 1, 0.4);
    for (const int wanted : {400, 3000}) {
        const CloseRemeshResult result = close_remesh(ring, {}, all(ring, 1), {.vertices = double(wanted)});
        EXPECT_NEAR(result.mesh.vertices.rows(), wanted, 0.05 * wanted);
        EXPECT_GT(triangle_qualities(result.mesh).minCoeff(), 0.3);
        EXPECT_EQ(euler_characteristic(result.mesh), 0);
        EXPECT_LT(result.off_surface, 1e-14);
    }
}

TEST(CloseRemesh, EdgesBecomeShorterUntilTheDeviationIsKept) {
    const TriangleMesh ball = icosphere(4);
    const CloseRemeshResult coarse = close_remesh(ball, {}, all(ball, 0.5));
    EXPECT_GT(coarse.deviation, 0.02);
    const CloseRemeshResult close = close_remesh(ball, {}, all(ball, 0.5), {.deviation = 0.01});
    EXPECT_LE(std::max(close.deviation, close.own_deviation), 0.01);
    EXPECT_GT(close.mesh.vertices.rows(), coarse.mesh.vertices.rows());
    double lowest = 1;  // by the ball itself, from which its triangles are up to 0.0012 away
    for (const auto t : close.mesh.triangles.rowwise())
        lowest = std::min(
            lowest,
            (close.mesh.vertices.row(t[0]) + close.mesh.vertices.row(t[1]) + close.mesh.vertices.row(t[2])).norm() / 3);
    EXPECT_GT(lowest, 1 - 0.01 - 0.0025);
}

TEST(CloseRemesh, LengthsVaryAsTheyAreGiven) {
    const TriangleMesh plate = cube_surface(12);
    Eigen::VectorXd lengths(plate.vertices.rows());
    for (Index v = 0; v < lengths.size(); ++v) lengths[v] = 0.03 + 0.09 * plate.vertices(v, 0);
    const CloseRemeshResult result = close_remesh(plate, detect_features(plate), lengths);
    double low = 0, high = 0;
    Index lows = 0, highs = 0;
    for (const auto t : result.mesh.triangles.rowwise())
        for (int k = 0; k < 3; ++k) {
            const Eigen::RowVector3d a = result.mesh.vertices.row(t[k]), b = result.mesh.vertices.row(t[(k + 1) % 3]);
            const double middle = (a[0] + b[0]) / 2;
            if (middle < 0.2) low += (a - b).norm(), ++lows;
            if (middle > 0.8) high += (a - b).norm(), ++highs;
        }
    EXPECT_NEAR(low / lows, 0.035, 0.01);
    EXPECT_NEAR(high / highs, 0.11, 0.03);
}

// Nearest points would go from one turn of the roll to the next, a twelfth of an edge away.
TEST(CloseRemesh, TurnsOfARollStayApart) {
    const TriangleMesh roll = rolled(0.01, 240, 12);
    const CloseRemeshResult result = close_remesh(roll, detect_features(roll), all(roll, 0.12));
    EXPECT_FALSE(result.kept);
    EXPECT_EQ(euler_characteristic(result.mesh), 1);
    EXPECT_NEAR(triangle_areas(result.mesh).sum() / triangle_areas(roll).sum(), 1, 0.02);
    EXPECT_GT(triangle_qualities(result.mesh).minCoeff(), 0.3);
}

TEST(SurfaceWalk, StaysOnItsSheetWhereAnotherIsNearer) {
    const TriangleMesh roll = rolled(0.01, 240, 12);
    const Background ground = background_of(roll, detect_features(roll), all(roll, 9), 9, 9);
    SurfaceWalk walk(ground);
    const Index start = 80 * 13 + 6;  // after one turn, half way up
    const Eigen::Vector3d here = roll.vertices.row(start), next = roll.vertices.row(160 * 13 + 6);
    const std::array carriers{walk.carrier_of(start)};
    const auto found = walk.on_surface(carriers, ground.patch[0], next);
    ASSERT_TRUE(found);
    EXPECT_LT((found->point - here).norm(), 1e-3) << "on the turn where it began";
    EXPECT_LT((GroundTrees(ground).nearest(ground.patch[0], next).point - next).norm(), 1e-12)
        << "where the nearest point is on the next";
}

TEST(CloseRemesh, ThinWallsKeepTheirSides) {
    TriangleMesh plate = cube_surface(4);
    plate.vertices.col(2) *= 1e-3;
    const CloseRemeshResult result = close_remesh(plate, detect_features(plate), all(plate, 0.1));
    EXPECT_TRUE(find_defects(result.mesh).empty());
    EXPECT_NEAR(signed_volume(result.mesh), 1e-3, 1e-12);
    EXPECT_GT(triangle_qualities(result.mesh).minCoeff(), 0.3);
}

TEST(CloseRemesh, TrianglesInCornersOfTheInputAreTold) {
    // A flat wedge of 4 degrees.
    const TriangleMesh wedge =
        make_mesh({{0, 0, 0}, {1, 0, 0}, {std::cos(4 * degree), std::sin(4 * degree), 0}}, {{0, 1, 2}});
    const CloseRemeshResult result = close_remesh(wedge, detect_features(wedge), all(wedge, 0.05));
    EXPECT_GE(result.forced, 1);
    EXPECT_EQ(result.poor, result.forced);
    ASSERT_EQ(result.notes.size(), 1u);
    EXPECT_NE(result.notes[0].find("between two feature edges"), std::string::npos);
}

TEST(CloseRemesh, TheSameInputGivesTheSameMesh) {
    const TriangleMesh ring = torus(30, 12, 1, 0.4);
    const auto one = close_remesh(ring, {}, all(ring, 0.2)), two = close_remesh(ring, {}, all(ring, 0.2));
    EXPECT_EQ(one.mesh.vertices, two.mesh.vertices);
    EXPECT_EQ(one.mesh.triangles, two.mesh.triangles);
}

TEST(CloseRemesh, WhatCannotBeAskedForIsRefused) {
    const TriangleMesh ball = icosphere(1);
    const auto kind = [&](const Eigen::VectorXd& lengths, const CloseRemeshOptions& options) {
        try {
            close_remesh(ball, {}, lengths, options);
        } catch (const InvalidInput& error) {
            return error.kind();
        }
        return std::string("none");
    };
    EXPECT_EQ(kind(all(ball, 0), {}), "invalid_option");
    EXPECT_EQ(kind(all(ball, std::nan("")), {}), "invalid_option");
    EXPECT_EQ(kind(Eigen::VectorXd::Ones(3), {}), "wrong_shape");
    EXPECT_EQ(kind(all(ball, 1), {.vertices = -1}), "invalid_option");
    EXPECT_EQ(kind(all(ball, 1), {.quality = 0.9}), "invalid_option");
    EXPECT_EQ(kind(all(ball, 1), {.iterations = 0}), "invalid_option");
    EXPECT_EQ(kind(all(ball, 1e-6), {}), "too_many_cells");
    EXPECT_THROW(close_remesh(ball, {}, all(ball, 0.3), {}, [](auto...) { return false; }), Cancelled);
}

}  // namespace
}  // namespace octafield::surface
