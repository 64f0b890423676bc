// recombine and conform beside walls: triangles between regions that no cell reaches through.
#include <gtest/gtest.h>

#include <numeric>

#include "delaunay_mesh.hpp"
#include "mixed_grids.hpp"
#include "octafield/disjoint_sets.hpp"
#include "octafield/error.hpp"
#include "octafield/volume/recombination.hpp"

namespace octafield::volume {
namespace {

using testing::CubeGrid;
using testing::expect_sound;
using testing::Filled;
using Ids = std::vector<Index>;
using Vector = Eigen::Vector3d;

MixedMesh kuhn(int x, int y, int z, double jitter, unsigned seed) {
    return CubeGrid(
               {x, y, z}, [](int, int, int) { return Filled::kuhn; }, jitter, seed)
        .mesh();
}

Vector middle(const Points& places, const Ids& cell) {
    Vector sum = Vector::Zero();
    for (const Index v : cell) sum += places.row(v);
    return sum / static_cast<double>(cell.size());
}

Ids of_tet(const MixedMesh& mesh, Index tet) { return {mesh.tets.row(tet).data(), mesh.tets.row(tet).data() + 4}; }

// Triangles between tets of different regions, ascending.
std::set<Ids> walls_between(const MixedMesh& mesh, const std::vector<int>& regions) {
    std::map<Ids, int> seen;
    std::set<Ids> walls;
    for (Index t = 0; t < mesh.tets.rows(); ++t)
        for (int without = 0; without < 4; ++without) {
            Ids face = of_tet(mesh, t);
            face.erase(face.begin() + without);
            std::sort(face.begin(), face.end());
            const auto [entry, fresh] = seen.try_emplace(face, regions[t]);
            if (!fresh && entry->second != regions[t]) walls.insert(face);
        }
    return walls;
}

Triangles as_rows(const std::set<Ids>& walls) {
    Triangles rows(walls.size(), 3);
    Eigen::Index row = 0;
    for (const Ids& wall : walls) rows.row(row++) << wall[0], wall[1], wall[2];
    return rows;
}

// A triangle that is a wall, or a quad that is two; half of a quad fails the test.
bool on_wall(const Ids& sorted, const std::set<Ids>& walls) {
    if (sorted.size() == 3) return walls.count(sorted) > 0;
    int halves = 0;
    for (int without = 0; without < 4; ++without) {
        Ids half = sorted;
        half.erase(half.begin() + without);
        halves += static_cast<int>(walls.count(half));
    }
    EXPECT_NE(halves, 1) << "a quad lies on a wall with one half";
    return halves >= 2;
}

// Volumes of the parts that faces off the walls connect, ascending.
std::vector<double> parts(const MixedMesh& mesh, const std::set<Ids>& walls) {
    DisjointSets sets(mesh.cell_count());
    std::map<Ids, Index> first;
    Index number = 0;
    testing::each_cell(mesh, [&](const Ids& cell) {
        for (const auto& local : testing::reference(static_cast<int>(cell.size())).faces) {
            Ids face;
            for (const int k : local) face.push_back(cell[k]);
            std::sort(face.begin(), face.end());
            if (on_wall(face, walls)) continue;
            const auto [entry, fresh] = first.try_emplace(face, number);
            if (!fresh) sets.join(entry->second, number);
        }
        ++number;
    });
    const Eigen::VectorXd volumes = cell_volumes(mesh);
    std::map<Index, double> sums;
    for (Index c = 0; c < mesh.cell_count(); ++c) sums[sets.lowest(c)] += volumes[c];
    std::vector<double> result;
    for (const auto& [part, volume] : sums) result.push_back(volume);
    std::sort(result.begin(), result.end());
    return result;
}

// Quads on walls, each as often as cells have it.
std::map<Ids, int> wall_quads(const MixedMesh& mesh, const std::set<Ids>& walls) {
    std::map<Ids, int> quads;
    for (const auto& [face, use] : testing::faces_of(mesh))
        if (face.size() == 4 && on_wall(face, walls)) quads[face] = use.count;
    return quads;
}

struct Joined {
    MixedMesh mesh;
    RecombineReport report;
};

// Joined and made to match; parts stay apart, their volumes up to `error`, as the same quads are on both sides.
Joined expect_parts_kept(const MixedMesh& mesh, const std::set<Ids>& walls, RecombineOptions options, double error) {
    options.walls = as_rows(walls);
    Joined result;
    const MixedMesh joined = recombine(mesh, options, &result.report);
    result.mesh = conform(joined, nullptr, options.walls);
    expect_sound(result.mesh, 1e-12);
    const std::vector<double> before = parts(mesh, walls), after = parts(result.mesh, walls);
    EXPECT_EQ(before.size(), after.size());
    for (std::size_t i = 0; i < std::min(before.size(), after.size()); ++i) EXPECT_NEAR(after[i], before[i], error);
    for (const auto& [quad, cells] : wall_quads(result.mesh, walls)) EXPECT_EQ(cells, 2);
    return result;
}

std::vector<int> sides(const MixedMesh& mesh, const std::function<bool(const Vector&)>& beyond) {
    std::vector<int> regions;
    for (Index t = 0; t < mesh.tets.rows(); ++t) regions.push_back(beyond(middle(mesh.vertices, of_tet(mesh, t))));
    return regions;
}

TEST(RecombineWalls, CubesOnBothSidesOfAPlaneComeBackAndMeetInQuads) {
    const MixedMesh mesh = kuhn(4, 3, 3, 0, 0);
    const std::set<Ids> walls = walls_between(mesh, sides(mesh, [](const Vector& x) { return x[0] > 1; }));
    EXPECT_EQ(walls.size(), 18u);
    const Joined joined = expect_parts_kept(mesh, walls, {}, 1e-12);
    EXPECT_EQ(joined.mesh.hexahedra.rows(), 36);
    EXPECT_EQ(joined.mesh.cell_count(), 36);
    EXPECT_EQ(wall_quads(joined.mesh, walls).size(), 9u);
}

TEST(RecombineWalls, ACubeThatAWallHalvesBecomesTwoWedges) {
    const MixedMesh mesh = kuhn(3, 3, 2, 0, 0);
    const std::set<Ids> walls = walls_between(mesh, sides(mesh, [](const Vector& x) { return x[0] > x[1]; }));
    const Joined joined = expect_parts_kept(mesh, walls, {}, 1e-12);
    EXPECT_EQ(joined.report.hexahedra, 12);
    EXPECT_EQ(joined.report.wedges, 12);
    EXPECT_EQ(joined.mesh.cell_count(), 24);
    EXPECT_EQ(wall_quads(joined.mesh, walls).size(), 6u);
}

// A tet of the first cube with a face on the second: that has half a quad on the wall.
TEST(RecombineWalls, CubesWithATetOfAnotherRegionOrHalfAQuadOnOneAreNotJoined) {
    const MixedMesh mesh = kuhn(2, 2, 2, 0, 0);
    std::vector<int> regions(mesh.tets.rows(), 0);
    regions[0] = 1;
    const std::set<Ids> walls = walls_between(mesh, regions);
    const Joined joined = expect_parts_kept(mesh, walls, {.wedges = false}, 1e-12);
    EXPECT_EQ(joined.report.hexahedra, 6);
}

TEST(RecombineWalls, WallsThatFoldAreNotSmoothedOverAndFeaturesStay) {
    for (const double height : {0.1, 0.2}) {
        MixedMesh mesh = kuhn(1, 1, 2, 0, 0);
        for (const Index v : {4, 7}) mesh.vertices(v, 2) += height;  // turned by 16 or 31 degrees at the edge 4-7
        const Points straight = kuhn(1, 1, 2, 0, 0).vertices;
        std::vector<int> regions;
        for (Index t = 0; t < mesh.tets.rows(); ++t) regions.push_back(middle(straight, of_tet(mesh, t))[2] > 1);
        const std::set<Ids> walls = walls_between(mesh, regions);
        EXPECT_EQ(walls.size(), 2u);
        RecombineOptions options;
        options.wedges = false;
        EXPECT_EQ(recombine(mesh, options).hexahedra.rows(), 2);
        options.walls = as_rows(walls);
        EXPECT_EQ(recombine(mesh, options).hexahedra.rows(), height == 0.1 ? 2 : 0);
        options.kept_edges.resize(1, 2);
        options.kept_edges << 7, 4;
        EXPECT_EQ(recombine(mesh, options).hexahedra.rows(), 0);
    }
}

// Four regions meet in an edge that would be the diagonal of a quad on a plane of one of them.
TEST(RecombineWalls, AnEdgeWhereWallsMeetIsNoDiagonal) {
    const MixedMesh mesh = kuhn(2, 2, 2, 0, 0);
    const std::vector<int> upper = sides(mesh, [](const Vector&x) { return x[2] > 1; }),
                           right = sides(mesh, [](const Vector&x) { return x[0] > x[1]; });
    std::vector<int> regions;
    for (std::size_t t = 0; t < upper.size(); ++t) regions.push_back(upper[t] + 2 * (upper[t] && right[t]));
    const std::set<Ids> walls = walls_between(mesh, regions);
    // The halves of cubes above stand on the diagonals of those below, which cannot have quads there.
    const Joined joined = expect_parts_kept(mesh, walls, {.wedges = false}, 1e-12);
    EXPECT_EQ(joined.report.hexahedra, 2 + 2);
}

TEST(RecombineWalls, RegionsAtRandomKeepTheirVolumes) {
    for (unsigned seed = 0; seed < 6; ++seed) {
        std::mt19937 random(seed);
        const MixedMesh mesh = seed % 2 ? kuhn(4, 4, 4, 0, 0) : testing::delaunay_mesh(kuhn(5, 5, 5, 0.15, 3).vertices);
        // Balls at random, so that many tets are inside regions.
        std::vector<int> regions(mesh.tets.rows(), 0);
        for (int ball = 1; ball < 4; ++ball) {
            Vector centre;
            for (int a = 0; a < 3; ++a) centre[a] = std::uniform_real_distribution<double>(0, 4)(random);
            for (Index t = 0; t < mesh.tets.rows(); ++t)
                if ((middle(mesh.vertices, of_tet(mesh, t)) - centre).norm() < 1.6) regions[t] = ball;
        }
        const std::set<Ids> walls = walls_between(mesh, regions);
        EXPECT_GT(walls.size(), 20u);
        RecombineOptions options;
        options.max_boundary_fold = 0;  // no quads but where walls and boundary are flat
        const Joined joined = expect_parts_kept(mesh, walls, options, 1e-10);
        EXPECT_GT(joined.report.hexahedra, 15);
    }
}

// The same with walls that are smoothed a little: what a quad takes of one region is small.
TEST(RecombineWalls, AWavyWallGetsQuadsOnBothSides) {
    for (unsigned seed = 0; seed < 3; ++seed) {
        const MixedMesh mesh = kuhn(6, 5, 5, 0.1, seed);
        const Points straight = kuhn(6, 5, 5, 0, 0).vertices;
        std::vector<int> regions;
        for (Index t = 0; t < mesh.tets.rows(); ++t) regions.push_back(middle(straight, of_tet(mesh, t))[0] > 3);
        const std::set<Ids> walls = walls_between(mesh, regions);
        const Joined joined = expect_parts_kept(mesh, walls, {}, 0.5);
        EXPECT_GT(wall_quads(joined.mesh, walls).size(), 10u);
        EXPECT_GT(joined.mesh.hexahedra.rows(), 110);
    }
}

// A cube and four tets over it, round the diagonal 4-7 of its upper quad, with a wall between two and two of them: no
// apex is raised through the wall, so the cube is given up.
TEST(RecombineWalls, NoPyramidReachesThroughAWallAtTheDiagonal) {
    MixedMesh mesh = CubeGrid(
                         {1, 1, 1}, [](int, int, int) { return Filled::hexahedron; }, 0, 0)
                         .mesh();
    mesh.vertices.conservativeResize(11, 3);
    mesh.vertices.bottomRows(3) << 0.8, 0.2, 1.5, 0.2, 0.8, 1.5, 0.5, 0.5, 1.9;
    mesh.tets.resize(4, 4);
    mesh.tets << 4, 5, 7, 8, 4, 8, 7, 10, 4, 10, 7, 9, 4, 9, 7, 6;
    const auto has_wall = [](const MixedMesh& made) { return testing::faces_of(made)[{4, 7, 10}].count == 2; };
    ConformReport report;
    EXPECT_FALSE(has_wall(conform(mesh, &report)));
    EXPECT_EQ(report.raised, 1);
    Triangles wall(1, 3);
    wall << 10, 4, 7;
    const MixedMesh kept = conform(mesh, &report, wall);
    expect_sound(kept, 1e-3);
    EXPECT_TRUE(has_wall(kept));
    EXPECT_EQ(report.raised, 0);
    EXPECT_EQ(report.split, 1);
}

TEST(RecombineWalls, ACubeBetweenHexahedraWithAWallInItIsNotJoined) {
    const MixedMesh mesh =
        CubeGrid(
            {1, 1, 3}, [](int, int, int k) { return k == 1 ? Filled::kuhn : Filled::hexahedron; }, 0, 0)
            .mesh();
    EXPECT_EQ(recombine(mesh).hexahedra.rows(), 3);
    RecombineOptions options;
    options.walls = as_rows(walls_between(mesh, sides(mesh, [](const Vector& x) { return x[0] > x[1]; })));
    EXPECT_EQ(options.walls.rows(), 2);
    EXPECT_EQ(recombine(mesh, options).hexahedra.rows(), 2);
}

TEST(RecombineWalls, WallsOfOtherVerticesAreRefused) {
    RecombineOptions options;
    options.walls.resize(1, 3);
    options.walls << 0, 1, 27;
    try {
        recombine(kuhn(2, 2, 2, 0, 0), options);
        FAIL();
    } catch (const InvalidInput& error) {
        EXPECT_EQ(error.kind(), "index_out_of_range");
    }
}

}  // namespace
}  // namespace octafield::volume
