// Places and types in the singular graph of random frames, which has triangles of every type; oracles: the rules as the
// header states them, and points of a grid.
#include <gtest/gtest.h>

#include <Eigen/QR>
#include <algorithm>

#include "field_fixtures.hpp"
#include "octafield/error.hpp"
#include "octafield/frames/sh4.hpp"
#include "octafield/volume/singularities.hpp"
#include "tet_fixtures.hpp"

namespace octafield::volume {
namespace {

using frames::Sh4;

struct Tangle {
    TetMesh mesh = testing::kuhn_cube(3);
    Quaternions frames = Quaternions(mesh.vertices.rows(), 4);
    SingularGraph graph;
    Tangle() {
        std::srand(5);
        frames.setRandom();
        frames.rowwise().normalize();
        graph = singular_graph(mesh, frames);
    }
};

TEST(SingularGraphRules, ATriangleIsWhereTheLinearInterpolantIsShortest) {
    const Tangle t;
    int inside = 0;
    for (std::size_t i = 0; i < t.graph.triangles.size(); ++i) {
        const SingularTriangle& s = t.graph.triangles[i];
        Eigen::Matrix<double, 4, 3> corners = Eigen::Matrix<double, 4, 3>::Ones();
        Eigen::Matrix<double, 9, 3> vectors;
        const Index ids[] = {s.a, s.b, s.c};
        for (int k = 0; k < 3; ++k) {
            corners.col(k).head<3>() = t.mesh.vertices.row(ids[k]).transpose();
            vectors.col(k) = Sh4::embed(frames::from_wxyz(t.frames.row(ids[k])));
        }
        EXPECT_EQ(s.point, Eigen::Vector3d(t.graph.points.row(static_cast<Eigen::Index>(i))));
        const Eigen::Vector4d place(s.point.x(), s.point.y(), s.point.z(), 1);
        const Eigen::Vector3d weights = corners.colPivHouseholderQr().solve(place);
        EXPECT_GT(weights.minCoeff(), -1e-12);
        EXPECT_LT((corners * weights - place).norm(), 1e-12);
        inside += weights.minCoeff() > 0.01;
        double shortest = 10;
        const int n = 40;
        for (int a = 0; a <= n; ++a)
            for (int b = 0; a + b <= n; ++b)
                shortest = std::min(shortest, (vectors * Eigen::Vector3d(a, b, n - a - b)).norm() / n);
        EXPECT_LT((vectors * weights).norm(), shortest + 1e-12);
    }
    EXPECT_GT(inside, 10);
}

TEST(SingularGraphRules, ASegmentHasTheTypeOfItsComplexTriangleElseOfTheFirst) {
    const SingularGraph graph = Tangle().graph;
    const auto triangles = static_cast<Index>(graph.triangles.size());
    int mixed = 0;
    double length = 0;
    for (std::size_t c = 0; c < graph.curves.size(); ++c)
        for (std::size_t i = 0; i + 1 < graph.curves[c].size(); ++i) {
            const auto [low, high] = std::minmax(graph.curves[c][i], graph.curves[c][i + 1]);
            length += (graph.points.row(low) - graph.points.row(high)).norm();
            const int first = graph.triangles[low].quarter_turns;
            const int second = high < triangles ? graph.triangles[high].quarter_turns : first;
            EXPECT_EQ(graph.curve_quarter_turns[c], second == 0 ? 0 : first);
            mixed += first != second;
        }
    EXPECT_GT(mixed, 10);
    EXPECT_NEAR(graph.length, length, 1e-9);
}

TEST(SingularGraphRules, QuaternionsAreUnitWithinAMillionthOfTheirSquare) {
    Tangle t;
    for (const double part : {-1.1, -0.9, 0.9, 1.1}) {
        Quaternions frames = t.frames;
        frames.row(5) *= std::sqrt(1 + part * 1e-6);
        if (std::abs(part) < 1)
            EXPECT_NO_THROW(singular_graph(t.mesh, frames));
        else
            EXPECT_THROW(singular_graph(t.mesh, frames), InvalidInput);
    }
}

}  // namespace
}  // namespace octafield::volume
