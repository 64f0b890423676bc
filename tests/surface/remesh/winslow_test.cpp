// Winslow's functional against grids that are known to have the least.
#include "octafield/surface/winslow.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "mesh_fixtures.hpp"
#include "octafield/error.hpp"

namespace octafield::surface {
namespace {

using namespace testing;

// n x n squares of the unit square, with vertices inside shaken.
struct Grid {
    Points points;
    Quads quads;
    Triangles triangles;  // every second diagonal is the same
};

Grid grid(int n, double shaken) {
    Grid found{Points((n + 1) * (n + 1), 3), Quads(n * n, 4), Triangles(0, 3)};
    std::mt19937 random(1);
    const auto shift = [&] { return shaken / n * (static_cast<double>(random()) / 4294967296. - 0.5); };
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j) {
            const bool inside = i > 0 && j > 0 && i < n && j < n;
            found.points.row(i * (n + 1) + j) << double(i) / n + (inside ? shift() : 0),
                double(j) / n + (inside ? shift() : 0), 0;
            if (i < n && j < n)
                found.quads.row(i * n + j) << i * (n + 1) + j, (i + 1) * (n + 1) + j, (i + 1) * (n + 1) + j + 1,
                    i * (n + 1) + j + 1;
        }
    return found;
}

TriangleMesh square() { return make_mesh({{-1, -1, 0}, {2, -1, 0}, {2, 2, 0}, {-1, 2, 0}}, {{0, 1, 2}, {0, 2, 3}}); }

TEST(Winslow, AShakenGridBecomesTheGridAgain) {
    const Grid exact = grid(6, 0), shaken = grid(6, 0.8);
    const WinslowResult result = winslow_smooth(square(), {}, shaken.points, shaken.triangles, shaken.quads, {},
                                                {.rounds = 300, .tolerance = 0});
    EXPECT_GT(result.before, 1.05);
    EXPECT_NEAR(result.after, 1, 1e-8);
    EXPECT_LT((result.points - exact.points).cwiseAbs().maxCoeff(), 1e-4);
    EXPECT_EQ(result.moved, 25);
}

TEST(Winslow, QuadsThatAreTurnedOverAreTurnedBack) {
    Grid folded = grid(4, 0);
    folded.points.row(2 * 5 + 2) << 0.9, 0.6, 0;  // across the next column
    const WinslowResult result = winslow_smooth(square(), {}, folded.points, folded.triangles, folded.quads, {},
                                                {.rounds = 300, .tolerance = 0});
    EXPECT_GT(result.before, 2);
    EXPECT_NEAR(result.after, 1, 1e-6);
}

TEST(Winslow, TrianglesRoundAVertexBecomeEquilateral) {
    TriangleMesh star = disk(1);
    star.vertices.row(0) << 0.4, 0.2, 0;
    const WinslowResult result =
        winslow_smooth(square(), {}, star.vertices, star.triangles, Quads(0, 4), {}, {.rounds = 100, .tolerance = 0});
    EXPECT_LT(result.points.row(0).norm(), 1e-5);
    EXPECT_NEAR(result.after, 1, 1e-9);
}

TEST(Winslow, VerticesStayOnARoundSurfaceAndOnesThatAreHeldInPlace) {
    const TriangleMesh ball = icosphere(4);
    TriangleMesh coarse = icosphere(2);
    std::mt19937 random(2);
    for (Index v = 0; v < coarse.vertices.rows(); ++v)
        for (int k = 0; k < 3; ++k) coarse.vertices(v, k) += 0.1 * (static_cast<double>(random()) / 4294967296. - 0.5);
    const WinslowResult result =
        winslow_smooth(ball, {}, coarse.vertices, coarse.triangles, Quads(0, 4), {7, 11}, {.rounds = 30});
    EXPECT_EQ(result.points.row(7), coarse.vertices.row(7));
    EXPECT_EQ(result.points.row(11), coarse.vertices.row(11));
    for (Index v = 0; v < result.points.rows(); ++v)
        if (v != 7 && v != 11) {
            EXPECT_NEAR(result.points.row(v).norm(), 1, 0.003) << "no farther than the ball's triangles";
        }
    EXPECT_LT(result.after - 1, 0.6 * (result.before - 1));
}

TEST(Winslow, FeaturesAreNotLeft) {
    const TriangleMesh cube = cube_surface(4);
    TriangleMesh fine = cube_surface(8);
    const WinslowResult result =
        winslow_smooth(cube, detect_features(cube), fine.vertices, fine.triangles, Quads(0, 4));
    for (Index v = 0; v < fine.vertices.rows(); ++v) {
        int sides = 0;
        for (int k = 0; k < 3; ++k) sides += fine.vertices(v, k) == 0 || fine.vertices(v, k) == 1;
        if (sides > 1) {
            EXPECT_EQ(result.points.row(v), fine.vertices.row(v));
        }
    }
}

TEST(Winslow, WhatItCannotUseIsRefused) {
    const Grid all = grid(2, 0);
    Quads wrong = all.quads;
    wrong(0, 0) = 99;
    EXPECT_THROW(winslow_smooth(square(), {}, all.points, all.triangles, wrong), InvalidInput);
    EXPECT_THROW(winslow_smooth(square(), {}, all.points, all.triangles, all.quads, {-1}), InvalidInput);
    Points points = all.points;
    points(4, 0) = std::nan("");
    EXPECT_THROW(winslow_smooth(square(), {}, points, all.triangles, all.quads), InvalidInput);
}

}  // namespace
}  // namespace octafield::surface
