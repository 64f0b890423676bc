// conform: pyramids where quads meet triangles.
#include <gtest/gtest.h>

#include "kind_thrown.hpp"
#include "mixed_grids.hpp"
#include "octafield/error.hpp"
#include "octafield/volume/recombination.hpp"
#include "octafield/volume/tetrahedralize.hpp"

namespace octafield::volume {
namespace {

using testing::CubeGrid;
using testing::expect_sound;
using testing::Filled;
using testing::kind_thrown;
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
    std::set<Index> added;
    testing::each_cell(after, [&](const std::vector<Index>& cell) {
        for (const Index v : cell)
            if (v >= before.vertices.rows()) added.insert(v);
    });
    EXPECT_EQ(static_cast<Eigen::Index>(added.size()), after.vertices.rows() - before.vertices.rows());
}

void orient(MixedMesh& mesh, Eigen::Index tet) {
    const auto p = [&](int k) -> Vector {
        return mesh.vertices.row(mesh.tets(tet, k)) - mesh.vertices.row(mesh.tets(tet, 0));
    };
    if (p(1).cross(p(2)).dot(p(3)) < 0) std::swap(mesh.tets(tet, 2), mesh.tets(tet, 3));
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
    // A cube and four tets over it, round the diagonal 4-7 of its upper quad.
    const auto kind = [](int, int, int) { return Filled::hexahedron; };
    MixedMesh mesh = CubeGrid({1, 1, 1}, kind, 0, 0).mesh();
    mesh.vertices.conservativeResize(11, 3);
    mesh.vertices.bottomRows(3) << 0.8, 0.2, 1.5, 0.2, 0.8, 1.5, 0.5, 0.5, 1.9;
    mesh.tets.resize(4, 4);
    mesh.tets << 4, 7, 5, 8, 4, 7, 8, 10, 4, 7, 10, 9, 4, 7, 9, 6;
    for (Eigen::Index t = 0; t < 4; ++t) orient(mesh, t);
    ConformReport report;
    const MixedMesh result = conform(mesh, &report);
    expect_sound(result, 0.05);
    expect_same_region(mesh, result);
    EXPECT_EQ(report.raised, 1);
    EXPECT_EQ(report.combined + report.split, 0);
    EXPECT_EQ(result.hexahedra, mesh.hexahedra);
    EXPECT_EQ(result.pyramids.rows(), 1);
    EXPECT_EQ(result.tets.rows(), 8);
    EXPECT_NEAR(cell_volumes(result).sum(), cell_volumes(mesh).sum(), 1e-12);
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
    }
}

// Hexahedra of a staircase, TetGen's tets between them and a cube round them.
MixedMesh staircase_in_a_box(int n, double jitter, unsigned seed) {
    const auto kind = [&](int i, int j, int k) {
        const bool inside = std::min({i, j, k}) > 0 && std::max({i, j, k}) < n - 1;
        return inside && i + j + k <= (3 * n) / 2 ? Filled::hexahedron : Filled::empty;
    };
    MixedMesh mesh = CubeGrid({n, n, n}, kind, jitter, seed).mesh();
    const CellBoundary stairs = cell_boundary(mesh);
    const auto full = [](int, int, int) { return Filled::hexahedron; };
    const MixedMesh box = CubeGrid({n, n, n}, full, 0, 0).mesh();
    const CellBoundary walls = cell_boundary(box);
    std::mt19937 random(seed);
    std::vector<Eigen::RowVector3i> triangles;
    const auto add = [&](const CellBoundary& from, Index offset, bool turned) {
        for (Eigen::Index q = 0; q < from.mesh.quads.rows(); ++q) {
            std::array<Index, 4> r;
            const int start = static_cast<int>(random() % 2);
            for (int k = 0; k < 4; ++k) r[k] = offset + from.mesh.quads(q, (start + k) % 4);
            if (turned) std::swap(r[1], r[3]);
            triangles.emplace_back(r[0], r[1], r[2]);
            triangles.emplace_back(r[0], r[2], r[3]);
        }
    };
    const Index inner = static_cast<Index>(stairs.vertex_map.size());
    add(stairs, 0, true);
    add(walls, inner, false);
    surface::TriangleMesh surface;
    surface.vertices.resize(inner + walls.mesh.vertices.rows(), 3);
    surface.vertices << stairs.mesh.vertices, walls.mesh.vertices;
    surface.triangles.resize(triangles.size(), 3);
    for (std::size_t t = 0; t < triangles.size(); ++t) surface.triangles.row(t) = triangles[t];
    const TetMesh tets = tetrahedralize(surface);
    const Index offset = static_cast<Index>(mesh.vertices.rows());
    Points vertices(offset + tets.vertices.rows() - inner, 3);
    vertices << mesh.vertices, tets.vertices.bottomRows(tets.vertices.rows() - inner);
    mesh.vertices = vertices;
    mesh.tets = tets.tets.unaryExpr([&](Index v) { return v < inner ? stairs.vertex_map[v] : offset + v - inner; });
    return mesh;
}

