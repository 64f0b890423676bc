// Singular edges of frames in the tets.

#include "octafield/volume/tet_singularities.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <utility>

#include "field_fixtures.hpp"
#include "octafield/error.hpp"
#include "octafield/frames/octahedral_lift.hpp"
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
    const SingularEdges found =
        singular_edges(mesh, sample_in_tets(mesh, [&](const Vector3& x) {
                           return frames::exp({0, 0, GetParam() * std::atan2(x.y(), x.x()) / 4});
                       }));
    ASSERT_FALSE(found.edges.empty());
    for (const SingularEdge& e : found.edges) {
        const double up = mesh.vertices(e.b, 2) - mesh.vertices(e.a, 2);
        const Quaternion expected =
            frames::exp({0, 0, std::copysign(GetParam() * std::numbers::pi / 2, GetParam() * up)});
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

// A fan of 16 sectors round a column of edges along z, off centre in the body, then tilted and jittered. Frames turn by
// `turns` quarter turns about the column on the way round it; with 16 sectors no step is near a tie for up to 4.
struct Fan {
    TetMesh mesh;
    Quaternions frames;
    frames::Quaternion tilt{frames::exp({0.5, -0.8, 0.3})};
};

Fan fan(int turns, int seed, bool reversed = false) {
    constexpr int sectors = 16, layers = 3;
    Fan result;
    Points& points = result.mesh.vertices;
    points.resize((sectors + 1) * (layers + 1), 3);
    std::mt19937_64 generator(seed);
    const auto jitter = [&] { return 0.03 * (2 * frames::uniform01(generator) - 1); };
    for (int k = 0; k <= layers; ++k) {
        points.row((sectors + 1) * k) << 0.2 + jitter(), 0.1 + jitter(), 0.4 * k + jitter();
        for (int i = 0; i < sectors; ++i) {
            const double angle = 2 * std::numbers::pi * (i + 2 * jitter()) / sectors;
            points.row((sectors + 1) * k + 1 + i) << std::cos(angle) + jitter(), std::sin(angle) + jitter(),
                0.4 * k + jitter();
        }
    }
    std::vector<std::array<Index, 4>> tets;
    for (int k = 0; k < layers; ++k)
        for (int i = 0; i < sectors; ++i) {
            const auto id = [&](int layer, int sector) {
                return (sectors + 1) * (k + layer) + (sector < 0 ? 0 : 1 + (i + sector) % sectors);
            };
            // The prism of a sector; diagonals of its sides run from the column's foot and from the lower sector.
            const bool wraps = i + 1 == sectors;
            tets.push_back({id(0, -1), id(0, 0), id(0, 1), id(1, wraps ? 0 : 1)});
            if (wraps) {
                tets.push_back({id(0, -1), id(0, 1), id(1, 1), id(1, 0)});
            } else {
                tets.push_back({id(0, -1), id(0, 0), id(1, 1), id(1, 0)});
            }
            tets.push_back({id(0, -1), id(1, 0), id(1, 1), id(1, -1)});
        }
    result.mesh.tets.resize(static_cast<Eigen::Index>(tets.size()), 4);
    for (std::size_t t = 0; t < tets.size(); ++t)
        for (int c = 0; c < 4; ++c) result.mesh.tets(t, c) = tets[t][c];
    if (reversed) {  // other ids: every edge runs the other way
        const Index last = static_cast<Index>(points.rows()) - 1;
        points = Points(points.colwise().reverse());
        result.mesh.tets = last - result.mesh.tets.array();
    }
    const TetMesh& mesh = result.mesh;
    result.frames = sample_in_tets(mesh, [&](const Vector3& x) {
        return result.tilt * frames::exp({0, 0, turns * std::atan2(x.y() - 0.1, x.x() - 0.2) / 4});
    });
    result.mesh.vertices = points * result.tilt.toRotationMatrix().transpose();
    return result;
}

class TurnsRoundAColumn : public ::testing::TestWithParam<int> {};

TEST_P(TurnsRoundAColumn, AreToldModuloEightQuartersWithTheirSign) {
    const int turns = GetParam();
    for (const bool reversed : {false, true})
        for (int seed = 0; seed < 5; ++seed) {
            const Fan f = fan(turns, seed, reversed);
            const SingularEdges found = singular_edges(f.mesh, f.frames);
            ASSERT_EQ(found.edges.size(), 3u);
            ASSERT_EQ(found.graph.curves.size(), 1u);
            EXPECT_EQ(found.graph.curve_quarter_turns[0], turns);
            EXPECT_EQ(found.complex_edges, 0);
            EXPECT_EQ(found.undecided_edges, 0);
            EXPECT_EQ(found.tied_triangles, 0);
            for (const SingularEdge& e : found.edges) {
                EXPECT_EQ(e.quarter_turns, turns);
                EXPECT_EQ(e.valence, 4 - turns);
                EXPECT_EQ(e.holonomy == 0, turns == -4);
            }
        }
}

TEST_P(TurnsRoundAColumn, DoNotDependOnTheFortyEightNamesOfAFrame) {
    const Fan f = fan(GetParam(), 7);
    std::mt19937_64 generator(5);
    for (int round = 0; round < 3; ++round) {
        Quaternions renamed = f.frames;
        for (Eigen::Index t = 0; t < renamed.rows(); ++t)
            renamed.row(t) = frames::to_wxyz(frames::from_wxyz(f.frames.row(t)) *
                                             frames::binary_octahedral_group()[generator() % 48])
                                 .transpose();
        const SingularEdges found = singular_edges(f.mesh, renamed);
        ASSERT_EQ(found.edges.size(), 3u);
        for (const SingularEdge& e : found.edges) EXPECT_EQ(e.quarter_turns, GetParam());
    }
}

INSTANTIATE_TEST_SUITE_P(ModuloEight, TurnsRoundAColumn, ::testing::Values(-4, -3, -2, -1, 1, 2, 3));

TEST(LiftedMatching, ProductsAndInversesAreThoseOfTheQuaternionsWithTheirSign) {
    const auto& group = frames::binary_octahedral_group();
    for (int a = 0; a < 48; ++a) {
        EXPECT_TRUE(group[frames::lifted_inverse(a)].isApprox(group[a].conjugate(), 1e-14));
        for (int b = 0; b < 48; ++b) {
            const Quaternion product = group[a] * group[b];
            EXPECT_GT(group[frames::lifted_product(a, b)].dot(product), 1 - 1e-14);
        }
    }
}

TEST(LiftedMatching, IsTheNearestOfTheFortyEightQuaternionsAndATieOnlyWhereTwoAreEquallyNear) {
    const Quaternions rows = frames::random_rotations(200, 3);
    for (Eigen::Index i = 0; i + 1 < rows.rows(); ++i) {
        const Quaternion p = frames::from_wxyz(rows.row(i)), q = frames::from_wxyz(rows.row(i + 1));
        const auto [element, tie] = frames::lifted_matching(p, q);
        EXPECT_FALSE(tie);
        EXPECT_EQ(element % 24, frames::matching(p, q));
        for (const Quaternion& o : frames::binary_octahedral_group())
            EXPECT_LE((p * o).dot(q), (p * frames::binary_octahedral_group()[element]).dot(q) + 1e-14);
        EXPECT_TRUE(frames::lifted_matching(p, p * frames::exp({std::numbers::pi / 4 + 1e-8, 0, 0})).tie);
        EXPECT_FALSE(frames::lifted_matching(p, p * frames::exp({std::numbers::pi / 4 + 1e-5, 0, 0})).tie);
    }
}

TEST(SingularEdges, AreUndecidedWhereAStepIsATie) {
    Fan f = fan(2, 1);
    const SingularEdges sure = singular_edges(f.mesh, f.frames);
    EXPECT_EQ(sure.undecided_edges, 0);
    // One tet's frame is turned to 45 degrees from a neighbour's: two matchings across their triangle are equally near.
    const Index tet = 5, beside = 8;
    f.frames.row(beside) =
        frames::to_wxyz(frames::from_wxyz(f.frames.row(tet)) * frames::exp({0, 0, std::numbers::pi / 4})).transpose();
    const SingularEdges found = singular_edges(f.mesh, f.frames);
    EXPECT_GE(found.tied_triangles, 1);
    EXPECT_GE(found.undecided_edges, 1);
    for (const SingularEdge& e : found.edges) {
        const auto has = [&](Index t, Index v) { return (f.mesh.tets.row(t).array() == v).any(); };
        const bool at_tie = has(tet, e.a) && has(tet, e.b) && has(beside, e.a) && has(beside, e.b);
        EXPECT_EQ(e.undecided, at_tie);
    }
}

TEST(SingularEdges, OfRandomFieldsAreTheSameWhateverTheNamesAndOrdersOfVertices) {
    const TetMesh mesh = jittered_cube(6, 0.2, 10);
    const Quaternions field = frames::random_rotations(mesh.tets.rows(), 21);
    const SingularEdges found = singular_edges(mesh, field);
    Quaternions renamed = field;
    for (Eigen::Index t = 0; t < renamed.rows(); ++t)
        renamed.row(t) =
            frames::to_wxyz(frames::from_wxyz(field.row(t)) * frames::binary_octahedral_group()[(11 * t) % 48])
                .transpose();
    TetMesh reversed = mesh;
    const Index last = static_cast<Index>(mesh.vertices.rows()) - 1;
    reversed.vertices = mesh.vertices.colwise().reverse();
    for (Eigen::Index t = 0; t < mesh.tets.rows(); ++t)
        for (int k = 0; k < 4; ++k) reversed.tets(t, k) = last - mesh.tets(t, k);
    const SingularEdges other = singular_edges(reversed, renamed);
    std::map<std::pair<Index, Index>, std::pair<int, int>> of_edge;
    for (const SingularEdge& e : other.edges) of_edge[{last - e.b, last - e.a}] = {e.quarter_turns, e.valence};
    ASSERT_EQ(of_edge.size(), found.edges.size());
    int half_turns = 0;
    for (const SingularEdge& e : found.edges) {
        EXPECT_EQ(of_edge.at({e.a, e.b}), std::pair(e.quarter_turns, e.valence));
        half_turns += std::abs(e.quarter_turns) == 2;
    }
    EXPECT_GT(half_turns, 3);
}

}  // namespace
}  // namespace octafield::volume
