// conform: pyramids where quads meet triangles.
#include <gtest/gtest.h>

#include "mixed_grids.hpp"
#include "octafield/error.hpp"
#include "octafield/volume/recombination.hpp"
#include "octafield/volume/tetrahedralize.hpp"

namespace octafield::volume {
namespace {

using testing::CubeGrid;
using testing::expect_sound;
using testing::Filled;
using testing::outside;
using Vector = Eigen::Vector3d;

// Faces of one cell that no other cell's quad or pair of triangles lies against.
std::set<std::vector<Index>> true_outside(const MixedMesh& mesh) {
    const std::set<std::vector<Index>> loose = outside(mesh);
    std::set<std::vector<Index>> result = loose;
    for (const auto& quad : loose) {
        if (quad.size() != 4) continue;
        for (int without = 0; without < 4; ++without) {
            std::vector<Index> triangle = quad;
            triangle.erase(triangle.begin() + without);
            if (loose.count(triangle)) result.erase(triangle), result.erase(quad);
        }
    }
    return result;
}

void expect_same_region(const MixedMesh& before, const MixedMesh& after) {
    EXPECT_EQ(true_outside(before), outside(after));
    EXPECT_EQ(before.vertices, after.vertices.topRows(before.vertices.rows()));
}

TEST(Conform, TwoTetsWithOneApexBecomeAPyramidAndNothingElseChanges) {
    const auto kind = [](int i, int, int) { return i == 1 ? Filled::about_centre : Filled::hexahedron; };
    const MixedMesh mesh = CubeGrid({3, 1, 1}, kind, 0, 1).mesh();
    ConformReport report;
    const MixedMesh result = conform(mesh, &report);
    expect_sound(result);
    expect_same_region(mesh, result);
    EXPECT_EQ(report.combined, 2);
    EXPECT_EQ(report.raised + report.split, 0);
    EXPECT_EQ(result.vertices.rows(), mesh.vertices.rows());
    EXPECT_EQ(result.tets.rows(), 8);
    EXPECT_EQ(result.pyramids.rows(), 2);
    EXPECT_EQ(result.hexahedra, mesh.hexahedra);
    EXPECT_NEAR(cell_volumes(result).sum(), 3, 1e-12);
}

TEST(Conform, AnApexIsRaisedWhereTheTetsOfAQuadHaveTwo) {
    const auto kind = [](int, int, int k) { return k == 0 ? Filled::hexahedron : Filled::kuhn; };
    const MixedMesh mesh = CubeGrid({3, 3, 3}, kind, 0.1, 2).mesh();
    ConformReport report;
    const MixedMesh result = conform(mesh, &report);
    expect_sound(result, 0.05);
    expect_same_region(mesh, result);
    EXPECT_EQ(report.raised, 9);
    EXPECT_EQ(report.split, 0);
    EXPECT_EQ(result.hexahedra, mesh.hexahedra);
    EXPECT_NEAR(cell_volumes(result).sum(), 27, 1e-11);
}

TEST(Conform, RandomMixturesBecomeSound) {
    for (unsigned seed = 0; seed < 12; ++seed) {
        std::mt19937 random(seed);
        std::vector<int> kinds(6 * 5 * 4);
        for (int& kind : kinds) kind = static_cast<int>(random() % 6);
        const auto kind = [&](int i, int j, int k) {
            const int drawn = kinds[(k * 5 + j) * 6 + i];
            return drawn < 3 ? Filled::hexahedron : drawn == 3 ? Filled::kuhn : Filled::about_centre;
        };
        const MixedMesh mesh = CubeGrid({6, 5, 4}, kind, 0.2, seed).mesh();
        ConformReport report;
        const MixedMesh result = conform(mesh, &report);
        expect_sound(result, 1e-3);
        expect_same_region(mesh, result);
        EXPECT_NEAR(cell_volumes(result).sum(), 120, 1e-10);
        printf("seed %u: %d hexahedra, combined %d raised %d split %d least %g\n", seed, int(mesh.hexahedra.rows()), report.combined,
               report.raised, report.split, scaled_jacobians(result).minCoeff());
    }
}

}  // namespace
}  // namespace octafield::volume