TEST(Conform, RegionsFilledByTetGenBecomeSound) {
    for (unsigned seed = 0; seed < 6; ++seed) {
        const MixedMesh mesh = staircase_in_a_box(7, 0.05 * seed, seed);
        ConformReport report;
        const MixedMesh result = conform(mesh, &report);
        expect_sound(result, 1e-3);
        expect_same_region(mesh, result);
        EXPECT_NEAR(cell_volumes(result).sum(), 343, 1e-9);
    }
}

TEST(Conform, RegionsFilledByTetGenGetMoreHexahedraByRecombination) {
    const MixedMesh mesh = staircase_in_a_box(7, 0.1, 1);
    RecombineOptions options;
    options.max_boundary_fold = 1e-6;
    const MixedMesh result = conform(recombine(mesh, options));
    expect_sound(result, 1e-4);
    EXPECT_EQ(result.vertices.topRows(mesh.vertices.rows()), mesh.vertices);
    EXPECT_EQ(result.hexahedra.topRows(mesh.hexahedra.rows()), mesh.hexahedra);
    EXPECT_GT(result.hexahedra.rows(), 2 * mesh.hexahedra.rows());
    EXPECT_NEAR(cell_volumes(result).sum(), 343, 1e-9);
}

TEST(Conform, AHexahedronOnTrianglesOfWedgesIsGivenUp) {
    const auto kind = [](int, int, int k) { return k == 1 ? Filled::wedges : Filled::hexahedron; };
    const MixedMesh mesh = CubeGrid({3, 3, 4}, kind, 0.15, 3).mesh();
    ConformReport report;
    const MixedMesh result = conform(mesh, &report);
    expect_sound(result, 0.05);
    expect_same_region(mesh, result);
    EXPECT_EQ(report.split, 18);
    EXPECT_EQ(result.hexahedra.rows(), 9);
    EXPECT_EQ(result.wedges, mesh.wedges);
    EXPECT_NEAR(cell_volumes(result).sum(), 36, 1e-11);
}

TEST(Conform, APyramidOnTwoTrianglesBecomesTwoTets) {
    MixedMesh mesh;
    mesh.vertices.resize(7, 3);
    mesh.vertices << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.5, 0.5, -1, 0.9, 0.2, 1, 0.2, 0.9, 1;
    mesh.pyramids.resize(1, 5);
    mesh.pyramids << 0, 3, 2, 1, 4;
    mesh.tets.resize(3, 4);
    mesh.tets << 0, 2, 1, 5, 0, 2, 3, 6, 0, 2, 5, 6;
    for (Eigen::Index t = 0; t < 3; ++t) orient(mesh, t);
    const MixedMesh result = conform(mesh);
    expect_sound(result, 0.05);
    expect_same_region(mesh, result);
    EXPECT_EQ(result.tets.rows(), 5);
    EXPECT_EQ(result.pyramids.rows(), 0);
    EXPECT_NEAR(cell_volumes(result).sum(), cell_volumes(mesh).sum(), 1e-12);
}

// Two cubes one above the other, and between them a flat tet, so that their quads' diagonals cross.
MixedMesh cubes_and_a_sliver(bool upper) {
    const auto kind = [](int, int, int) { return Filled::hexahedron; };
    MixedMesh mesh = CubeGrid({1, 1, upper ? 2 : 1}, kind, 0, 0).mesh();
    mesh.vertices(4, 2) += 0.01;  // the lower cube's quad sees a ridge along 5-6, the upper's a valley
    mesh.vertices(7, 2) += 0.01;
    mesh.tets.resize(1, 4);
    mesh.tets << 4, 5, 6, 7;
    orient(mesh, 0);
    return mesh;
}

TEST(Conform, AFlatTetBetweenTwoQuadsGoes) {
    const MixedMesh result = conform(cubes_and_a_sliver(true));
    expect_sound(result);
    EXPECT_EQ(result.hexahedra.rows(), 2);
    EXPECT_EQ(result.cell_count(), 2);
    EXPECT_NEAR(cell_volumes(result).sum(), 2, 1e-12);
}

