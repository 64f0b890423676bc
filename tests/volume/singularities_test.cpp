#include "octafield/volume/singularities.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <set>

#include "octafield/error.hpp"
#include "octafield/frames/octahedral_group.hpp"
#include "tet_fixtures.hpp"

namespace octafield::volume {
namespace {

using frames::Quaternion;
using frames::Vector3;
using testing::kuhn_grid;
using testing::sample;

// [-1/2, 1/2]^3, moved a little so that the z axis passes through no vertex, edge or cell diagonal.
TetMesh cube_round_axis(int n) {
    return kuhn_grid(n, n, n, 1.0 / n, Vector3(-0.5 + 0.137 / n, -0.5 + 0.071 / n, -0.5));
}

// The frame turns by `turns` quarter turns for each turn round the z axis.
Quaternions axis_field(const TetMesh& mesh, int turns, const Quaternion& offset = Quaternion::Identity()) {
    return sample(mesh, [&](const Vector3& x) {
        return frames::exp({0, 0, turns * std::atan2(x.y(), x.x()) / 4}) * offset;
    });
}

class StraightLine : public ::testing::TestWithParam<int> {};

TEST_P(StraightLine, IsOneCurveThroughTheCubeWithTheIndexOfTheField) {
    const int turns = GetParam();
    const TetMesh mesh = cube_round_axis(7);
    const SingularGraph graph = singular_graph(mesh, axis_field(mesh, turns));
    ASSERT_EQ(graph.curves.size(), 1u);
    EXPECT_EQ(graph.curve_quarter_turns[0], turns);
    EXPECT_EQ(graph.complex_triangles, 0);
    EXPECT_TRUE(graph.nodes.empty());
    for (const SingularTriangle& t : graph.triangles) EXPECT_EQ(t.quarter_turns, turns);
    EXPECT_EQ(std::count_if(graph.triangles.begin(), graph.triangles.end(), [](const auto& t) { return t.boundary; }),
              2);
    EXPECT_TRUE(graph.triangles[graph.curves[0].front()].boundary);
    EXPECT_TRUE(graph.triangles[graph.curves[0].back()].boundary);
    // The curve stays in the cells round the axis and spans the cube.
    EXPECT_LT(graph.points.leftCols(2).rowwise().norm().maxCoeff(), 1.5 / 7);
    EXPECT_NEAR(graph.length, 1,
                1e-12);  // the interpolant's zeros of a field that does not change along z lie on one line
}

TEST_P(StraightLine, ObliqueToTheMeshIsHardlyLongerThanTheLine) {
    TetMesh mesh = cube_round_axis(9);
    mesh.vertices = mesh.vertices * frames::exp({0.5, 0.3, 0.2}).toRotationMatrix().transpose();
    const SingularGraph graph = singular_graph(mesh, axis_field(mesh, GetParam()));
    ASSERT_EQ(graph.curves.size(), 1u);
    EXPECT_EQ(graph.curve_quarter_turns[0], GetParam());
    EXPECT_EQ(graph.complex_triangles, 0);
    const auto ends = graph.points.row(graph.curves[0].front()) - graph.points.row(graph.curves[0].back());
    const double excess = graph.length / ends.norm() - 1;
    RecordProperty("excess", std::to_string(excess));
    EXPECT_GE(excess, 0);
    EXPECT_LT(excess, 0.25);
}

TEST_P(StraightLine, KeepsItsSignWhereTheFramesTurnAboutAnAxisFarFromTheCurve) {
    const Vector3 axis = Vector3(std::sin(0.6), 0, std::cos(0.6));  // 34 degrees from the line
    TetMesh mesh = cube_round_axis(9);
    mesh.vertices = mesh.vertices * frames::exp({0.5, 0.3, 0.2}).toRotationMatrix().transpose();
    const Quaternion base = frames::frame_from_axes({0, 1, 0}, axis);
    const SingularGraph graph =
        singular_graph(mesh, sample(mesh, [&](const Vector3& x) {
                           return frames::exp(GetParam() * std::atan2(x.y(), x.x()) / 4 * axis) * base;
                       }));
    ASSERT_EQ(graph.curves.size(), 1u);
    for (const SingularTriangle& t : graph.triangles) EXPECT_EQ(t.quarter_turns, GetParam());
}

INSTANTIATE_TEST_SUITE_P(QuarterTurns, StraightLine, ::testing::Values(1, -1));

TEST(Singularities, OfAConstantOrSmoothFieldThereAreNone) {
    const TetMesh mesh = cube_round_axis(5);
    const SingularGraph graph =
        singular_graph(mesh, sample(mesh, [](const Vector3& x) { return frames::exp(0.9 * x); }));
    EXPECT_TRUE(graph.triangles.empty());
    EXPECT_TRUE(graph.curves.empty());
    EXPECT_EQ(graph.points.rows(), 0);
    EXPECT_EQ(graph.length, 0);
}

// One tet with a constructed field: the base triangle's frames are turned by 0, 120 and 240 degrees times `factor`
// about `axis`, the apex keeps the first frame.
Quaternions fan(const Vector3& axis, double step) {
    Quaternions frames(4, 4);
    for (int k = 0; k < 3; ++k) frames.row(k) = frames::to_wxyz(frames::exp(k * step * axis.normalized())).transpose();
    frames.row(3) = frames.row(0);
    return frames;
}

TetMesh tet_of_fan() {
    TetMesh mesh{Points(4, 3), Tets(1, 4)};
    mesh.vertices << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0.2, 0.2, 1;
    mesh.tets << 0, 1, 2, 3;
    return mesh;
}

TEST(Singularities, AThirdTurnRoundATriangleIsComplex) {
    // A third turn about (1,1,1) is a symmetry of the frame, so three steps of 40 degrees return to the first frame.
    const SingularGraph graph = singular_graph(tet_of_fan(), fan({1, 1, 1}, 2 * std::numbers::pi / 9));
    ASSERT_FALSE(graph.triangles.empty());
    EXPECT_EQ(graph.triangles[0].quarter_turns, 0);
    EXPECT_EQ(frames::octahedral_class(graph.triangles[0].holonomy), frames::OctahedralClass::third_turn);
    EXPECT_EQ(graph.complex_triangles, static_cast<int>(graph.triangles.size()));
    EXPECT_EQ(graph.curves.size(), 1u);
}

TEST(Singularities, HolonomyIsTheTurnOfTheFrameCarriedRoundTheTriangle) {
    // Steps of 30 degrees about z: carried on they make a quarter turn about +z, in the frame of the lowest vertex.
    const SingularGraph graph = singular_graph(tet_of_fan(), fan({0, 0, 1}, std::numbers::pi / 6));
    ASSERT_EQ(graph.triangles.size(), 2u);
    EXPECT_EQ(graph.triangles[0].a, 0);
    EXPECT_EQ(graph.triangles[0].b, 1);
    EXPECT_EQ(graph.triangles[0].c, 2);
    const Quaternion h = frames::octahedral_group()[graph.triangles[0].holonomy];
    EXPECT_TRUE(h.isApprox(frames::exp({0, 0, std::numbers::pi / 2}), 1e-12));
    EXPECT_EQ(graph.triangles[0].quarter_turns, 1);
}

TEST(Singularities, PointIsWhereTheInterpolatedFieldVanishesInItsTurningPart) {
    // About z the sh4 vector is a constant plus a unit circle in (a_-4, a_4); thirds of the circle balance at the
    // centroid.
    const SingularGraph graph = singular_graph(tet_of_fan(), fan({0, 0, 1}, std::numbers::pi / 6));
    EXPECT_LT((graph.triangles[0].point - Vector3(1.0 / 3, 1.0 / 3, 0)).norm(), 1e-12);
}

TEST(Singularities, DoNotDependOnTheChoiceAmongTheFortyEightQuaternions) {
    const TetMesh mesh = cube_round_axis(6);
    const Quaternions field = axis_field(mesh, 1, frames::exp({0.2, 0.5, 0.1}));
    const SingularGraph graph = singular_graph(mesh, field);
    std::mt19937_64 generator(3);
    Quaternions other = field;
    for (Eigen::Index v = 0; v < other.rows(); ++v) {
        const Quaternion q = frames::from_wxyz(field.row(v));
        other.row(v) = frames::to_wxyz(q * frames::binary_octahedral_group()[generator() % 48]).transpose();
    }
    const SingularGraph same = singular_graph(mesh, other);
    ASSERT_EQ(same.triangles.size(), graph.triangles.size());
    EXPECT_EQ(same.curves, graph.curves);
    EXPECT_EQ(same.curve_quarter_turns, graph.curve_quarter_turns);
    EXPECT_LT((same.points - graph.points).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(Singularities, TurnWithTheMeshAndItsFrames) {
    const TetMesh mesh = cube_round_axis(6);
    const Quaternions field = axis_field(mesh, -1);
    const Quaternion g = frames::exp({0.7, -0.4, 1.1});
    const TetMesh turned{mesh.vertices * g.toRotationMatrix().transpose(), mesh.tets};
    Quaternions turned_field = field;
    for (Eigen::Index v = 0; v < field.rows(); ++v)
        turned_field.row(v) = frames::to_wxyz(g * frames::from_wxyz(field.row(v))).transpose();
    const SingularGraph before = singular_graph(mesh, field), after = singular_graph(turned, turned_field);
    EXPECT_EQ(after.curves, before.curves);
    EXPECT_EQ(after.curve_quarter_turns, before.curve_quarter_turns);
    EXPECT_NEAR(after.length, before.length, 1e-12);
    EXPECT_LT((after.points - before.points * g.toRotationMatrix().transpose()).cwiseAbs().maxCoeff(), 1e-12);
}

// A block with a square hole along z. The frame (e_r, e_phi, e_z) is turned about e_phi by a quarter of the angle round
// the ring of radius 0.7: continuous everywhere in the block but on the ring.
TetMesh block_with_hole(int n) {
    const double h = 1.0 / n;
    const int side = 2 * n, low = n - n / 3, high = n + n / 3;
    return kuhn_grid(side, side, n, h, Vector3(-1 + 0.013 * h, -1 + 0.029 * h, -0.5 + 0.17 * h),
                     [=](int i, int j, int) { return i < low || i >= high || j < low || j >= high; });
}

Quaternions ring_field(const TetMesh& mesh, int turns) {
    return sample(mesh, [&](const Vector3& x) {
        const double phi = std::atan2(x.y(), x.x()), r = std::hypot(x.x(), x.y());
        const double psi = std::atan2(x.z(), r - 0.7);
        // From e_r towards e_z is a positive turn about e_r x e_z = -e_phi.
        return frames::exp({0, 0, phi}) * frames::exp({0, -turns * psi / 4, 0});
    });
}

TEST(Singularities, ARingIsOneClosedCurve) {
    const TetMesh mesh = block_with_hole(12);
    for (const int turns : {1, -1}) {
        const SingularGraph graph = singular_graph(mesh, ring_field(mesh, turns));
        ASSERT_EQ(graph.curves.size(), 1u);
        EXPECT_EQ(graph.curves[0].front(), graph.curves[0].back());
        EXPECT_EQ(graph.curves[0].size(), graph.triangles.size() + 1);
        EXPECT_EQ(graph.curve_quarter_turns[0], turns);
        for (const SingularTriangle& t : graph.triangles) {
            EXPECT_EQ(t.quarter_turns, turns);
            EXPECT_FALSE(t.boundary);
        }
        const double circle = 2 * std::numbers::pi * 0.7;
        EXPECT_GT(graph.length, 0.97 * circle);
        EXPECT_LT(graph.length, 1.3 * circle);
    }
}

TEST(Singularities, EverySegmentBelongsToOneCurveAndCurvesEndAtNodesBoundaryOrTypeChanges) {
    // Random frames: singular nearly everywhere, every case of the graph occurs.
    const TetMesh mesh = testing::kuhn_cube(4);
    const SingularGraph graph = singular_graph(mesh, frames::random_rotations(mesh.vertices.rows(), 5));
    ASSERT_GT(graph.triangles.size(), 100u);
    ASSERT_GT(graph.nodes.size(), 10u);
    std::set<std::pair<Index, Index>> segments;
    std::size_t count = 0;
    double length = 0;
    std::vector<int> degree(graph.points.rows(), 0);
    for (const auto& curve : graph.curves) {
        ASSERT_GE(curve.size(), 2u);
        for (std::size_t i = 0; i + 1 < curve.size(); ++i, ++count) {
            segments.insert(std::minmax(curve[i], curve[i + 1]));
            length += (graph.points.row(curve[i]) - graph.points.row(curve[i + 1])).norm();
            ++degree[curve[i]], ++degree[curve[i + 1]];
        }
        for (std::size_t i = 1; i + 1 < curve.size(); ++i)
            EXPECT_EQ(std::count(graph.nodes.begin(), graph.nodes.end(), curve[i]), 0);
    }
    EXPECT_EQ(segments.size(), count);
    EXPECT_NEAR(length, graph.length, 1e-9);
    const Index triangles = static_cast<Index>(graph.triangles.size());
    for (Index p = 0; p < graph.points.rows(); ++p) {
        if (p < triangles) {
            EXPECT_EQ(degree[p], graph.triangles[p].boundary ? 1 : 2);  // so no tet has exactly one singular face
        } else {
            EXPECT_GE(degree[p], 3);
        }
    }
}

TEST(Singularities, AreTheSameAtAnyThreadCount) {
    const TetMesh mesh = testing::kuhn_cube(6);
    const Quaternions field = frames::random_rotations(mesh.vertices.rows(), 8);
    const SingularGraph serial = singular_graph(mesh, field, 1), parallel = singular_graph(mesh, field, 5);
    EXPECT_EQ(serial.points, parallel.points);
    EXPECT_EQ(serial.curves, parallel.curves);
    EXPECT_EQ(serial.length, parallel.length);
}

TEST(Singularities, BadInputIsRefused) {
    const TetMesh mesh = testing::kuhn_cube(2);
    EXPECT_THROW(singular_graph(mesh, Quaternions::Zero(mesh.vertices.rows(), 4)), InvalidInput);
    EXPECT_THROW(singular_graph(mesh, Quaternions::Zero(3, 4)), InvalidInput);
    EXPECT_THROW(singular_graph(TetMesh{}, Quaternions(0, 4)), GeometryError);
}

}  // namespace
}  // namespace octafield::volume
