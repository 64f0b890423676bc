// Features are found, and remeshing keeps what must be kept.
#include "octafield/surface/remesh.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "mesh_fixtures.hpp"
#include "octafield/error.hpp"
#include "octafield/surface/read_write.hpp"
#include "octafield/surface/validate.hpp"

namespace octafield::surface {
namespace {

using namespace testing;
namespace fs = std::filesystem;
constexpr double kDegree = std::numbers::pi / 180;

double length(const TriangleMesh& mesh, const Edges& edges) {
    double sum = 0;
    for (const auto edge : edges.rowwise()) sum += (mesh.vertices.row(edge[0]) - mesh.vertices.row(edge[1])).norm();
    return sum;
}

// A closed cylinder along z, n sides.
TriangleMesh cylinder(int n) {
    std::vector<Eigen::Vector3d> points = {{0, 0, 0}, {0, 0, 1}};
    std::vector<Eigen::Vector3i> triangles;
    for (int i = 0; i < n; ++i) {
        const double angle = 2 * std::numbers::pi * i / n;
        points.emplace_back(std::cos(angle), std::sin(angle), 0);
        points.emplace_back(std::cos(angle), std::sin(angle), 1);
        const int a = 2 + 2 * i, b = 2 + 2 * ((i + 1) % n);
        triangles.insert(triangles.end(), {{a, b, b + 1}, {a, b + 1, a + 1}, {0, b, a}, {1, a + 1, b + 1}});
    }
    return make_mesh(points, triangles);
}

void expect_corners_kept(const TriangleMesh& before, const FeatureGraph& features, const RemeshResult& after) {
    ASSERT_EQ(after.features.corners.size(), features.corners.size());
    const auto sorted_points = [](const TriangleMesh& mesh, const std::vector<Index>& ids) {
        std::vector<std::array<double, 3>> points;
        for (const Index v : ids) points.push_back({mesh.vertices(v, 0), mesh.vertices(v, 1), mesh.vertices(v, 2)});
        std::ranges::sort(points);
        return points;
    };
    EXPECT_EQ(sorted_points(before, features.corners), sorted_points(after.mesh, after.features.corners))
        << "to the last bit";
}

class FeaturesAtSizes : public ::testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(InputUnits, FeaturesAtSizes, ::testing::Values(1e-6, 1.0, 1e6));

TEST_P(FeaturesAtSizes, TheCubeHasTwelveFeatureCurvesAndEightCorners) {
    TriangleMesh cube = cube_surface(5);
    cube.vertices *= GetParam();
    const FeatureGraph features = detect_features(cube);
    EXPECT_EQ(features.edges.rows(), 60);
    EXPECT_EQ(features.corners.size(), 8u);
    EXPECT_NEAR(length(cube, features.edges), 12 * GetParam(), 1e-12 * GetParam());
    EXPECT_TRUE(std::ranges::is_sorted(features.corners));
    for (Index e = 0; e < features.edges.rows(); ++e) EXPECT_LT(features.edges(e, 0), features.edges(e, 1));
}

TEST(Features, SmoothSurfacesHaveNoneAndCirclesHaveNoCorners) {
    EXPECT_EQ(detect_features(icosphere(3)).edges.rows(), 0);
    EXPECT_EQ(detect_features(torus(40, 20, 1, 0.4)).edges.rows(), 0);
    const FeatureGraph rims = detect_features(cylinder(24));
    EXPECT_EQ(rims.edges.rows(), 48);
    EXPECT_TRUE(rims.corners.empty());
    EXPECT_EQ(detect_features(cylinder(24), {.angle = 10 * kDegree}).edges.rows(), 72);
    EXPECT_EQ(detect_features(cylinder(24), {.corner_angle = 10 * kDegree}).corners.size(), 48u);
}

TEST(Features, TheAngleIsStrictlyBetweenTheNormals) {
    const TriangleMesh prism = cylinder(6);  // sides meet at 60 degrees, the lids at 90
    EXPECT_EQ(detect_features(prism, {.angle = 59 * kDegree}).edges.rows(), 18);
    EXPECT_EQ(detect_features(prism, {.angle = 61 * kDegree}).edges.rows(), 12);
    EXPECT_EQ(detect_features(prism, {.angle = 91 * kDegree}).edges.rows(), 0);
}

TEST(Features, BoundariesAreAlwaysFeatures) {
    const TriangleMesh mesh = disk(4);
    const FeatureGraph features = detect_features(mesh);
    EXPECT_EQ(features.edges.rows(), 24);
    EXPECT_TRUE(features.corners.empty());
}

TEST(Features, GivenEdgesAreSortedAndTheirCornersFound) {
    const TriangleMesh cube = cube_surface(2);
    const FeatureGraph detected = detect_features(cube);
    Edges twisted(detected.edges.rows() + 1, 2);
    twisted << detected.edges.rowwise().reverse().colwise().reverse(),
        detected.edges.row(3);  // reversed, in reverse order, one twice
    const FeatureGraph graph = feature_graph(cube, twisted);
    EXPECT_EQ(graph.edges, detected.edges);
    EXPECT_EQ(graph.corners, detected.corners);
    const FeatureGraph piece = feature_graph(cube, detected.edges.topRows(1));
    EXPECT_EQ(piece.corners.size(), 2u) << "both ends of a curve";
    EXPECT_EQ(feature_graph(cube, Edges(0, 2)).corners.size(), 0u);
}

TEST(Features, WrongArgumentsAreRefused) {
    const TriangleMesh cube = cube_surface(2);
    EXPECT_THROW(detect_features(cube, {.angle = 0}), InvalidInput);
    EXPECT_THROW(detect_features(cube, {.angle = 40}), InvalidInput) << "degrees";
    EXPECT_THROW(detect_features(cube, {.corner_angle = std::nan("")}), InvalidInput);
    const Index last = static_cast<Index>(cube.vertices.rows()) - 1;
    for (const auto& [end, kind] : {std::pair(last, "not_an_edge"), std::pair(last + 1, "index_out_of_range")}) {
        Edges wrong(2, 2);
        wrong << 0, 1, 0, end;
        try {
            feature_graph(cube, wrong);
            FAIL();
        } catch (const InvalidInput& error) {
            EXPECT_EQ(error.kind(), kind);
            EXPECT_EQ(error.elements(), std::vector<Index>{1});
        }
    }
}

class RemeshTargets : public ::testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(EdgeLengths, RemeshTargets, ::testing::Values(0.2, 0.1, 0.05));

TEST_P(RemeshTargets, TheCubeStaysACube) {
    for (const double size : {1e-6, 1.0, 1e6}) {
        TriangleMesh cube = cube_surface(4);
        cube.vertices = (cube.vertices.array() + 0.3) * size;
        const FeatureGraph features = detect_features(cube);
        const RemeshResult result = remesh(cube, features, {.edge_length = GetParam() * size});
        EXPECT_TRUE(find_defects(result.mesh).empty());
        EXPECT_EQ(euler_characteristic(result.mesh), 2);
        EXPECT_NEAR(length(result.mesh, result.features.edges) / size, 12, 1e-9);
        EXPECT_NEAR(signed_volume(result.mesh) / std::pow(size, 3), 1, 1e-9);
        EXPECT_NEAR(mean_edge_length(result.mesh) / size, GetParam(), 0.15 * GetParam());
        expect_corners_kept(cube, features, result);
        EXPECT_EQ(feature_graph(result.mesh, result.features.edges).corners, result.features.corners);
        EXPECT_EQ(detect_features(result.mesh).edges, result.features.edges);
    }
}

TEST_P(RemeshTargets, SmoothSurfacesKeepTopologyAndVolume) {
    const TriangleMesh ring = torus(80, 40, 1, 0.4);
    const RemeshResult result = remesh(ring, {Edges(0, 2), {}}, {.edge_length = GetParam()});
    EXPECT_EQ(euler_characteristic(result.mesh), 0);
    EXPECT_EQ(result.features.edges.rows(), 0);
    EXPECT_NEAR(mean_edge_length(result.mesh), GetParam(), 0.15 * GetParam());
    const double inscribed =
        GetParam() == 0.2 ? 0.05 : 0.01;  // chords of the tube, radius 0.4, cut off 4 % at length 0.2
    EXPECT_NEAR(signed_volume(result.mesh) / signed_volume(ring), 1, inscribed);
}

TEST(Remesh, FeatureCirclesWithoutCornersStayCircles) {
    const TriangleMesh tin = cylinder(60);
    const FeatureGraph features = detect_features(tin);
    const RemeshResult result = remesh(tin, features, {.edge_length = 0.1});
    EXPECT_NEAR(length(result.mesh, result.features.edges), 4 * std::numbers::pi, 0.01 * 4 * std::numbers::pi);
    for (const Index v : result.features.edges.reshaped())
        EXPECT_NEAR(result.mesh.vertices.row(v).head<2>().norm(), 1, 2e-3);
    EXPECT_NEAR(signed_volume(result.mesh) / signed_volume(tin), 1, 0.01);
    for (const int degree : feature_graph(result.mesh, result.features.edges).corners)
        ADD_FAILURE() << "the circle is cut at " << degree;
}

TEST(Remesh, TheDefaultLengthIsATwentyFifthOfTheSizeWhicheverWayTheSurfaceLies) {
    const TriangleMesh ball = icosphere(3);
    const double target = shape_size(ball) / 25;
    EXPECT_EQ(default_edge_length(ball), target);
    const RemeshResult result = remesh(ball, {Edges(0, 2), {}});
    EXPECT_NEAR(mean_edge_length(result.mesh), target, 0.15 * target);
    EXPECT_TRUE(result.notes.empty());
    TriangleMesh bar = cube_surface(4);
    bar.vertices.col(0) *= 5;
    TriangleMesh turned = bar;
    turned.vertices *= Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
    EXPECT_NEAR(default_edge_length(turned), default_edge_length(bar), 1e-12);
}

void expect_same_body(const TriangleMesh& before, const RemeshResult& after, double volume) {
    EXPECT_TRUE(find_defects(after.mesh).empty());
    EXPECT_EQ(euler_characteristic(after.mesh), euler_characteristic(before));
    EXPECT_NEAR(signed_volume(after.mesh) / signed_volume(before), 1, volume);
}

// Default lengths are as long as such tubes are thick, or longer.
TEST(Remesh, ThinTubesStayTubesWithoutALengthAndTheNoteSaysWhatItTook) {
    for (const double radius : {0.1, 0.05}) {
        const TriangleMesh ring = torus(400, 24, 1, radius);
        const RemeshResult result = remesh(ring, {Edges(0, 2), {}});
        expect_same_body(ring, result, 0.01);
        EXPECT_LT(result.deviation, deviation_told * shape_size(ring));
        EXPECT_GT(result.deviation, 0);
        ASSERT_EQ(result.notes.size(), 1u) << radius;
        EXPECT_NE(result.notes.front().find("instead of"), std::string::npos) << result.notes.front();
    }
}

TEST(Remesh, AGivenLengthIsShortenedOnlyWhereTheSurfaceWouldBeSpoilt) {
    const TriangleMesh ring = torus(80, 40, 1, 0.4);
    const RemeshResult rough = remesh(ring, {Edges(0, 2), {}}, {.edge_length = 0.25});
    EXPECT_NEAR(mean_edge_length(rough.mesh), 0.25, 0.04);
    ASSERT_EQ(rough.notes.size(), 2u);
    EXPECT_NE(rough.notes.front().find("is not quite that of the input"), std::string::npos) << rough.notes.front();
    EXPECT_NE(rough.notes.back().find("details finer than the edges were flattened"), std::string::npos);
    const RemeshResult spoilt = remesh(ring, {Edges(0, 2), {}}, {.edge_length = 1.5});
    expect_same_body(ring, spoilt, 1);
    EXPECT_LT(mean_edge_length(spoilt.mesh), 0.9);
    ASSERT_FALSE(spoilt.notes.empty());
    EXPECT_NE(spoilt.notes.front().find("would spoil the surface"), std::string::npos) << spoilt.notes.front();
}

TEST(Remesh, RipplesFinerThanTheEdgesAreToldAndSmoothSurfacesAreNot) {
    TriangleMesh ring = torus(240, 96, 1, 0.4);
    for (Index v = 0; v < ring.vertices.rows(); ++v) ring.vertices.row(v) *= 1 + 0.004 * (v % 2 ? 1 : -1);
    const auto told = [](const RemeshResult& result) {
        return std::ranges::any_of(result.notes,
                                   [](const std::string& note) { return note.find("flattened") != note.npos; });
    };
    EXPECT_TRUE(told(remesh(ring, {Edges(0, 2), {}}, {.edge_length = 0.1})));
    EXPECT_FALSE(told(remesh(torus(240, 96, 1, 0.4), {Edges(0, 2), {}}, {.edge_length = 0.1})));
}

TEST(Remesh, WhereNoLengthIsSoundTheTrianglesOfTheInputAreKept) {
    const TriangleMesh ring = torus(60, 12, 1, 0.05);
    const RemeshResult result = remesh(ring, {Edges(0, 2), {}}, {.edge_length = 100});
    EXPECT_EQ(result.mesh.triangles, ring.triangles);
    EXPECT_EQ(result.mesh.vertices, ring.vertices);
    ASSERT_EQ(result.notes.size(), 1u);
    EXPECT_NE(result.notes.front().find("the triangles of the input were kept"), std::string::npos);
}

TEST(Remesh, OpenSurfacesKeepTheirBoundary) {
    const TriangleMesh mesh = disk(10);
    const RemeshResult result = remesh(mesh, detect_features(mesh), {.edge_length = 0.08});
    EXPECT_EQ(euler_characteristic(result.mesh), 1);
    EXPECT_NEAR(length(result.mesh, result.features.edges), length(mesh, detect_features(mesh).edges), 0.01);
    EXPECT_NEAR(triangle_areas(result.mesh).sum(), triangle_areas(mesh).sum(), 0.01);
    EXPECT_EQ(detect_features(result.mesh).edges, result.features.edges);
}

TEST(Remesh, SameInputSameBits) {
    const TriangleMesh ring = torus(30, 15, 1, 0.4);
    const RemeshResult a = remesh(ring, {Edges(0, 2), {}}, {.edge_length = 0.1}),
                       b = remesh(ring, {Edges(0, 2), {}}, {.edge_length = 0.1});
    EXPECT_EQ(a.mesh.vertices, b.mesh.vertices);
    EXPECT_EQ(a.mesh.triangles, b.mesh.triangles);
}

TEST(Remesh, WrongArgumentsAreRefused) {
    const TriangleMesh cube = cube_surface(2);
    const FeatureGraph features = detect_features(cube);
    EXPECT_THROW(remesh(cube, features, {.edge_length = -1}), InvalidInput);
    EXPECT_THROW(remesh(cube, features, {.edge_length = std::nan("")}), InvalidInput);
    EXPECT_THROW(remesh(cube, features, {.edge_length = 1e-9}), InvalidInput) << "more triangles than memory";
    EXPECT_THROW(remesh(cube, features, {.iterations = 0}), InvalidInput);
    FeatureGraph wrong = features;
    wrong.corners.push_back(9999);
    EXPECT_THROW(remesh(cube, wrong), InvalidInput);
    wrong = features;
    wrong.edges.row(0) << 0, 9999;
    EXPECT_THROW(remesh(cube, wrong), InvalidInput);
    TriangleMesh flipped = cube;
    flipped.triangles.row(3).reverseInPlace();
    EXPECT_THROW(remesh(flipped, {Edges(0, 2), {}}), GeometryError);
}

TEST(Remesh, MessagesShowSmallLengths) {
    try {
        remesh(cube_surface(2), {Edges(0, 2), {}}, {.edge_length = 1.25e-7});
        FAIL() << "more triangles than memory";
    } catch (const InvalidInput& error) {
        EXPECT_NE(std::string(error.what()).find("1.25e-07"), std::string::npos) << error.what();
    }
}

TEST(Remesh, TooCoarseATargetStaysSoundAndSaysWhatWasDone) {
    for (const double target : {0.5, 1.0, 3.0, 100.0}) {
        for (const TriangleMesh& mesh : {torus(40, 20, 1, 0.2), cube_surface(4), icosphere(3)}) {
            const RemeshResult result = remesh(mesh, detect_features(mesh), {.edge_length = target});
            EXPECT_TRUE(find_defects(result.mesh).empty());
            EXPECT_EQ(euler_characteristic(result.mesh), euler_characteristic(mesh));
            const bool flat = result.features.corners.size() == 8;  // the cube is a cube at any length
            EXPECT_EQ(result.notes.empty(), flat) << target;
        }
    }
}

TEST(Remesh, ReportsProgressAndCanBeCancelled) {
    const TriangleMesh ball = icosphere(4);
    int calls = 0;
    double last = -1;
    remesh(ball, {Edges(0, 2), {}}, {.edge_length = 0.05}, [&](std::string_view, double fraction, double) {
        ++calls;
        if (fraction < 0) return true;
        EXPECT_GE(fraction, last);
        last = fraction;
        return true;
    });
    EXPECT_GE(calls, 5);
    EXPECT_THROW(
        remesh(ball, {Edges(0, 2), {}}, {}, [&](std::string_view, double fraction, double) { return fraction < 0.3; }),
        Cancelled);
}

TEST(SharedSurfaces, RemeshAtTwoSizes) {
    const fs::path folder = fs::path(OCTAFIELD_SHARED_DATA) / "surfaces";
    if (!fs::exists(folder)) GTEST_SKIP() << "no data in " << folder;
    for (const std::string name : {"s01", "s04", "s15", "s16", "s17", "i10"}) {
        const TriangleMesh mesh = read_surface(folder / (name + "_surface.obj"));
        const FeatureGraph features = detect_features(mesh);
        for (const double parts : {25, 50}) {
            const double target = bounding_box_diagonal(mesh.vertices) / parts;
            const RemeshResult result = remesh(mesh, features, {.edge_length = target});
            EXPECT_EQ(euler_characteristic(result.mesh), euler_characteristic(mesh)) << name;
            EXPECT_NEAR(mean_edge_length(result.mesh), target, 0.15 * target) << name;
            EXPECT_NEAR(length(result.mesh, result.features.edges), length(mesh, features.edges),
                        0.005 * length(mesh, features.edges))
                << name;
            EXPECT_NEAR(signed_volume(result.mesh) / signed_volume(mesh), 1, name == "s16" ? 0.04 : 0.01)
                << name;  // s16: a thin torus
            expect_corners_kept(mesh, features, result);
        }
    }
}

// Each crossed itself or lost its walls at one length for all.
TEST(WildSurfaces, AreSoundWithoutALength) {
    const fs::path folder = fs::path(OCTAFIELD_SHARED_DATA) / "wild";
    if (!fs::exists(folder)) GTEST_SKIP() << "no data in " << folder;
    for (const std::string name : {"pipe_thin.stl", "knob.stl", "screw.stl"}) {
        const TriangleMesh mesh = read_surface(folder / name);
        const RemeshResult result = remesh(mesh, detect_features(mesh));
        expect_same_body(mesh, result, 0.01);
        EXPECT_FALSE(result.notes.empty()) << name;
    }
}

}  // namespace
}  // namespace octafield::surface
