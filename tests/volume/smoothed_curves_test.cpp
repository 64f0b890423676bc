#include "octafield/volume/smoothed_curves.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <numeric>

#include "octafield/error.hpp"

namespace octafield::volume {
namespace {

SingularGraph one_curve(const Points& points, bool closed) {
    SingularGraph graph;
    graph.points = points;
    std::vector<Index> ids(points.rows());
    std::iota(ids.begin(), ids.end(), 0);
    if (closed) ids.push_back(0);
    graph.curves = {ids};
    graph.curve_quarter_turns = {1};
    return graph;
}

TEST(SmoothedCurves, LoseTheirZigzagAndKeepTheirEnds) {
    constexpr int n = 61;
    Points points(n, 3);
    for (int i = 0; i < n; ++i) points.row(i) << i / (n - 1.0), (i % 3 - 1) * 0.01, (i % 2) * 0.01;
    const SmoothedCurves found = smoothed_curves(one_curve(points, false));
    EXPECT_EQ(found.points.row(0), points.row(0));
    EXPECT_EQ(found.points.row(n - 1), points.row(n - 1));
    EXPECT_GT(smoothed_curves(one_curve(points, false), 0).length, 1.4);
    EXPECT_NEAR(found.length, 1, 0.01);
    EXPECT_EQ(found.length, found.lengths.sum());
}

TEST(SmoothedCurves, OfARingKeepItsLength) {
    constexpr int n = 80;
    Points points(n, 3);
    for (int i = 0; i < n; ++i) {
        const double phi = 2 * std::numbers::pi * i / n, r = 1 + 0.03 * (i % 2);
        points.row(i) << r * std::cos(phi), r * std::sin(phi), 0;
    }
    const SmoothedCurves found = smoothed_curves(one_curve(points, true));
    EXPECT_NEAR(found.length, 2 * std::numbers::pi * 1.015, 0.05);
    // The seam is smoothed like the rest.
    EXPECT_NEAR(found.points.row(0).norm(), found.points.row(n / 2).norm(), 1e-9);
}

TEST(SmoothedCurves, HoldTheNodeOfALoop) {
    SingularGraph graph;
    graph.points = Points::Zero(5, 3);
    graph.points << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1;
    graph.curves = {{0, 1, 2, 3, 0}, {0, 4}};
    graph.curve_quarter_turns = {1, 1};
    const SmoothedCurves found = smoothed_curves(graph);
    EXPECT_EQ(found.points.row(0), graph.points.row(0));
    EXPECT_EQ(found.lengths[1], 1);
    EXPECT_THROW(smoothed_curves(graph, -1), InvalidInput);
    graph.curves[1][1] = 9;
    EXPECT_THROW(smoothed_curves(graph), InvalidInput);
}

}  // namespace
}  // namespace octafield::volume
