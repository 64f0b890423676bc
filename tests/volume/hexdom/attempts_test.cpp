// What is tried again on the way from hexahedra to a mesh.
#include "attempts.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "kind_thrown.hpp"
#include "mixed_grids.hpp"
#include "not_joined.hpp"
#include "octafield/error.hpp"
#include "octafield/volume/cell_quality.hpp"
#include "tet_fixtures.hpp"

namespace octafield::volume {
namespace {

using testing::expect_sound;
using testing::kind_thrown;
using testing::kuhn_grid;

LatticeCells no_cells() {
    LatticeCells cells;
    cells.points.resize(0, 3);
    cells.weights.resize(0, 4);
    cells.hexahedra.resize(0, 8);
    return cells;
}

// A cube of n^3 with a block of hexahedra of edge 1 in it, none on the surface.
CellsOnSurface block_in_cube(int n, int low, int high) {
    const TetDomain domain(kuhn_grid(n, n, n, 1));
    CellsOnSurface cells = cells_on_surface(domain, no_cells(), 1);
    const Index first = static_cast<Index>(cells.vertices.rows());
    const int count = high - low + 1;
    const auto vertex = [&](int i, int j, int k) { return first + ((k - low) * count + j - low) * count + i - low; };
    cells.vertices.conservativeResize(first + count * count * count, 3);
    for (int k = low; k <= high; ++k)
        for (int j = low; j <= high; ++j)
            for (int i = low; i <= high; ++i) cells.vertices.row(vertex(i, j, k)) << i, j, k;
    std::vector<std::array<Index, 8>> all;
    for (int k = low; k < high; ++k)
        for (int j = low; j < high; ++j)
            for (int i = low; i < high; ++i)
                all.push_back({vertex(i, j, k), vertex(i + 1, j, k), vertex(i + 1, j + 1, k), vertex(i, j + 1, k),
                               vertex(i, j, k + 1), vertex(i + 1, j, k + 1), vertex(i + 1, j + 1, k + 1),
                               vertex(i, j + 1, k + 1)});
    cells.hexahedra.resize(static_cast<Eigen::Index>(all.size()), 8);
    for (std::size_t c = 0; c < all.size(); ++c)
        for (int k = 0; k < 8; ++k) cells.hexahedra(static_cast<Eigen::Index>(c), k) = all[c][k];
    return cells;
}

void expect_fills(const MixedMesh& mesh, const CellsOnSurface& cells) {
    double six = 0;
    for (const auto t : cells.surface.mesh.triangles.rowwise()) {
        const auto p = [&](int k) -> Eigen::Vector3d { return cells.vertices.row(t[k]); };
        six += p(0).dot(p(1).cross(p(2)));
    }
    EXPECT_NEAR(cell_volumes(mesh).sum(), six / 6, 1e-9);
}

TEST(Attempts, HexahedraBesideTheCavityAreLeftOutWhereNoTetsCanBeHad) {
    CellsOnSurface cells = block_in_cube(6, 1, 5);
    // One at the block's corner inside out: no side of its faces is the cavity's.
    for (int k = 0; k < 4; ++k) std::swap(cells.hexahedra(0, k), cells.hexahedra(0, k + 4));
    CellsOnSurface same = cells;
    EXPECT_EQ(kind_thrown([&] { filled(same, {}); }), "tetgen_failed");
    const MixedMesh mesh = filled_by_layers(cells, {});
    EXPECT_EQ(mesh.hexahedra.rows(), 8);  // of 64, without those outside
    EXPECT_EQ(cells.crossing, 56);
    expect_fills(mesh, cells);
    expect_sound(conform(mesh));
}

// A corner of the block next to nothing above the cube's side: tets between have no volume.
TEST(Attempts, WhereTetsWithoutVolumeAreLeftOnlyHexahedraThereAreLeftOut) {
    CellsOnSurface cells = block_in_cube(5, 1, 4);
    const Index corner = cells.hexahedra(0, 0);
    ASSERT_EQ(cells.vertices.row(corner), Eigen::RowVector3d(1, 1, 1));
    cells.vertices.row(corner) << 0.8, 0.7, 1e-13;
    CellsOnSurface same = cells;
    EXPECT_EQ(kind_thrown([&] { filled(same, {}); }), "tetgen_failed");
    const MixedMesh mesh = filled_by_layers(cells, {});
    EXPECT_EQ(mesh.hexahedra.rows(), 26);
    expect_fills(mesh, cells);
    expect_sound(conform(mesh));
}

TEST(Attempts, WithoutAnyHexahedronAtLastAndThenAnError) {
    CellsOnSurface cells = block_in_cube(4, 1, 3);
    cells.surface.mesh.triangles.conservativeResize(cells.surface.mesh.triangles.rows() - 1, 3);
    EXPECT_EQ(kind_thrown([&] { filled_by_layers(cells, {}); }), "tetgen_failed");
    EXPECT_EQ(cells.hexahedra.rows(), 0);
}

// A wall round a quarter of a cylinder, thinner than what its chords cut off.
TetMesh bent_wall() {
    TetMesh mesh = kuhn_grid(24, 24, 1, 1);
    for (auto p : mesh.vertices.rowwise()) {
        const double turn = p[0] / 24 * 2.5, radius = 1 + 0.04 * p[2];
        p = Eigen::RowVector3d(-radius * std::cos(turn), p[1] / 12, radius * std::sin(turn)).eval();
    }
    return mesh;
}

TEST(Attempts, WallsThinnerThanTheChordsKeepVerticesUntilTheyDoNotCross) {
    const TetDomain domain(bent_wall());
    CellsOnSurface coarse = cells_on_surface(domain, no_cells(), 0.8);
    EXPECT_EQ(kind_thrown([&] { filled(coarse, {}); }), "self_intersection");
    const FilledCells fine = filled_cells(domain, no_cells(), 0.8, {});
    expect_sound(fine.mesh);
    EXPECT_NEAR(cell_volumes(fine.mesh).sum() / tet_volumes(domain.mesh()).sum(), 1, 0.05);
}

TEST(Attempts, WhereAllOldVerticesStayTheSurfaceIsTheOldOne) {
    const TetDomain domain(bent_wall());
    const surface::TriangleMesh& old = domain.surface().mesh;
    const CellsOnSurface cells =
        cells_on_surface(domain, no_cells(), 0.8, std::vector<std::uint8_t>(old.vertices.rows(), 1));
    EXPECT_EQ(cells.surface.mesh.triangles.rows(), old.triangles.rows());
    EXPECT_EQ(kind_thrown([&] { cells_on_surface(domain, no_cells(), 0.8, std::vector<std::uint8_t>(3, 1)); }),
              "wrong_size");
}

// Two hexahedra on the corners of a unit cube, each with points of its own there.
LatticeCells twins(const TetDomain& domain) {
    LatticeCells cells;
    cells.points.resize(16, 3);
    cells.weights.setZero(16, 4);
    cells.hexahedra.resize(2, 8);
    cells.on_surface = {63, 63};
    constexpr int corner[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                  {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
    for (int p = 0; p < 16; ++p) {
        cells.points.row(p) << corner[p % 8][0], corner[p % 8][1], corner[p % 8][2];
        cells.hexahedra(p / 8, p % 8) = p;
        bool found = false;
        for (Index t = 0; t < domain.mesh().tets.rows() && !found; ++t)
            for (int k = 0; k < 4 && !found; ++k)
                if (domain.mesh().vertices.row(domain.mesh().tets(t, k)) == cells.points.row(p)) {
                    cells.tet.push_back(t);
                    cells.weights(p, k) = 1;
                    found = true;
                }
    }
    return cells;
}

TEST(Attempts, HexahedraWithPointsAtOnePlaceOfTheSurfaceAreLeftOut) {
    const TetDomain domain(kuhn_grid(1, 1, 1, 1));
    const CellsOnSurface cells = cells_on_surface(domain, twins(domain), 1);
    EXPECT_EQ(cells.hexahedra.rows(), 0);
    EXPECT_EQ(cells.surface.mesh.vertices.rows(), 8);
    const FilledCells all = filled_cells(domain, twins(domain), 1, {});
    expect_sound(all.mesh);
    EXPECT_NEAR(cell_volumes(all.mesh).sum(), 1, 1e-9);
}

TEST(Attempts, AHexahedronThatCannotBeMetIsLeftOutAndThePlaceFilledAnew) {
    FilledCells given{block_in_cube(5, 1, 4), {}};
    given.mesh = filled(given.cells, {});
    ASSERT_EQ(given.mesh.hexahedra.rows(), 27);
    // Without a tet at one of its quads, the other half is no filling.
    const auto corner = given.mesh.hexahedra.row(0);
    std::vector<Index> kept;
    bool lost = false;
    for (Index t = 0; t < given.mesh.tets.rows(); ++t) {
        int shared = 0;
        for (const Index v : given.mesh.tets.row(t)) shared += (corner.array() == v).any();
        if (shared == 3 && !lost)
            lost = true;
        else
            kept.push_back(t);
    }
    given.mesh.tets = given.mesh.tets(kept, Eigen::all).eval();
    HexDominantOptions options;
    options.recombine = false;
    HexDominantCounts counts;
    ASSERT_NE(kind_thrown([&] { conform(given.mesh); }), "nothing");
    const MixedMesh mesh = conforming(given, options, counts, {});
    EXPECT_EQ(given.cells.hexahedra.rows(), 26);
    EXPECT_EQ(given.cells.crossing, 1);
    expect_fills(mesh, given.cells);
    expect_sound(mesh);
}

TEST(Attempts, ATriangleBetweenRegionsThatIsNoFaceIsAnErrorOnceNoHexahedronIsLeft) {
    FilledCells given{block_in_cube(4, 1, 3), {}};
    given.mesh = filled(given.cells, {});
    HexDominantOptions options;
    options.recombine = false;
    HexDominantCounts counts;
    EXPECT_EQ(kind_thrown([&] {
                  FilledCells same = given;
                  conforming(same, options, counts, {});
              }),
              "nothing");
    given.cells.hexahedra.resize(0, 8);
    given.mesh = filled(given.cells, {});
    surface::TriangleMesh& mesh = given.cells.surface.mesh;
    const Index last = static_cast<Index>(mesh.vertices.rows()) - 1;
    mesh.triangles.conservativeResize(mesh.triangles.rows() + 1, 3);
    mesh.triangles.bottomRows(1) << 0, last / 2, last;
    given.cells.two_sided.push_back(1);
    given.cells.surface.triangle.push_back(0);
    EXPECT_EQ(kind_thrown([&] { conforming(given, options, counts, {}); }), "lost_interface");
}

TEST(Attempts, HexahedraThatAreNotProvenPositiveAreFilledAboutAPoint) {
    std::mt19937 random(4);
    std::uniform_real_distribution<double> uniform(-0.55, 0.55);
    int seen = 0;
    for (int trial = 0; trial < 20000 && seen < 5; ++trial) {
        MixedMesh mesh = testing::CubeGrid(
                             {1, 1, 1}, [](int, int, int) { return testing::Filled::hexahedron; }, 0, 0)
                             .mesh();
        for (double& x : mesh.vertices.reshaped()) x += uniform(random);
        if (scaled_jacobians(mesh).minCoeff() < 0.01 || proven_positive(mesh)[0]) continue;
        const double volume = cell_volumes(mesh).sum();
        MixedMesh result;
        if (kind_thrown([&] { result = without_unproven(mesh, 1); }) != "nothing") continue;
        ++seen;
        EXPECT_EQ(result.hexahedra.rows(), 0);
        EXPECT_EQ(result.pyramids.rows(), 6);
        EXPECT_NEAR(cell_volumes(result).sum(), volume, 1e-12);
        for (const std::uint8_t proven : proven_positive(result)) EXPECT_TRUE(proven);
        expect_sound(result);
    }
    EXPECT_EQ(seen, 5);
}

TEST(Attempts, WhatIsNotPositiveAndCannotBeFilledIsAnErrorWithItsCell) {
    MixedMesh mesh = testing::CubeGrid(
                         {1, 1, 1}, [](int, int, int) { return testing::Filled::hexahedron; }, 0, 0)
                         .mesh();
    mesh.vertices.row(7) << 2, -1, -1;
    EXPECT_EQ(kind_thrown([&] { without_unproven(mesh, 1); }), "unproven_cell");
}

TEST(Attempts, MovedVerticesDoNotTakeVolumeAwayWhereNoFeaturesHoldThem) {
    const TetDomain domain(
        {Eigen::Matrix<double, 4, 3, Eigen::RowMajor>(kuhn_grid(1, 1, 1, 1).vertices({0, 1, 3, 7}, Eigen::all)),
         Eigen::RowVector4i(0, 1, 2, 3)});  // its edges are no features
    const CellsOnSurface cells = cells_on_surface(domain, no_cells(), 1);
    CellsOnSurface same = cells;
    const MixedMesh mesh = filled(same, {});
    const double before = cell_volumes(mesh).sum();
    std::vector<std::uint8_t> support(mesh.vertices.rows(), 0);
    for (const Index v : cells.surface.mesh.triangles.reshaped()) support[v] = 1;
    const MixedMesh moved = improved(mesh, domain, support, {}, 1, 1);
    EXPECT_NEAR(cell_volumes(moved).sum() / before, 1, 0.0051);
    expect_sound(moved);
}

TEST(Attempts, TetsOfACellThatLedToNoMeshAreNotJoinedAgainAndThenAllRound) {
    MixedMesh mesh;
    mesh.vertices.setZero(9, 3);
    NotJoined not_joined(mesh);
    using Tet = Eigen::Matrix<Index, 1, 4>;
    const Tet inside(0, 1, 2, 3), beside(1, 2, 3, 8), apart(4, 5, 6, 8);
    EXPECT_FALSE(not_joined.has(inside));
    not_joined.add({0, 1, 2, 3, 3, 12}, false);
    EXPECT_TRUE(not_joined.has(inside));
    EXPECT_FALSE(not_joined.has(beside));
    not_joined.add({3}, false);
    EXPECT_TRUE(not_joined.has(beside));
    EXPECT_FALSE(not_joined.has(apart));
    not_joined.add({5}, true);
    EXPECT_TRUE(not_joined.has(apart));
}

}  // namespace
}  // namespace octafield::volume
