// Singular edges of frames in the tets.

#include "octafield/volume/tet_singularities.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "field_fixtures.hpp"
#include "octafield/error.hpp"
#include "tet_fixtures.hpp"

namespace octafield::volume {
namespace {

using frames::Quaternion;
using frames::Vector3;
using testing::jittered_cube;
using testing::kuhn_grid;
using testing::sample_in_tets;

// The z axis runs inside one column of edges' surroundings, through no centroid.
class LineInTets : public ::testing::TestWithParam<int> {};

TEST_P(LineInTets, IsOneCurveOfEdgesWithTheIndexOfTheField) {
    const int turns = GetParam();
    const int n = 7;
    TetMesh mesh = kuhn_grid(n, n, n, 1.0 / n, Vector3(-0.5 + 0.137 / n, -0.5 + 0.071 / n, -0.5));
    mesh.vertices = mesh.vertices * frames::exp({0.1, 0.05, 0.02}).toRotationMatrix().transpose();
    const SingularEdges found = singular_edges(mesh, sample_in_tets(mesh, [&](const Vector3& x) {
                                                   return frames::exp({0, 0, turns * std::atan2(x.y(), x.x()) / 4});
                                               }));
    ASSERT_EQ(found.graph.curves.size(), 1u);
    EXPECT_EQ(found.graph.curve_quarter_turns[0], turns);
    EXPECT_EQ(found.complex_edges, 0);
    EXPECT_TRUE(found.graph.nodes.empty());
    for (const SingularEdge& e : found.edges) {
        EXPECT_EQ(e.quarter_turns, turns);
        EXPECT_LT(e.a, e.b);
    }
    EXPECT_EQ(found.graph.curves[0].size(), found.edges.size() + 1);
    EXPECT_LT(found.graph.points.leftCols(2).rowwise().norm().maxCoeff(), 2.0 / n);
    EXPECT_GE(found.graph.length, (found.graph.points.row(found.graph.curves[0].front()) -
                                   found.graph.points.row(found.graph.curves[0].back()))
                                      .norm());
    // Its ends lie on the boundary, where no loop closes.
    std::vector<Index> on_boundary = boundary_surface(mesh).vertex_map;
    for (const Index p : {found.graph.curves[0].front(), found.graph.curves[0].back()})
        EXPECT_TRUE(std::binary_search(on_boundary.begin(), on_boundary.end(), found.vertices[p]));
}

TEST_P(LineInTets, HasTheHolonomyOfTheLoopRightHandedRoundTheEdge) {
    const TetMesh mesh = kuhn_grid(4, 4, 4, 0.25, Vector3(-0.5 + 0.03, -0.5 + 0.02, -0.5));
    const SingularEdges found = singular_edges(mesh, sample_in_tets(mesh, [&](const Vector3& x) {
                                                   return frames::exp({0, 0, GetParam() * std::atan2(x.y(), x.x()) / 4});
                                               }));
    ASSERT_FALSE(found.edges.empty());
    for (const SingularEdge& e : found.edges) {
        const double up = mesh.vertices(e.b, 2) - mesh.vertices(e.a, 2);
        const Quaternion expected = frames::exp({0, 0, std::copysign(GetParam() * std::numbers::pi / 2, GetParam() * up)});
        const Quaternion h = frames::octahedral_group()[e.holonomy];
        EXPECT_NEAR(std::abs(h.dot(expected)), 1, 1e-12);
    }
}

INSTANTIATE_TEST_SUITE_P(QuarterTurns, LineInTets, ::testing::Values(1, -1));

TEST(SingularEdges, AreNoneInASmoothFieldWhateverTheRepresentatives) {
    const TetMesh mesh = jittered_cube(4, 0.2, 9);
    Quaternions field = sample_in_tets(mesh, [](const Vector3& x) { return frames::exp(0.9 * x); });
    EXPECT_TRUE(singular_edges(mesh, field).edges.empty());
    for (Eigen::Index t = 0; t < field.rows(); ++t)
        field.row(t) = frames::to_wxyz(frames::from_wxyz(frames::Vector4(field.row(t).transpose())) *
                                       frames::binary_octahedral_group()[(7 * t) % 48])
                           .transpose();
    EXPECT_TRUE(singular_edges(mesh, field).edges.empty());
    EXPECT_EQ(singular_edges(mesh, field).graph.length, 0);
    EXPECT_THROW(singular_edges(mesh, field.topRows(2)), InvalidInput);
}

// Round an interior vertex the product over its edges is trivial: no curve ends inside, and with one point type.
TEST(SingularEdges, OfRandomFieldsNeverEndInsideAlone) {
    const TetMesh mesh = jittered_cube(4, 0.2, 10);
    const SingularEdges found = singular_edges(mesh, frames::random_rotations(mesh.tets.rows(), 11));
    EXPECT_EQ(found.edges.size(), singular_edges(mesh, frames::random_rotations(mesh.tets.rows(), 11), 3).edges.size());
    std::vector<int> degree(mesh.vertices.rows(), 0);
    for (const SingularEdge& e : found.edges) ++degree[e.a], ++degree[e.b];
    const std::vector<Index> on_boundary = boundary_surface(mesh).vertex_map;
    for (Index v = 0; v < mesh.vertices.rows(); ++v)
        EXPECT_TRUE(degree[v] != 1 || std::binary_search(on_boundary.begin(), on_boundary.end(), v));
    EXPECT_GT(found.edges.size(), 50u);
    EXPECT_FALSE(found.graph.nodes.empty());
}

}  // namespace
}  // namespace octafield::volume
