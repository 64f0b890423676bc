// What is told of each singular triangle and segment: its place, its sign, whether chance decided.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "octafield/error.hpp"
#include "octafield/frames/sh4.hpp"
#include "octafield/volume/singularities.hpp"
#include "tet_fixtures.hpp"

namespace octafield::volume {
namespace {

using frames::Sh4;
using frames::Vector3;

Sh4::Vector sh4_at(const Quaternions& frames, Index v) { return Sh4::embed(frames::from_wxyz(frames.row(v))); }

// Barycentric coordinates of a point of the triangle's plane.
Vector3 weights_of(const TetMesh& mesh, const SingularTriangle& t) {
    const Vector3 a = mesh.vertices.row(t.a), b = mesh.vertices.row(t.b), c = mesh.vertices.row(t.c);
    const Vector3 normal = (b - a).cross(c - a);
    const auto part = [&](const Vector3& p, const Vector3& q) {
        return (q - p).cross(t.point - p).dot(normal) / normal.squaredNorm();
    };
    EXPECT_NEAR((t.point - a).dot(normal.normalized()), 0, 1e-12);
    return {part(b, c), part(c, a), part(a, b)};
}

// The shortest vector x of a convex hull is the one for which no corner a has a . x < x . x.
void expect_shortest(const TetMesh& mesh, const Quaternions& frames, const SingularTriangle& t, int& inside) {
    const Vector3 weights = weights_of(mesh, t);
    const std::array<Sh4::Vector, 3> corners{sh4_at(frames, t.a), sh4_at(frames, t.b), sh4_at(frames, t.c)};
    const Sh4::Vector x = weights[0] * corners[0] + weights[1] * corners[1] + weights[2] * corners[2];
    EXPECT_GT(weights.minCoeff(), -1e-12);
    for (const Sh4::Vector& corner : corners) EXPECT_GE(corner.dot(x), x.squaredNorm() - 1e-12);
    inside += weights.minCoeff() > 1e-6;
}

TEST(SingularTriangles, AreWhereTheLinearInterpolantIsShortest) {
    const TetMesh mesh = testing::kuhn_cube(4);
    int inside = 0, all = 0;
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
        const Quaternions frames = frames::random_rotations(mesh.vertices.rows(), seed);
        const SingularGraph graph = singular_graph(mesh, frames);
        for (const SingularTriangle& t : graph.triangles) expect_shortest(mesh, frames, t, inside);
        for (std::size_t i = 0; i < graph.triangles.size(); ++i)
            EXPECT_EQ(Vector3(graph.points.row(i)), graph.triangles[i].point);
        all += static_cast<int>(graph.triangles.size());
    }
    EXPECT_LT(inside, all - 100);  // the others on an edge
}

TEST(SingularTriangles, SegmentsHaveTheTypeOfTheirComplexTriangleElseOfTheFirst) {
    const TetMesh mesh = testing::kuhn_cube(4);
    const SingularGraph graph = singular_graph(mesh, frames::random_rotations(mesh.vertices.rows(), 4));
    const auto count = static_cast<Index>(graph.triangles.size());
    int mixed = 0, complex = 0, undecided = 0;
    for (std::size_t k = 0; k < graph.curves.size(); ++k)
        for (std::size_t i = 0; i + 1 < graph.curves[k].size(); ++i) {
            const auto [low, high] = std::minmax(graph.curves[k][i], graph.curves[k][i + 1]);
            ASSERT_LT(low, count);
            const int first = graph.triangles[low].quarter_turns;
            const int second = high < count ? graph.triangles[high].quarter_turns : first;
            EXPECT_EQ(graph.curve_quarter_turns[k], second == 0 ? 0 : first);
            mixed += first != second;
        }
    for (const SingularTriangle& t : graph.triangles) complex += t.quarter_turns == 0, undecided += t.undecided;
    EXPECT_GT(mixed, 20);
    EXPECT_EQ(graph.complex_triangles, complex);
    EXPECT_EQ(graph.undecided_triangles, undecided);
}

TetMesh one_tet() {
    TetMesh mesh{Points(4, 3), Tets(1, 4)};
    mesh.vertices << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0.2, 0.2, 1;
    mesh.tets << 0, 1, 2, 3;
    return mesh;
}

// Frames turned about z by so many degrees, the fourth one's between the others'.
Quaternions turned(const std::array<double, 4>& degrees) {
    Quaternions frames(4, 4);
    for (int k = 0; k < 4; ++k)
        frames.row(k) = frames::to_wxyz(frames::exp({0, 0, degrees[k] * std::numbers::pi / 180})).transpose();
    return frames;
}

TEST(SingularTriangles, AreUndecidedWhereOneOfTheirEdgesHasTwoSmallestSteps) {
    // 45 degrees from the first to the second, 22.5 on to the third and 22.5 back: a quarter turn, or none.
    for (const double sign : {1.0, -1.0})
        for (const std::array<int, 3> order :
             {std::array{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {1, 0, 2}, {0, 2, 1}, {2, 1, 0}})
            for (const double off : {0.0, 0.001}) {  // degrees
                std::array<double, 4> degrees{};
                degrees[order[0]] = 0, degrees[order[1]] = sign * (45 - off), degrees[order[2]] = sign * 67.5;
                degrees[3] = degrees[order[0]];
                const SingularGraph graph = singular_graph(one_tet(), turned(degrees));
                EXPECT_EQ(graph.undecided_triangles, std::count_if(graph.triangles.begin(), graph.triangles.end(),
                                                                   [](const auto& t) { return t.undecided; }));
                for (const SingularTriangle& t : graph.triangles) {
                    const auto has = [&](int v) { return t.a == v || t.b == v || t.c == v; };
                    const bool has_tie = has(order[1]) && (has(order[0]) || has(3));
                    EXPECT_EQ(t.undecided, off == 0 && has_tie) << t.a << t.b << t.c;
                }
            }
}

// The frame's turns about the curve as it goes up through the tet: towards the apex, or away from it where the mesh is
// turned over.
TEST(SingularTriangles, SignIsThatOfTheTurnAboutTheirPositiveNormal) {
    for (const double sign : {1.0, -1.0})
        for (const std::array<int, 3> order : {std::array{0, 1, 2}, {1, 2, 0}, {1, 0, 2}}) {
            std::array<double, 4> degrees{};
            for (int k = 0; k < 3; ++k) degrees[order[k]] = sign * 30 * k;
            degrees[3] = degrees[0];
            const SingularGraph graph = singular_graph(one_tet(), turned(degrees));
            const int round = order == std::array{1, 0, 2} ? -1 : 1;
            ASSERT_FALSE(graph.triangles.empty());
            EXPECT_EQ(graph.triangles[0].quarter_turns, sign * round) << order[0] << order[1];
        }
}

TEST(SingularTriangles, AreTheSameHoweverVerticesAndTetsAreNumbered) {
    // The sign goes by the geometry: about the curve from the base up, or down where vertices are numbered the other
    // way.
    std::array<int, 4> order{0, 1, 2, 3};
    const TetMesh base = one_tet();
    const Quaternions frames = turned({0, 30, 60, 0});
    do {
        TetMesh mesh = base;
        Quaternions renumbered = frames;
        std::array<Index, 4> number{};
        for (int k = 0; k < 4; ++k) {
            mesh.vertices.row(k) = base.vertices.row(order[k]);
            renumbered.row(k) = frames.row(order[k]);
            number[order[k]] = k;
        }
        std::array<int, 4> begin{0, 1, 2, 3};
        do {
            for (int k = 0; k < 4; ++k) mesh.tets(0, k) = number[begin[k]];
            if (tet_volumes(mesh)[0] < 0) continue;
            for (const SingularTriangle& t : singular_graph(mesh, renumbered).triangles) EXPECT_EQ(t.quarter_turns, 1);
        } while (std::next_permutation(begin.begin(), begin.end()));
    } while (std::next_permutation(order.begin(), order.end()));
}

TEST(SingularTriangles, MeetInsideATetAtTheMeanOfTheirPoints) {
    const TetMesh mesh = testing::kuhn_cube(3);
    const SingularGraph graph = singular_graph(mesh, frames::random_rotations(mesh.vertices.rows(), 6));
    ASSERT_GT(graph.nodes.size(), 10u);
    for (const Index node : graph.nodes) {
        Vector3 sum = Vector3::Zero();
        int count = 0;
        for (const auto& curve : graph.curves)
            for (std::size_t i = 0; i < curve.size(); ++i)
                for (const std::size_t j : {i - 1, i + 1})
                    if (curve[i] == node && j < curve.size()) sum += Vector3(graph.points.row(curve[j])), ++count;
        ASSERT_GE(count, 3);
        EXPECT_LT((sum / count - Vector3(graph.points.row(node))).norm(), 1e-12);
    }
}

TEST(SingularTriangles, TakeFramesWhoseSquareLengthIsOneWithinAMillionth) {
    for (const double off : {-1.1e-6, -0.9e-6, 0.9e-6, 1.1e-6}) {
        Quaternions frames = turned({0, 30, 60, 0});
        frames.row(2) *= std::sqrt(1 + off);
        if (std::abs(off) < 1e-6) {
            EXPECT_EQ(singular_graph(one_tet(), frames).triangles.size(), 2u);
        } else {
            EXPECT_THROW(singular_graph(one_tet(), frames), InvalidInput);
        }
    }
}

}  // namespace
}  // namespace octafield::volume
