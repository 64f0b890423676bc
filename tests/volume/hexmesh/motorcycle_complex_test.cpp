#include "octafield/volume/motorcycle_complex.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include "octafield/volume/all_hex.hpp"
#include "seamless_fixtures.hpp"

namespace octafield::volume {
namespace {

using namespace testing;

// Vertices moved along x where y is low and along y where x is low, so that planes through the concave edge cross tets.
SeamlessMap moved_l_shape(int per_unit) {
    const double h = 1. / per_unit;
    TetMesh mesh = kuhn_grid(2 * per_unit, 2 * per_unit, 2 * per_unit, h, Eigen::Vector3d::Zero(),
                             [&](int i, int j, int) { return i < per_unit || j < per_unit; });
    for (Index v = 0; v < mesh.vertices.rows(); ++v) {
        const double x = mesh.vertices(v, 0), y = mesh.vertices(v, 1);
        const bool in_x = x > 0 && x < 2 && y<1, in_y = y> 0 && y < 2 && x < 1;
        if (in_x) mesh.vertices(v, 0) += 0.45 * h;
        if (in_y) mesh.vertices(v, 1) += 0.45 * h;
    }
    require_valid(mesh);
    return identity_map(mesh);
}

double volume_of(const TetMesh& mesh) { return tet_volumes(mesh).sum(); }

// n unit cubes round the z axis, each cut into cells^3; the parameters are the same in all. In space cubes are prisms
// over rhombi with an angle of 2 pi / n at the axis. `moved`: parameters of vertices between cubes moved.
SeamlessMap fan(int n, int cells, bool moved) {
    const TetMesh cube = kuhn_grid(cells, cells, cells, 1. / cells);
    std::map<std::array<long, 3>, Index> known;
    std::vector<Eigen::Vector3d> points;
    SeamlessMap map;
    const Index each = static_cast<Index>(cube.tets.rows());
    map.mesh.tets.resize(n * each, 4);
    map.parameters.resize(n * each, 12);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> step(-0.15 / cells, 0.15 / cells);
    std::map<std::pair<long, long>, Eigen::Vector2d> steps;  // by distance from the axis and height
    for (int sector = 0; sector < n; ++sector) {
        const auto direction = [&](int i) {
            return Eigen::Vector3d(std::cos(2 * std::numbers::pi * i / n), std::sin(2 * std::numbers::pi * i / n), 0);
        };
        for (Index t = 0; t < each; ++t)
            for (int k = 0; k < 4; ++k) {
                const Eigen::Vector3d at = cube.vertices.row(cube.tets(t, k)).transpose();
                const Eigen::Vector3d point =
                    at[0] * direction(sector) + at[1] * direction(sector + 1) + Eigen::Vector3d(0, 0, at[2]);
                std::array<long, 3> key{};
                for (int i = 0; i < 3; ++i) key[i] = std::lround(1e6 * point[i]);
                const auto [place, added] = known.insert({key, static_cast<Index>(points.size())});
                if (added) points.push_back(point);
                map.mesh.tets(sector * each + t, k) = place->second;
                // Along the side and away from it, as the cube before the side has it, and as the cube behind it.
                Eigen::Vector3d parameters = at;
                const auto moves = [&](double along) {
                    return moved && along > 0 && along < 1 && at[2] > 0 && at[2] < 1;
                };
                const auto of = [&](double along) -> Eigen::Vector2d {
                    const auto [found, fresh] = steps.insert(
                        {{std::lround(along * cells), std::lround(at[2] * cells)}, Eigen::Vector2d::Zero()});
                    if (fresh) found->second = {step(random), step(random)};
                    return found->second;
                };
                if (at[1] == 0 && moves(at[0])) parameters += Eigen::Vector3d(of(at[0])[0], of(at[0])[1], 0);
                if (at[0] == 0 && moves(at[1])) parameters += Eigen::Vector3d(-of(at[1])[1], of(at[1])[0], 0);
                map.parameters.block<1, 3>(sector * each + t, 3 * k) = parameters.transpose();
            }
    }
    map.mesh.vertices.resize(static_cast<Index>(points.size()), 3);
    for (std::size_t v = 0; v < points.size(); ++v) map.mesh.vertices.row(v) = points[v].transpose();
    return map;
}

// Cells of a grid with vertices that are the same joined; `place`: where they are.
SeamlessMap closed_grid(std::array<int, 3> size, const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& same,
                        const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& place) {
    SeamlessMap map = identity_map(kuhn_grid(size[0], size[1], size[2], 1));
    const Points grid = map.mesh.vertices;
    std::map<std::array<long, 3>, Index> known;
    std::vector<Index> number(grid.rows());
    std::vector<Eigen::Vector3d> points;
    for (Index v = 0; v < grid.rows(); ++v) {
        const Eigen::Vector3d at = same(grid.row(v).transpose());
        const std::array<long, 3> key{std::lround(at[0]), std::lround(at[1]), std::lround(at[2])};
        const auto [found, added] = known.insert({key, static_cast<Index>(points.size())});
        if (added) points.push_back(place(at));
        number[v] = found->second;
    }
    map.mesh.vertices.resize(static_cast<Index>(points.size()), 3);
    for (std::size_t v = 0; v < points.size(); ++v) map.mesh.vertices.row(v) = points[v].transpose();
    for (Index& v : map.mesh.tets.reshaped()) v = number[v];
    return map;
}

// Four corners round; turned by half a turn on the way, or not.
SeamlessMap ring(int length, bool turned) {
    const auto same = [=](const Eigen::Vector3d& at) -> Eigen::Vector3d {
        if (at[2] < length) return at;
        return turned ? Eigen::Vector3d(2 - at[0], 2 - at[1], 0) : Eigen::Vector3d(at[0], at[1], 0);
    };
    return closed_grid({2, 2, length}, same, [=](const Eigen::Vector3d& at) {
        const double angle = -2 * std::numbers::pi * at[2] / length;
        const Eigen::Rotation2Dd turn(turned ? angle / 2 : 0);
        const Eigen::Vector2d across = turn * Eigen::Vector2d(at[0] - 1, at[1] - 1);
        const double radius = 5 + across[0];
        return Eigen::Vector3d(radius * std::cos(angle), radius * std::sin(angle), across[1]);
    });
}

TEST(MotorcycleComplex, ABoxNeedsNoWalls) {
    const SeamlessMap map = identity_map(kuhn_grid(3, 2, 2, 0.5));
    const SeamlessMap walled = motorcycle_complex(map);
    EXPECT_EQ(walled.walls.rows(), 0);
    EXPECT_TRUE(walled.mesh.vertices == map.mesh.vertices);
    EXPECT_EQ(block_complex(walled).block_count(), 1);
}

TEST(MotorcycleComplex, AConcaveEdgeGetsItsTwoWalls) {
    SeamlessMap bare = l_shape();
    bare.walls.resize(0, 3);
    EXPECT_EQ(kind_of([&] { block_complex(bare); }), "bent_wall");
    const SeamlessMap walled = motorcycle_complex(bare);
    EXPECT_EQ(block_complex(walled).block_count(), 3);
    EXPECT_EQ(walled.walls.rows(), 2 * 2 * 2);
    EXPECT_EQ(walled.mesh.tets.rows(), bare.mesh.tets.rows());  // the plane goes along triangles
}

TEST(MotorcycleComplex, TetsAreCutWhereNoTriangleLiesInTheWall) {
    const SeamlessMap map = moved_l_shape(3);
    const SeamlessMap walled = motorcycle_complex(map);
    require_valid(walled.mesh);
    EXPECT_GT(walled.mesh.tets.rows(), map.mesh.tets.rows());
    EXPECT_NEAR(volume_of(walled.mesh), 6, 1e-12);
    // Parameters are positions before, so they are afterwards.
    for (Index t = 0; t < walled.mesh.tets.rows(); ++t)
        for (int k = 0; k < 4; ++k)
            EXPECT_LT((walled.parameters.block<1, 3>(t, 3 * k) - walled.mesh.vertices.row(walled.mesh.tets(t, k)))
                          .cwiseAbs()
                          .maxCoeff(),
                      1e-12);
    ASSERT_GT(walled.walls.rows(), 0);
    for (Index w = 0; w < walled.walls.rows(); ++w) {
        std::array<int, 2> inside{};  // corners of the wall in each of the two planes
        for (const int axis : {0, 1})
            for (int k = 0; k < 3; ++k)
                inside[axis] += std::abs(walled.mesh.vertices(walled.walls(w, k), axis) - 1) < 1e-14;
        EXPECT_TRUE(inside[0] == 3 || inside[1] == 3);
    }
    const BlockComplex blocks = block_complex(walled);
    ASSERT_EQ(blocks.block_count(), 3);
    EXPECT_LT(((blocks.high - blocks.low).rowwise().prod().array() - 2).abs().maxCoeff(), 1e-9);
    EXPECT_TRUE(walled.mesh.vertices == motorcycle_complex(map).mesh.vertices);
}

TEST(MotorcycleComplex, ParametersOfATetMayBeTurnedAndMoved) {
    const SeamlessMap plain = moved_l_shape(2);
    SeamlessMap map = plain;
    const Eigen::AngleAxisd turn(std::numbers::pi / 2, Eigen::Vector3d(1, 0, 0));
    const Eigen::AngleAxisd other(2 * std::numbers::pi / 3, Eigen::Vector3d(1, 1, 1).normalized());
    for (Index t = 0; t < map.mesh.tets.rows(); ++t)
        for (int k = 0; k < 4 && t % 3 != 0; ++k) {
            const Eigen::Vector3d at = map.parameters.block<1, 3>(t, 3 * k).transpose();
            map.parameters.block<1, 3>(t, 3 * k) =
                ((t % 3 == 1 ? turn : other) * at + Eigen::Vector3d(3, -2, 0.25 * (t % 5))).transpose();
        }
    const SeamlessMap walled = motorcycle_complex(map);
    EXPECT_EQ(block_complex(walled).block_count(), 3);
    EXPECT_EQ(walled.walls.rows(), motorcycle_complex(plain).walls.rows());
}

TEST(MotorcycleComplex, BlocksMeetAtASingularEdge) {
    for (const int n : {3, 5, 6})
        for (const bool moved : {false, true}) {
            const SeamlessMap map = fan(n, 3, moved);
            const SeamlessReport report = seamless_report(map);
            ASSERT_TRUE(report.flipped.empty() && report.torn.empty());
            const SeamlessMap walled = motorcycle_complex(map);
            EXPECT_NEAR(volume_of(walled.mesh), volume_of(map.mesh), 1e-12);
            const BlockComplex blocks = block_complex(walled);
            // Of n quarters at least every second has a wall.
            EXPECT_LT(blocks.block_count(), n);
            EXPECT_GE(2 * blocks.block_count(), n);
            EXPECT_NEAR((blocks.high - blocks.low).rowwise().prod().sum(), n, 1e-9);
            AllHexOptions options;
            options.cells = 27 * n;
            EXPECT_EQ(all_hex(walled, options).mesh.hexahedra.rows(), 27 * n);
        }
}

TEST(MotorcycleComplex, AnEdgeWithFourQuartersGetsNone) {
    EXPECT_EQ(motorcycle_complex(fan(4, 2, false)).walls.rows(), 0);
}

TEST(MotorcycleComplex, AFeatureInAFlatPartGetsAWall) {
    SeamlessMap map = identity_map(kuhn_grid(4, 2, 2, 1));
    std::vector<Index> line;
    for (Index v = 0; v < map.mesh.vertices.rows(); ++v)
        if (map.mesh.vertices(v, 0) == 1 && map.mesh.vertices(v, 2) == 2) line.push_back(v);
    ASSERT_EQ(line.size(), 3U);
    std::sort(line.begin(), line.end(),
              [&](Index a, Index b) { return map.mesh.vertices(a, 1) < map.mesh.vertices(b, 1); });
    map.features.resize(2, 2);
    map.features << line[0], line[1], line[1], line[2];
    const BlockComplex blocks = block_complex(motorcycle_complex(map));
    EXPECT_EQ(blocks.block_count(), 2);
    EXPECT_EQ(std::count_if(blocks.arcs.begin(), blocks.arcs.end(), [](const BlockArc& arc) { return arc.feature; }),
              1);
}

TEST(MotorcycleComplex, ARingIsCutOnce) {
    for (const bool turned : {false, true}) {
        const SeamlessMap map = ring(12, turned);
        EXPECT_EQ(kind_of([&] { block_complex(map); }), "not_a_box");
        const SeamlessMap walled = motorcycle_complex(map);
        const BlockComplex blocks = block_complex(walled);
        ASSERT_EQ(blocks.block_count(), 1);
        EXPECT_NEAR((blocks.high - blocks.low).prod(), 48, 1e-9);
        AllHexOptions options;
        options.cells = 200;
        EXPECT_NEAR(all_hex(walled, options).mesh.hexahedra.rows(), 200, 20);
    }
}

TEST(MotorcycleComplex, AShellWhoseLinesWindIsCutAlongTwoAxes) {
    const int n = 8;
    const auto same = [=](Eigen::Vector3d at) {
        if (at[1] == n) at += Eigen::Vector3d(1, -n, 0);
        if (at[0] >= n) at[0] -= n;
        return at;
    };
    const SeamlessMap map = closed_grid({n, n, 1}, same, [=](const Eigen::Vector3d& at) {
        const double unit = 2 * std::numbers::pi / n, r = 2 + 0.5 * at[2];
        const double a = unit * (at[0] + at[1] / n), b = -unit * at[1], radius = 5 + r * std::cos(a);
        return Eigen::Vector3d(radius * std::cos(b), radius * std::sin(b), r * std::sin(a));
    });
    const BlockComplex blocks = block_complex(motorcycle_complex(map));
    EXPECT_NEAR((blocks.high - blocks.low).rowwise().prod().sum(), n * n, 1e-9);
    EXPECT_LE(blocks.block_count(), 2);
}

TEST(MotorcycleComplex, WhatIsNoSeamlessMapIsNamed) {
    SeamlessMap flipped = moved_l_shape(1), torn = flipped, bent = flipped, lost = flipped;
    flipped.parameters.block<1, 3>(4, 0).swap(flipped.parameters.block<1, 3>(4, 3));
    EXPECT_EQ(kind_of([&] { motorcycle_complex(flipped); }), "flipped_tet");
    torn.parameters.row(5) *= 1.01;
    EXPECT_EQ(kind_of([&] { motorcycle_complex(torn); }), "torn_map");
    const Eigen::AngleAxisd turn(0.2, Eigen::Vector3d::UnitZ());
    for (Index t = 0; t < bent.parameters.rows(); ++t)
        for (int k = 0; k < 4; ++k)
            bent.parameters.block<1, 3>(t, 3 * k) =
                (turn * Eigen::Vector3d(bent.parameters.block<1, 3>(t, 3 * k).transpose())).transpose();
    EXPECT_EQ(kind_of([&] { motorcycle_complex(bent); }), "unaligned_boundary");
    lost.parameters(2, 2) = std::nan("");
    EXPECT_EQ(kind_of([&] { motorcycle_complex(lost); }), "non_finite_parameter");
    lost.parameters.conservativeResize(3, 12);
    EXPECT_EQ(kind_of([&] { motorcycle_complex(lost); }), "wrong_size");
    EXPECT_EQ(kind_of([&] { motorcycle_complex(SeamlessMap{}); }), "empty");
}

TEST(MotorcycleComplex, ItCanBeCancelled) {
    EXPECT_THROW(motorcycle_complex(moved_l_shape(2), [](std::string_view, double, double) { return false; }),
                 Cancelled);
}

}  // namespace
}  // namespace octafield::volume
