// recombine: hexahedra and wedges of tets.
#include "octafield/volume/recombination.hpp"

#include <gtest/gtest.h>

#include "delaunay_mesh.hpp"
#include "kind_thrown.hpp"
#include "mixed_grids.hpp"
#include "octafield/error.hpp"

namespace octafield::volume {
namespace {

using testing::CubeGrid;
using testing::expect_sound;
using testing::Filled;
using testing::kind_thrown;
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

// Quads that meet triangles meet two of tets, and their diagonal is on no other cell.
void expect_pyramids_possible(const MixedMesh& mesh) {
    using Ids = std::vector<Index>;
    std::map<Ids, std::size_t> loose;  // faces of one cell, and how many vertices that has
    std::set<Ids> edges;               // of cells that are no tets
    testing::each_cell(mesh, [&](const Ids& cell) {
        for (const auto& local : testing::reference(static_cast<int>(cell.size())).faces) {
            Ids face;
            for (const int k : local) face.push_back(cell[k]);
            for (std::size_t k = 0; k < face.size() && cell.size() > 4; ++k) {
                const auto [low, high] = std::minmax(face[k], face[(k + 1) % face.size()]);
                edges.insert({low, high});
            }
            std::sort(face.begin(), face.end());
            if (const auto [entry, fresh] = loose.try_emplace(face, cell.size()); !fresh) loose.erase(entry);
        }
    });
    for (const auto& [quad, of] : loose) {
        std::vector<Ids> met;
        for (int without = 0; without < 4 && quad.size() == 4; ++without) {
            Ids triangle = quad;
            triangle.erase(triangle.begin() + without);
            const auto found = loose.find(triangle);
            if (found == loose.end()) continue;
            EXPECT_EQ(found->second, 4u) << "a quad on a triangle of a cell that is no tet";
            met.push_back(triangle);
        }
        if (met.size() != 2) continue;  // three: one is of another quad with three of these vertices
        Ids diagonal;
        std::set_intersection(met[0].begin(), met[0].end(), met[1].begin(), met[1].end(), std::back_inserter(diagonal));
        EXPECT_FALSE(edges.count(diagonal)) << "a diagonal is an edge of a cell that is no tet";
    }
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
    expect_pyramids_possible(result);
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

TEST(Recombine, RandomPointsGiveSoundMeshesAlsoInTwoSteps) {
    std::mt19937 random(4);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (int trial = 0; trial < 2; ++trial) {
        Points points(300, 3);
        for (Eigen::Index i = 0; i < points.size(); ++i) points.data()[i] = uniform(random);
        const MixedMesh mesh = testing::delaunay_mesh(points);
        const double volume = cell_volumes(mesh).sum();
        RecombineOptions options;
        options.max_boundary_fold = 0;  // no quads on the boundary, which would change the volume
        RecombineReport report;
        options.min_scaled_jacobian = 0.45;
        const MixedMesh good = recombine(mesh, options, &report);
        EXPECT_GT(report.hexahedra, 5);
        EXPECT_GT(report.wedges, 5);
        EXPECT_NEAR(cell_volumes(expect_good(mesh, good, report, 0.45)).sum(), volume, 1e-12);
        options.min_scaled_jacobian = 0.1;
        const MixedMesh more = recombine(good, options, &report);  // those of the first step stay
        EXPECT_GT(report.hexahedra, 5);
        EXPECT_GT(report.wedges, 5);
        EXPECT_NEAR(cell_volumes(expect_good(good, more, report, 0.1)).sum(), volume, 1e-12);
    }
}

// Two cubes in six tets each whose diagonals cross where they meet; between them is one tet, or four about its middle.
MixedMesh cubes_with_crossing_diagonals(bool four) {
    MixedMesh mesh = CubeGrid(
                         {1, 1, 2}, [](int, int, int) { return Filled::hexahedron; }, 0, 0)
                         .mesh();
    mesh.hexahedra.resize(0, 8);
    for (const Index high : {4, 7}) mesh.vertices(high, 2) += 0.1;
    for (const Index low : {5, 6}) mesh.vertices(low, 2) -= 0.1;
    std::vector<std::array<Index, 4>> tets;
    for (const auto& path : {std::array{0, 2}, {0, 4}, {3, 2}, {3, 7}, {5, 4}, {5, 7}})
        tets.push_back({1, path[0], path[1], 6});
    for (const auto& path : {std::array{5, 7}, {5, 9}, {6, 7}, {6, 10}, {8, 9}, {8, 10}})
        tets.push_back({4, path[0], path[1], 11});
    if (four) {
        mesh.vertices.conservativeResize(13, 3);
        mesh.vertices.row(12) << 0.5, 0.5, 1;
        for (const auto& face : {std::array{4, 5, 6}, {4, 5, 7}, {4, 6, 7}, {5, 6, 7}})
            tets.push_back({face[0], face[1], face[2], 12});
    } else {
        tets.push_back({4, 5, 6, 7});
    }
    mesh.tets.resize(tets.size(), 4);
    for (std::size_t t = 0; t < tets.size(); ++t) {
        const auto edge = [&](int k) -> Vector {
            return mesh.vertices.row(tets[t][k]) - mesh.vertices.row(tets[t][0]);
        };
        if (edge(1).cross(edge(2)).dot(edge(3)) < 0) std::swap(tets[t][0], tets[t][1]);
        for (int k = 0; k < 4; ++k) mesh.tets(t, k) = tets[t][k];
    }
    return mesh;
}

TEST(Recombine, OneTetBetweenCrossingDiagonalsGoesMoreDoNot) {
    RecombineReport report;
    const MixedMesh one = cubes_with_crossing_diagonals(false);
    const MixedMesh both = recombine(one, {}, &report);
    EXPECT_EQ(both.cell_count(), 2);
    EXPECT_EQ(report.flat_tets, 1);
    EXPECT_NEAR(cell_volumes(expect_good(one, both, report)).sum(), 2, 1e-12);
    const MixedMesh four = cubes_with_crossing_diagonals(true);
    const MixedMesh result = recombine(four, {}, &report);
    EXPECT_EQ(report.hexahedra, 1);
    EXPECT_EQ(report.flat_tets, 0);
    EXPECT_NEAR(cell_volumes(expect_good(four, result, report)).sum(), 2, 1e-12);
    const MixedMesh lower = recombine(four, {.wedges = false});  // now the cube stays, and the upper cannot follow
    EXPECT_EQ(recombine(lower, {.wedges = false}).hexahedra.rows(), 1);
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

TEST(Recombine, NoWedgeStandsOnHalfOfAQuad) {
    // A cube, on half of its top three tets that make a wedge, on the other half tets.
    MixedMesh mesh = CubeGrid(
                         {1, 1, 2}, [](int, int, int k) { return k ? Filled::empty : Filled::hexahedron; }, 0, 0)
                         .mesh();
    mesh.vertices.conservativeResize(13, 3);
    mesh.vertices.row(12) << 0.45, 0.7, 1.4;
    mesh.tets.resize(6, 4);
    mesh.tets << 4, 5, 7, 11, 4, 5, 9, 11, 4, 8, 9, 11, 4, 7, 6, 12, 4, 7, 11, 12, 4, 8, 11, 12;
    for (Eigen::Index t = 0; t < 6; ++t) {
        const auto edge = [&](int k) -> Vector {
            return mesh.vertices.row(mesh.tets(t, k)) - mesh.vertices.row(mesh.tets(t, 0));
        };
        if (edge(1).cross(edge(2)).dot(edge(3)) < 0) std::swap(mesh.tets(t, 0), mesh.tets(t, 1));
    }
    RecombineReport report;
    const MixedMesh result = recombine(mesh, {}, &report);
    EXPECT_GT(report.potential_wedges, 0);
    EXPECT_EQ(report.wedges, 0) << result.wedges;
    EXPECT_EQ(report.hexahedra, 0);
    EXPECT_EQ(expect_good(mesh, result, report).hexahedra.rows(), 1);
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
