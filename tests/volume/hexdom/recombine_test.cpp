// recombine: hexahedra and wedges of tets.
#include "octafield/volume/recombination.hpp"

#include <gtest/gtest.h>

#include "delaunay_mesh.hpp"
#include "mixed_grids.hpp"
#include "octafield/error.hpp"

namespace octafield::volume {
namespace {

using testing::CubeGrid;
using testing::expect_sound;
using testing::Filled;
using Vector = Eigen::Vector3d;

MixedMesh kuhn(int n, double jitter, unsigned seed) {
    return CubeGrid(
               {n, n, n}, [](int, int, int) { return Filled::kuhn; }, jitter, seed)
        .mesh();
}

Points grid_points(int n, double jitter, unsigned seed) { return kuhn(n, jitter, seed).vertices; }

double hexahedra_volume(const MixedMesh& mesh) {
    return cell_volumes(mesh).segment(mesh.tets.rows(), mesh.hexahedra.rows()).sum();
}

// What holds whatever was joined: quality kept, nothing lost, and pyramids fit.
MixedMesh expect_good(const MixedMesh& mesh, const MixedMesh& result, const RecombineReport& report,
                      double least = 0.3) {
    EXPECT_EQ(result.vertices, mesh.vertices);
    EXPECT_EQ(result.pyramids, mesh.pyramids);
    EXPECT_EQ(result.hexahedra.topRows(mesh.hexahedra.rows()), mesh.hexahedra);
    EXPECT_EQ(result.hexahedra.rows(), mesh.hexahedra.rows() + report.hexahedra);
    EXPECT_EQ(result.wedges.rows(), mesh.wedges.rows() + report.wedges);
    const Eigen::VectorXd quality = scaled_jacobians(result);
    const Eigen::Index from = result.tets.rows();
    for (Eigen::Index cell = 0; cell < result.hexahedra.rows() + result.wedges.rows(); ++cell)
        EXPECT_GE(quality[from + cell], least - 1e-12);
    const MixedMesh sound = conform(result);
    expect_sound(sound, 1e-12);
    return sound;
}

TEST(Recombine, EveryCubeOfAGridInSixTetsComesBack) {
    for (const double jitter : {0.0, 0.1, 0.2}) {
        const MixedMesh mesh = kuhn(6, jitter, 7);
        RecombineReport report;
        const MixedMesh result = recombine(mesh, {}, &report);
        EXPECT_EQ(report.hexahedra, 216) << jitter;
        EXPECT_EQ(result.tets.rows(), 0) << jitter;
        EXPECT_NEAR(cell_volumes(expect_good(mesh, result, report)).sum(), 216, 1e-9);
    }
}

TEST(Recombine, EveryCubeOfADelaunayMeshComesBackThoughDiagonalsCross) {
    for (const double jitter : {0.02, 0.1, 0.2}) {
        const MixedMesh mesh = testing::delaunay_mesh(grid_points(7, jitter, 3));
        RecombineReport report;
        const MixedMesh result = recombine(mesh, {}, &report);
        EXPECT_EQ(report.hexahedra, 343) << jitter;
        EXPECT_GT(report.flat_tets, 100) << jitter;
        EXPECT_NEAR(cell_volumes(expect_good(mesh, result, report)).sum(), 343, 1e-9);
    }
}

TEST(Recombine, MostOfADisturbedLatticeComesBack) {
    const MixedMesh mesh = testing::delaunay_mesh(grid_points(8, 0.3, 5));
    RecombineReport report;
    const MixedMesh result = recombine(mesh, {}, &report);
    EXPECT_GT(report.hexahedra, 470);  // of 512
    const MixedMesh sound = expect_good(mesh, result, report);
    EXPECT_NEAR(cell_volumes(sound).sum(), 512, 1e-9);
    EXPECT_GT(hexahedra_volume(sound), 0.9 * 512);
}

TEST(Recombine, RandomPointsGiveSoundMeshes) {
    std::mt19937 random(4);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (int trial = 0; trial < 2; ++trial) {
        Points points(300, 3);
        for (Eigen::Index i = 0; i < points.size(); ++i) points.data()[i] = uniform(random);
        const MixedMesh mesh = testing::delaunay_mesh(points);
        RecombineReport report;
        const MixedMesh result = recombine(mesh, {.min_scaled_jacobian = 0.15}, &report);
        EXPECT_GT(report.hexahedra, 10);
        EXPECT_GT(report.wedges, 10);
        expect_good(mesh, result, report, 0.15);
    }
}

TEST(Recombine, CellsThatStayAreMetQuadOnQuad) {
    for (unsigned seed = 0; seed < 4; ++seed) {
        std::mt19937 random(seed);
        std::vector<int> kinds(5 * 5 * 5);
        for (int& kind : kinds) kind = static_cast<int>(random() % 3);
        const auto kind = [&](int i, int j, int k) {
            return kinds[(k * 5 + j) * 5 + i] == 0 ? Filled::hexahedron : Filled::kuhn;
        };
        const MixedMesh mesh = CubeGrid({5, 5, 5}, kind, 0.15, seed).mesh();
        RecombineReport report;
        const MixedMesh result = recombine(mesh, {}, &report);
        EXPECT_EQ(result.hexahedra.rows(), 125);
        EXPECT_EQ(result.tets.rows(), 0);
        EXPECT_EQ(expect_good(mesh, result, report).cell_count(), 125);
    }
}

TEST(Recombine, TetsWithVerticesWithinStayTets) {
    const auto kind = [](int i, int, int) { return i == 1 ? Filled::about_centre : Filled::kuhn; };
    const MixedMesh mesh = CubeGrid({3, 2, 2}, kind, 0, 1).mesh();
    RecombineReport report;
    const MixedMesh result = recombine(mesh, {.wedges = false}, &report);
    EXPECT_EQ(report.hexahedra, 8);
    EXPECT_EQ(result.tets.rows(), 4 * 12);
    const MixedMesh sound = expect_good(mesh, result, report);
    EXPECT_EQ(sound.hexahedra.rows(), 8);
    EXPECT_EQ(sound.pyramids.rows(), 8);
}

TEST(Recombine, HalfCubesBecomeWedges) {
    // Cubes below the plane x = y in six tets, those on it halved.
    MixedMesh mesh = kuhn(4, 0.1, 2);
    const Points straight = kuhn(4, 0, 0).vertices;
    std::vector<Eigen::Index> kept;
    for (Eigen::Index t = 0; t < mesh.tets.rows(); ++t) {
        double side = 0;
        for (int k = 0; k < 4; ++k) side += straight(mesh.tets(t, k), 0) - straight(mesh.tets(t, k), 1);
        if (side > 0) kept.push_back(t);
    }
    mesh.tets = Tets(mesh.tets(kept, Eigen::all));
    RecombineReport report;
    const MixedMesh result = recombine(mesh, {}, &report);
    EXPECT_EQ(report.hexahedra, 4 * 6);
    EXPECT_EQ(report.wedges, 4 * 4);
    EXPECT_EQ(result.tets.rows(), 0);
    expect_good(mesh, result, report);
    EXPECT_EQ(recombine(mesh, {.wedges = false}).wedges.rows(), 0);
}

// A cube in six tets whose top is folded along its diagonal 4-7.
MixedMesh folded_cube(double height) {
    MixedMesh mesh = kuhn(1, 0, 0);
    mesh.vertices(4, 2) += height;
    mesh.vertices(7, 2) += height;
    return mesh;
}

TEST(Recombine, TheBoundaryIsNotSmoothedOver) {
    EXPECT_EQ(recombine(folded_cube(0)).hexahedra.rows(), 1);
    EXPECT_EQ(recombine(folded_cube(0.1)).hexahedra.rows(), 1);  // turned by 16 degrees
    EXPECT_EQ(recombine(folded_cube(0.2)).hexahedra.rows(), 0);  // by 31
    EXPECT_EQ(recombine(folded_cube(0.2), {.max_boundary_fold = 0.7}).hexahedra.rows(), 1);
    RecombineOptions options;
    options.kept_edges.resize(1, 2);
    options.kept_edges << 7, 4;
    EXPECT_EQ(recombine(folded_cube(0), options).hexahedra.rows(), 0);
    options.kept_edges << 4, 5;
    EXPECT_EQ(recombine(folded_cube(0), options).hexahedra.rows(), 1);
}

TEST(Recombine, ThreadsChangeNothing) {
    const MixedMesh mesh = testing::delaunay_mesh(grid_points(7, 0.35, 9));
    const MixedMesh one = recombine(mesh, {.threads = 1}), four = recombine(mesh, {.threads = 4});
    EXPECT_EQ(one.hexahedra, four.hexahedra);
    EXPECT_EQ(one.wedges, four.wedges);
    EXPECT_EQ(one.tets, four.tets);
}

template <class Thrown, class Call>
std::string kind_thrown(const Call& call) {
    try {
        call();
    } catch (const Thrown& error) {
        return error.kind();
    }
    return "nothing";
}

TEST(Recombine, DefectsAreNamed) {
    const MixedMesh mesh = kuhn(2, 0, 0);
    const auto with = [&](const auto& damage) {
        MixedMesh bad = mesh;
        damage(bad);
        return kind_thrown<GeometryError>([&] { recombine(bad); });
    };
    EXPECT_EQ(with([](MixedMesh& bad) { bad.tets(1, 2) = -1; }), "index_out_of_range");
    EXPECT_EQ(with([](MixedMesh& bad) { bad.vertices(3, 0) = std::nan(""); }), "non_finite_vertex");
    EXPECT_EQ(with([](MixedMesh& bad) { std::swap(bad.tets(1, 2), bad.tets(1, 3)); }), "inverted_cell");
    EXPECT_EQ(with([](MixedMesh& bad) { bad.tets.row(1) = bad.tets.row(0); }), "crowded_face");
    EXPECT_EQ(with([](MixedMesh& bad) { bad = {}; }), "empty");
    for (const double quality : {0.0, 1.0, -0.5, std::nan("")})
        EXPECT_EQ(kind_thrown<InvalidInput>([&] { recombine(mesh, {.min_scaled_jacobian = quality}); }),
                  "min_scaled_jacobian");
    EXPECT_EQ(kind_thrown<InvalidInput>([&] { recombine(mesh, {.max_boundary_fold = 3}); }), "max_boundary_fold");
    RecombineOptions options;
    options.kept_edges.resize(1, 2);
    options.kept_edges << 0, 27;
    EXPECT_EQ(kind_thrown<InvalidInput>([&] { recombine(mesh, options); }), "index_out_of_range");
}

TEST(Recombine, MeshesWithoutTetsStay) {
    const MixedMesh mesh = CubeGrid(
                               {2, 2, 2}, [](int, int, int) { return Filled::wedges; }, 0.1, 1)
                               .mesh();
    const MixedMesh result = recombine(mesh);
    EXPECT_EQ(result.wedges, mesh.wedges);
    EXPECT_EQ(result.cell_count(), mesh.cell_count());
}

}  // namespace
}  // namespace octafield::volume
