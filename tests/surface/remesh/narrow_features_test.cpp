// Feature curves that meet at a few degrees, or run beside one another.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "better_triangles.hpp"
#include "mesh_fixtures.hpp"
#include "narrow_corners.hpp"
#include "octafield/surface/close_remesh.hpp"
#include "octafield/surface/triangle_quality.hpp"
#include "octafield/surface/validate.hpp"

namespace octafield::surface {
namespace {

using namespace testing;

Eigen::VectorXd even(const TriangleMesh& mesh, double length) {
    return Eigen::VectorXd::Constant(mesh.vertices.rows(), length);
}

// A prism over a triangle with sides 1 and an angle at the origin.
TriangleMesh wedge(double angle, double height) {
    std::vector<Eigen::Vector3d> points;
    for (const double z : {0., height})
        points.insert(points.end(), {{0, 0, z}, {1, 0, z}, {std::cos(angle), std::sin(angle), z}});
    return make_mesh(points, {{0, 2, 1}, {3, 4, 5}, {0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {2, 0, 3}, {2, 3, 5}});
}

TEST(NarrowCorners, NoTriangleIsHeldBetweenCurvesThatMeetAtFourDegrees) {
    const TriangleMesh prism = wedge(4 * degree, 0.3);
    const FeatureGraph features = detect_features(prism);
    const CloseRemeshResult result = close_remesh(prism, features, even(prism, 0.05));
    EXPECT_FALSE(result.kept);
    EXPECT_TRUE(find_defects(result.mesh).empty());
    EXPECT_GT(triangle_qualities(result.mesh).minCoeff(), 0.3);
    EXPECT_EQ(result.features.corners.size(), 6u);
    EXPECT_NEAR(signed_volume(result.mesh) / signed_volume(prism), 1, 0.01);
    EXPECT_LT(result.own_deviation, 0.0125) << "a quarter of the length";
    EXPECT_TRUE(std::ranges::any_of(result.notes, [](const std::string& note) {
        return note.find("less than 12 degrees") != std::string::npos && note.find("(2 times)") != std::string::npos;
    })) << "once at the top, once at the bottom";
    const CloseRemeshResult followed = close_remesh(prism, features, even(prism, 0.05), {.keep_stubs = true});
    EXPECT_EQ(followed.forced, 2) << "where all curves of a file are followed";
    EXPECT_LT(triangle_qualities(followed.mesh).minCoeff(), 0.14) << "a needle of 4 degrees";
}

// As on a toy ant that ships with pyvista: a face of one flat triangle, of quality 0.28. Its long side can only be
// split in a good triangle and one worse than itself, beyond the crease, which a flip mends.
TEST(NarrowCorners, AFlatFaceIsSplitWhereTheOtherSideIsFlipped) {
    const TriangleMesh mesh =
        make_mesh({{0, 0, 0}, {1.146, 0, 0}, {0.442, 0.234, 0}, {1.209, 0, -0.606}, {0.4, 0, -1.2}, {1.8, 0, -0.3}},
                  {{0, 1, 2}, {1, 0, 3}, {0, 4, 3}, {1, 3, 5}});
    ASSERT_NEAR(triangle_qualities(mesh)[0], 0.2825, 0.002);
    FeatureGraph features = detect_features(mesh);
    features.corners = {0, 1, 2, 3, 4, 5};
    const Background ground = background_of(mesh, features, even(mesh, 4), 4, 0.01);
    CloseRounds rounds(ground);
    Working work(ground.mesh, ground.features);
    rounds.begin(work);
    better_triangles(work, rounds, 0.35, 1, [] {});
    EXPECT_GT(triangle_qualities(to_arrays(work.marked).mesh).minCoeff(), 0.35);
}

TEST(NarrowCorners, WiderOnesAndRimsAreFollowed) {
    const auto count = [](const TriangleMesh& mesh) {
        Background ground = background_of(mesh, detect_features(mesh), even(mesh, 0.05), 0.05, 0.001);
        const Edges before = ground.features.edges;
        const int found = let_go_narrow_corners(ground, 1);
        EXPECT_EQ(found == 0, before.rows() == ground.features.edges.rows());
        return found;
    };
    EXPECT_EQ(count(wedge(11 * degree, 0.3)), 2);
    EXPECT_EQ(count(wedge(13 * degree, 0.3)), 0);
    EXPECT_EQ(count(make_mesh({{0, 0, 0}, {1, 0, 0}, {1, 0.05, 0}}, {{0, 1, 2}})), 0) << "a leaf, all rim";
}

// The curve that is let go begins where it is far enough from the other, and the sides it parted are one patch.
TEST(NarrowCorners, TheCurveBeginsWhereItIsApart) {
    const TriangleMesh prism = wedge(4 * degree, 0.3);
    Background ground = background_of(prism, detect_features(prism), even(prism, 0.02), 0.02, 0.001);
    ASSERT_EQ(ground.patches, 5);
    for (const double most : {0.002, 1.}) {
        Background left = ground;
        ASSERT_EQ(let_go_narrow_corners(left, most), 2);
        EXPECT_EQ(left.patches, 3) << "top and bottom have become one with a side";
        std::vector<int> ends(left.mesh.vertices.rows(), 0);
        for (const Index v : left.features.edges.reshaped()) ++ends[v];
        int begins = 0;
        for (Index v = 0; v < left.mesh.vertices.rows(); ++v) {
            if (ends[v] != 1) continue;
            ++begins;
            const double away = left.mesh.vertices.row(v).head<2>().norm() * std::sin(4 * degree);
            EXPECT_GT(away, std::min(most, 0.005));
            EXPECT_LT(away, std::min(most, 0.005) + 0.02 * std::sin(4 * degree) + 1e-12) << "no farther than an edge";
        }
        EXPECT_EQ(begins, 2);
    }
}

TEST(CloseRemesh, EdgesBesideFeaturesAreAsShortAsTheStripBetweenThem) {
    TriangleMesh plate = cube_surface(4);
    plate.vertices.col(2) *= 5e-4;  // of an edge of 0.3: 1/600
    const CloseRemeshResult result = close_remesh(plate, detect_features(plate), even(plate, 0.3));
    EXPECT_GT(triangle_qualities(result.mesh).minCoeff(), 0.3);
    EXPECT_NEAR(signed_volume(result.mesh), 5e-4, 1e-12);
}

}  // namespace
}  // namespace octafield::surface
