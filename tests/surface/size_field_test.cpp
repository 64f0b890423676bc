// Lengths that fit a surface, and remeshing that follows them.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesh_fixtures.hpp"
#include "octafield/error.hpp"
#include "octafield/surface/remesh.hpp"
#include "octafield/surface/validate.hpp"

namespace octafield::surface {

using namespace testing;

namespace {

const FeatureGraph kNone{Edges(0, 2), {}};

TriangleMesh both(const TriangleMesh& a, TriangleMesh b, const Eigen::RowVector3d& shift) {
    b.vertices.rowwise() += shift;
    TriangleMesh sum{Points(a.vertices.rows() + b.vertices.rows(), 3),
                     Triangles(a.triangles.rows() + b.triangles.rows(), 3)};
    sum.vertices << a.vertices, b.vertices;
    sum.triangles << a.triangles, (b.triangles.array() + static_cast<Index>(a.vertices.rows())).matrix();
    return sum;
}

// A ball and, beside it, a ring whose tube is so thin that edges must be much shorter than the ball's.
TriangleMesh ball_and_ring() { return both(icosphere(4), torus(120, 12, 0.5, 0.04), {0, 0, 2}); }

TriangleMesh slab(double thickness, int n = 12) {
    TriangleMesh mesh = cube_surface(n);
    mesh.vertices.col(2) *= thickness;
    return mesh;
}

TEST(SizeField, ACubeNeedsOneLengthOnly) {
    const TriangleMesh cube = cube_surface(4);
    const SizeField field = size_field(cube, detect_features(cube));
    EXPECT_TRUE(field.uniform());
    EXPECT_EQ(field.longest, default_edge_length(cube));
    EXPECT_TRUE((field.lengths.array() == field.longest).all());
    EXPECT_TRUE(field.notes.empty());
    EXPECT_EQ(field.scale, 1);
}

TEST(SizeField, EdgesTurnByTheAngleOnTubes) {
    const double radius = 0.04;
    const TriangleMesh ring = torus(200, 24, 1, radius);
    for (const double angle : {0.2, 0.4}) {
        const SizeField field = size_field(ring, kNone, {.angle = angle, .max_cells = 1e7});
        EXPECT_NEAR(field.lengths.mean(), angle * radius, 0.1 * angle * radius);
    }
}

TEST(SizeField, GrowsSlowlyFromWhereItIsShort) {
    const TriangleMesh surface = both(icosphere(5), torus(120, 12, 0.5, 0.04), {0, 0, 1.06});  // close to the pole
    for (const double growth : {0.2, 0.6}) {
        const SizeField field = size_field(surface, kNone, {.growth = growth, .max_cells = 1e7});
        EXPECT_GT(field.lengths.maxCoeff(), 3 * field.lengths.minCoeff());
        const Edges edges = edge_topology(surface).edges;
        for (const auto edge : edges.rowwise())
            EXPECT_LE(std::abs(field.lengths[edge[0]] - field.lengths[edge[1]]),
                      growth * (surface.vertices.row(edge[0]) - surface.vertices.row(edge[1])).norm() + 1e-12);
    }
}

TEST(SizeField, WallsAndGapsCarryEdgesOfTwiceTheirWidth) {
    const TriangleMesh wall = slab(0.015);
    const auto most = [](const TriangleMesh& mesh) {
        return size_field(mesh, detect_features(mesh), {.max_cells = 1e7}).lengths.maxCoeff();
    };
    EXPECT_LT(2 * 0.015, 0.95 * default_edge_length(wall));
    EXPECT_NEAR(size_field(wall, detect_features(wall), {.max_cells = 1e7}).shortest, 2 * 0.015, 1e-9);
    EXPECT_LE(most(wall), 2 * 0.015 + 0.4 * 0.015 / 2 + 1e-9);  // on the rim, where no wall is
    const TriangleMesh cube = cube_surface(8), pair = both(cube, cube, {0, 0, 1.02});
    const SizeField gap = size_field(pair, detect_features(pair), {.max_cells = 1e7});
    for (Index v = 0; v < pair.vertices.rows(); ++v) {
        const double z = pair.vertices(v, 2);
        if (std::abs(z - 1.01) < 0.011) {
            EXPECT_NEAR(gap.lengths[v], 0.04, 1e-9) << z;
        } else if (z == 0) {
            EXPECT_EQ(gap.lengths[v], gap.longest);
        }
    }
}

TEST(SizeField, StripsBetweenFeatureCurvesCarryEdgesOfTwiceTheirWidth) {
    TriangleMesh cube = cube_surface(50);
    const FeatureGraph sharp = detect_features(cube);
    std::vector<std::pair<Index, Index>> lines;  // on the top: two marked lines, 0.02 apart
    const Edges all = edge_topology(cube).edges;
    for (const auto edge : all.rowwise()) {
        const auto a = cube.vertices.row(edge[0]), b = cube.vertices.row(edge[1]);
        const auto on = [&](double y) { return std::abs(a[1] - y) < 1e-9 && std::abs(b[1] - y) < 1e-9; };
        const auto inside = [](double x) { return x > 0.19 && x < 0.81; };
        if (a[2] == 1 && b[2] == 1 && (on(0.5) || on(0.52)) && inside(a[0]) && inside(b[0]))
            lines.emplace_back(edge[0], edge[1]);
    }
    ASSERT_EQ(lines.size(), 60u);
    Edges edges(sharp.edges.rows() + 60, 2);
    edges.topRows(sharp.edges.rows()) = sharp.edges;
    for (int k = 0; k < 60; ++k) edges.row(sharp.edges.rows() + k) << lines[k].first, lines[k].second;
    const SizeField field = size_field(cube, feature_graph(cube, edges), {.max_cells = 1e7});
    EXPECT_NEAR(field.shortest, 2 * 0.02, 1e-9);
    EXPECT_TRUE(size_field(cube, sharp, {.max_cells = 1e7}).uniform());
}

TEST(SizeField, TurnsAndGrowsWithTheSurface) {
    const TriangleMesh here = ball_and_ring();
    const Eigen::VectorXd lengths = size_field(here, kNone).lengths;
    TriangleMesh there = here;
    there.vertices *= Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
    there.vertices = (1e3 * there.vertices).rowwise() + Eigen::RowVector3d(500, -300, 70);
    EXPECT_LT((size_field(there, kNone).lengths - 1e3 * lengths).cwiseAbs().maxCoeff(),
              1e-6 * lengths.maxCoeff() * 1e3);
}

TEST(SizeField, StaysWithinTheCellsAskedForAndSaysWhatTheyCost) {
    const TriangleMesh surface = ball_and_ring();
    const SizeField free = size_field(surface, kNone, {.max_cells = 1e7});
    EXPECT_EQ(free.scale, 1);
    EXPECT_EQ(free.notes.size(), 1u);
    for (const double most : {1e3, 1e4}) {
        const SizeField bound = size_field(surface, kNone, {.max_cells = most});
        EXPECT_LE(std::max(bound.triangles, bound.tets), most);
        EXPECT_GT(std::max(bound.triangles, bound.tets), 0.95 * most);
        EXPECT_LT((bound.lengths - bound.scale * free.lengths).cwiseAbs().maxCoeff(), 1e-12);
        ASSERT_EQ(bound.notes.size(), 2u);
        EXPECT_NE(bound.notes.back().find("times as long"), std::string::npos) << bound.notes.back();
    }
}

TEST(SizeField, WrongArgumentsAreRefused) {
    const TriangleMesh cube = cube_surface(2);
    EXPECT_THROW(size_field(cube, kNone, {.longest = -1}), InvalidInput);
    EXPECT_THROW(size_field(cube, kNone, {.longest = 1, .shortest = 2}), InvalidInput);
    EXPECT_THROW(size_field(cube, kNone, {.angle = 0}), InvalidInput);
    EXPECT_THROW(size_field(cube, kNone, {.growth = 0}), InvalidInput);
    EXPECT_THROW(size_field(cube, kNone, {.max_cells = 0}), InvalidInput);
    TriangleMesh flipped = cube;
    flipped.triangles.row(3).reverseInPlace();
    EXPECT_THROW(size_field(flipped, kNone), GeometryError);
}

double mean_edge_near(const TriangleMesh& mesh, double z_low, double z_high) {
    double sum = 0;
    int count = 0;
    const Edges edges = edge_topology(mesh).edges;
    for (const auto edge : edges.rowwise()) {
        const auto a = mesh.vertices.row(edge[0]), b = mesh.vertices.row(edge[1]);
        if (std::min(a[2], b[2]) < z_low || std::max(a[2], b[2]) > z_high) continue;
        sum += (a - b).norm();
        ++count;
    }
    return sum / count;
}

TEST(GradedRemesh, EdgesFollowTheField) {
    const TriangleMesh surface = ball_and_ring();
    const SizeField field = size_field(surface, kNone);
    const RemeshResult result = remesh(surface, kNone);
    EXPECT_TRUE(find_defects(result.mesh).empty());
    EXPECT_EQ(euler_characteristic(result.mesh), 2);
    EXPECT_NEAR(signed_volume(result.mesh) / signed_volume(surface), 1, 0.01);
    EXPECT_NEAR(mean_edge_near(result.mesh, -0.9, 0.9) / field.longest, 1, 0.15);
    EXPECT_NEAR(mean_edge_near(result.mesh, 1.9, 2.1) / field.shortest, 1, 0.15);
    EXPECT_NEAR(static_cast<double>(result.mesh.triangles.rows()) / field.triangles, 1, 0.15);
    EXPECT_EQ(result.inner_length, field.longest);
}

TEST(GradedRemesh, StaysNearTheCellsAskedFor) {
    const TriangleMesh surface = ball_and_ring();
    const RemeshResult result = remesh(surface, kNone, {.max_cells = 9000});
    EXPECT_TRUE(find_defects(result.mesh).empty());
    EXPECT_LT(result.mesh.triangles.rows(), 1.2 * 9000);
    EXPECT_LT(result.mesh.triangles.rows(), remesh(surface, kNone).mesh.triangles.rows());
}

// A cone of 46 triangles: the tip is no corner, and every shorter edge near it leaves a smaller tip away.
TEST(GradedRemesh, KeepsTips) {
    constexpr int sides = 22;
    TriangleMesh cone{Points(sides + 2, 3), Triangles(2 * sides, 3)};
    for (int k = 0; k < sides; ++k) {
        const double angle = 2 * std::numbers::pi * k / sides;
        cone.vertices.row(k) << 0, 0.4 * std::cos(angle), 0.4 * std::sin(angle);
        cone.triangles.row(2 * k) << sides, k, (k + 1) % sides;
        cone.triangles.row(2 * k + 1) << sides + 1, (k + 1) % sides, k;
    }
    cone.vertices.row(sides) << 4, 0, 0;
    cone.vertices.row(sides + 1) << 0, 0, 0;
    const FeatureGraph features = detect_features(cone);
    const RemeshResult result = remesh(cone, features);
    EXPECT_TRUE(find_defects(result.mesh).empty());
    EXPECT_LT(result.deviation, deviation_told * shape_size(cone));
    EXPECT_NEAR(signed_volume(result.mesh) / signed_volume(cone), 1, 0.01);
    EXPECT_EQ(result.features.corners, feature_graph(result.mesh, result.features.edges).corners);
}

TEST(GradedRemesh, FeatureCurvesAndCornersStay) {
    const TriangleMesh wall = slab(0.03);
    const FeatureGraph features = detect_features(wall);
    const RemeshResult result = remesh(wall, features);
    EXPECT_EQ(result.features.corners.size(), 8u);
    EXPECT_EQ(detect_features(result.mesh).edges, result.features.edges);
    EXPECT_NEAR(signed_volume(result.mesh), 0.03, 1e-12);
    double length = 0;
    for (const auto edge : result.features.edges.rowwise())
        length += (result.mesh.vertices.row(edge[0]) - result.mesh.vertices.row(edge[1])).norm();
    EXPECT_NEAR(length, 8 + 4 * 0.03, 1e-12);
}

TEST(GradedRemesh, OpenSurfacesKeepTheirBoundary) {
    TriangleMesh bowl = disk(30);  // with a sharp dent in its middle
    for (auto p : bowl.vertices.rowwise()) p[2] = 0.1 * std::exp(-200 * (p[0] * p[0] + p[1] * p[1]));
    const RemeshResult result = remesh(bowl, detect_features(bowl));
    EXPECT_GT(result.inner_length, 0);
    EXPECT_EQ(euler_characteristic(result.mesh), 1);
    EXPECT_NEAR(triangle_areas(result.mesh).sum(), triangle_areas(bowl).sum(), 0.01);
    EXPECT_LT(result.deviation, deviation_told * shape_size(bowl));
}

TEST(GradedRemesh, SameInputSameBits) {
    const TriangleMesh surface = ball_and_ring();
    const RemeshResult a = remesh(surface, kNone), b = remesh(surface, kNone);
    EXPECT_EQ(a.mesh.vertices, b.mesh.vertices);
    EXPECT_EQ(a.mesh.triangles, b.mesh.triangles);
}

}  // namespace
}  // namespace octafield::surface