TEST(Conform, TetsBetweenTwoQuadsOfTheSameVerticesAreNamed) {
    MixedMesh mesh = cubes_and_a_sliver(true);
    mesh.vertices.conservativeResize(13, 3);
    mesh.vertices.row(12) = mesh.vertices.middleRows(4, 4).colwise().mean();
    mesh.tets.resize(4, 4);
    mesh.tets << 4, 5, 6, 12, 4, 5, 7, 12, 4, 6, 7, 12, 5, 6, 7, 12;
    for (Eigen::Index t = 0; t < 4; ++t) orient(mesh, t);
    EXPECT_EQ(kind_thrown<GeometryError>([&] { conform(mesh); }), "mismatched_face");
}

TEST(Conform, AFlatTetOnTheBoundaryGoes) {
    const MixedMesh result = conform(cubes_and_a_sliver(false));
    expect_sound(result);
    EXPECT_EQ(result.cell_count(), 1);
}

TEST(Conform, AFatTetOnTheBoundaryStaysAndItsHexahedronIsGivenUp) {
    MixedMesh mesh = cubes_and_a_sliver(false);
    mesh.vertices(4, 2) += 0.5;
    mesh.vertices(7, 2) += 0.5;
    ConformReport report;
    const MixedMesh result = conform(mesh, &report);
    expect_sound(result, 1e-3);
    EXPECT_EQ(report.split, 1);
    std::set<std::vector<Index>> wanted = outside(mesh);
    for (const auto& gone : std::vector<std::vector<Index>>{{4, 5, 6, 7}, {4, 5, 6}, {5, 6, 7}}) wanted.erase(gone);
    EXPECT_EQ(wanted, outside(result));
}

TEST(Conform, AFlatTetHalfOnTheBoundaryStaysAndItsHexahedronIsGivenUp) {
    MixedMesh mesh = cubes_and_a_sliver(false);
    mesh.vertices.conservativeResize(9, 3);
    mesh.vertices.row(8) << 0.8, 0.2, 1.5;
    mesh.tets.conservativeResize(2, 4);
    mesh.tets.row(1) << 4, 5, 7, 8;
    orient(mesh, 1);
    ConformReport report;
    const MixedMesh result = conform(mesh, &report);
    expect_sound(result, 1e-3);
    EXPECT_EQ(report.split, 1);
    EXPECT_TRUE(outside(result).count({4, 6, 7}));
    EXPECT_FALSE(outside(result).count({4, 5, 7}));
}

TEST(Conform, SoundMeshesStayBitForBit) {
    const auto kind = [](int i, int j, int) { return i == j ? Filled::hexahedron : Filled::empty; };
    const MixedMesh mesh = CubeGrid({3, 3, 3}, kind, 0.1, 5).mesh();
    const MixedMesh result = conform(mesh);
    EXPECT_EQ(result.vertices, mesh.vertices);
    EXPECT_EQ(result.hexahedra, mesh.hexahedra);
    EXPECT_EQ(result.cell_count(), mesh.cell_count());
}

TEST(Conform, DefectsAreNamed) {
    const auto kind = [](int i, int, int) { return i == 1 ? Filled::about_centre : Filled::hexahedron; };
    const MixedMesh mesh = CubeGrid({3, 1, 1}, kind, 0, 1).mesh();
    MixedMesh half = mesh;  // without the last tet, which lies on the second hexahedron
    std::vector<Eigen::Index> rows;
    const auto faces = testing::faces_of(mesh);
    for (Eigen::Index t = 0; t < mesh.tets.rows(); ++t) {
        int on_right = 0;
        for (int k = 0; k < 4; ++k) on_right += mesh.vertices(mesh.tets(t, k), 0) == 2;
        if (on_right < 3 || rows.size() != static_cast<std::size_t>(t)) rows.push_back(t);
    }
    half.tets = mesh.tets(rows, Eigen::all);
    ASSERT_LT(half.tets.rows(), mesh.tets.rows());
    EXPECT_EQ(kind_thrown<GeometryError>([&] { conform(half); }), "mismatched_face");
    MixedMesh bad = mesh;
    bad.tets(0, 0) = 1000;
    EXPECT_EQ(kind_thrown<GeometryError>([&] { conform(bad); }), "index_out_of_range");
    bad = mesh;
    bad.vertices(3, 1) = std::nan("");
    EXPECT_EQ(kind_thrown<GeometryError>([&] { conform(bad); }), "non_finite_vertex");
    bad = mesh;
    std::swap(bad.tets(0, 0), bad.tets(0, 1));
    EXPECT_EQ(kind_thrown<GeometryError>([&] { conform(bad); }), "inverted_cell");
    EXPECT_EQ(kind_thrown<GeometryError>([&] { conform(MixedMesh{}); }), "empty");
}

}  // namespace
}  // namespace octafield::volume
