// Each defect is found and named, and nothing else; repairs heal what can be healed safely.
#include "octafield/surface/validate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>

#include "mesh_fixtures.hpp"
#include "octafield/error.hpp"
#include "octafield/surface/read_write.hpp"
#include "octafield/surface/repair.hpp"

namespace octafield::surface {
namespace {

using namespace testing;
namespace fs = std::filesystem;
using Kinds = std::vector<std::string>;

Kinds kinds(const TriangleMesh& mesh, const ValidateOptions& options = {}) {
    Kinds found;
    for (const Defect& defect : find_defects(mesh, options)) {
        found.push_back(defect.kind);
        EXPECT_FALSE(defect.message.empty());
    }
    return found;
}

TriangleMesh joined(const TriangleMesh& a, const TriangleMesh& b) {
    TriangleMesh both;
    both.vertices.resize(a.vertices.rows() + b.vertices.rows(), 3);
    both.vertices << a.vertices, b.vertices;
    both.triangles.resize(a.triangles.rows() + b.triangles.rows(), 3);
    both.triangles << a.triangles, (b.triangles.array() + static_cast<Index>(a.vertices.rows())).matrix();
    return both;
}

TriangleMesh moved(TriangleMesh mesh, double x) {
    mesh.vertices.col(0).array() += x;
    return mesh;
}

TriangleMesh reversed(TriangleMesh mesh) {
    mesh.triangles.col(1).swap(mesh.triangles.col(2));
    return mesh;
}

TriangleMesh without(TriangleMesh mesh, Index t) {
    mesh.triangles.row(t) = mesh.triangles.row(mesh.triangles.rows() - 1).eval();
    mesh.triangles.conservativeResize(mesh.triangles.rows() - 1, 3);
    return mesh;
}

TriangleMesh with(TriangleMesh mesh, Index a, Index b, Index c) {
    mesh.triangles.conservativeResize(mesh.triangles.rows() + 1, 3);
    mesh.triangles.bottomRows(1) << a, b, c;
    return mesh;
}

void expect_same_vertices_kept(const TriangleMesh& before, const TriangleMesh& after) {
    ASSERT_GE(before.vertices.rows(), after.vertices.rows());
    for (Index v = 0; v < after.vertices.rows(); ++v)
        EXPECT_TRUE((before.vertices.rowwise() - after.vertices.row(v)).rowwise().norm().minCoeff() == 0)
            << "vertex " << v << " was moved";
}

class ValidateAtSizes : public ::testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(InputUnits, ValidateAtSizes, ::testing::Values(1e-6, 1.0, 1e6));

TEST_P(ValidateAtSizes, SoundMeshesHaveNoDefect) {
    for (TriangleMesh mesh : {icosphere(2), cube_surface(3), torus(20, 10, 1, 0.4), moved(cube_surface(2), 1000)}) {
        mesh.vertices *= GetParam();
        EXPECT_EQ(kinds(mesh), Kinds{});
    }
    TriangleMesh open = disk(4);
    open.vertices *= GetParam();
    EXPECT_EQ(kinds(open), Kinds{"not_closed"});
    EXPECT_EQ(kinds(open, {.closed = false}), Kinds{});
}

TEST_P(ValidateAtSizes, ThinTrianglesAreNoDefectButFlatOnesAre) {
    TriangleMesh mesh = cube_surface(2);
    mesh.vertices.col(2) *= 1e-9;
    mesh.vertices *= GetParam();
    EXPECT_EQ(kinds(mesh), Kinds{});
    mesh.vertices.col(2) *= 0;
    EXPECT_EQ(kinds(mesh).front(), "degenerate_triangle");
}

TEST(Validate, NamesTheElements) {
    TriangleMesh mesh = icosphere(1);
    mesh.vertices(7, 1) = std::numeric_limits<double>::quiet_NaN();
    auto defects = find_defects(mesh);
    ASSERT_EQ(defects.size(), 1u);
    EXPECT_EQ(defects[0].kind, "non_finite_vertex");
    EXPECT_EQ(defects[0].element, "vertex");
    EXPECT_EQ(defects[0].elements, std::vector<Index>{7});

    mesh = icosphere(1);
    mesh.triangles(5, 2) = 10000;
    mesh.triangles(9, 0) = -1;
    defects = find_defects(mesh);
    ASSERT_EQ(defects.size(), 1u);
    EXPECT_EQ(defects[0].kind, "index_out_of_range");
    EXPECT_EQ(defects[0].elements, (std::vector<Index>{5, 9}));

    mesh = without(icosphere(1), 3);
    const auto hole = icosphere(1).triangles.row(3).eval();
    defects = find_defects(mesh);
    ASSERT_EQ(defects.size(), 1u);
    EXPECT_EQ(defects[0].kind, "not_closed");
    EXPECT_EQ(defects[0].element, "edge");
    ASSERT_EQ(defects[0].elements.size(), 6u);
    for (const Index v : defects[0].elements) EXPECT_TRUE((hole.array() == v).any());
}

TEST(Validate, EachDefectIsFoundAndNothingElse) {
    EXPECT_EQ(kinds({}), Kinds{"empty"});
    EXPECT_EQ(kinds(with(icosphere(1), 3, 3, 4)), Kinds{"degenerate_triangle"});
    EXPECT_EQ(kinds(as_soup(icosphere(1))), Kinds{"soup"});
    EXPECT_EQ(kinds(reversed(icosphere(1))), Kinds{"inside_out"});
    TriangleMesh flipped = icosphere(1);
    flipped.triangles.row(4).reverseInPlace();
    EXPECT_EQ(kinds(flipped), Kinds{"inconsistent_orientation"});
    TriangleMesh seam = cube_surface(2);  // one corner of one triangle gets a vertex of its own
    seam.vertices.conservativeResize(seam.vertices.rows() + 1, 3);
    seam.vertices.bottomRows(1) = seam.vertices.row(seam.triangles(0, 0));
    seam.triangles(0, 0) = static_cast<Index>(seam.vertices.rows() - 1);
    EXPECT_EQ(kinds(seam).front(), "duplicate_vertex");
    EXPECT_EQ(kinds(joined(icosphere(2), moved(icosphere(2), 1.5))), Kinds{"self_intersection"});
    const TriangleMesh ball = icosphere(1);
    EXPECT_EQ(kinds(with(ball, ball.triangles(0, 0), ball.triangles(0, 1), 40)).front(), "non_manifold_edge");
}

TEST(Validate, AVertexWhereTwoPartsTouchIsNotManifold) {
    TriangleMesh mesh = joined(cube_surface(1), moved(cube_surface(1), 1));
    mesh.vertices.bottomRows(8).rightCols(2).array() += 1;  // the second cube's corner (1, 1, 1) meets the first's
    std::vector<Index> first, second;
    for (Index v = 0; v < 16; ++v)
        if (mesh.vertices.row(v) == Eigen::RowVector3d(1, 1, 1)) (v < 8 ? first : second).push_back(v);
    ASSERT_EQ(first.size() + second.size(), 2u);
    EXPECT_EQ(kinds(mesh), Kinds{"duplicate_vertex"});
    mesh.triangles = mesh.triangles.unaryExpr([&](Index v) { return v == second[0] ? first[0] : v; });
    EXPECT_EQ(kinds(mesh), Kinds{"non_manifold_vertex"});
}

TEST(Validate, CavitiesFaceInwardAndIslandsInThemOutward) {
    const TriangleMesh outer = icosphere(2, 3), cavity = icosphere(2, 2), island = icosphere(2, 1);
    EXPECT_EQ(kinds(joined(outer, reversed(cavity))), Kinds{});
    EXPECT_EQ(kinds(joined(reversed(cavity), outer)), Kinds{});
    EXPECT_EQ(kinds(joined(joined(outer, reversed(cavity)), island)), Kinds{});
    EXPECT_EQ(kinds(joined(moved(outer, 10), island)), Kinds{});
    const auto defects = find_defects(joined(outer, cavity));
    ASSERT_EQ(defects.size(), 1u);
    EXPECT_EQ(defects[0].kind, "inside_out");
    EXPECT_EQ(defects[0].elements.size(), 320u);
    EXPECT_EQ(defects[0].elements.front(), 320);
    EXPECT_EQ(kinds(repair(joined(outer, cavity)).mesh), Kinds{});
    EXPECT_EQ(kinds(repair(reversed(joined(outer, reversed(cavity)))).mesh), Kinds{});
}

TEST(Validate, TouchingAndFoldedSurfacesAreSelfIntersections) {
    TriangleMesh pushed =
        cube_surface(4);  // the middle of the top down to the bottom: onto a vertex, onto a triangle, just above
    Index top = 0;
    (pushed.vertices.rowwise() - Eigen::RowVector3d(0.5, 0.5, 1)).rowwise().norm().minCoeff(&top);
    pushed.vertices.row(top) << 0.5, 0.5, 0;
    EXPECT_EQ(kinds(pushed), Kinds{"duplicate_vertex"});
    pushed.vertices.row(top) << 0.55, 0.53, 0;
    EXPECT_EQ(kinds(pushed), Kinds{"self_intersection"});
    pushed.vertices.row(top) << 0.55, 0.53, 1e-12;
    EXPECT_EQ(kinds(pushed), Kinds{});
    const TriangleMesh folded = make_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.2, 0.3, 0}}, {{0, 1, 2}, {1, 0, 3}});
    EXPECT_EQ(kinds(folded, {.closed = false}), Kinds{"self_intersection"});
    EXPECT_EQ(kinds(folded, {.closed = false, .self_intersection = false}), Kinds{});
}

TEST(Validate, EveryTriangleOfManyCrossingPairsIsNamed) {
    // A fan of 60 triangles, each through the middle of all others: 1770 pairs; and a sound cube, not named.
    TriangleMesh fan;
    fan.vertices.resize(180, 3);
    fan.triangles.resize(60, 3);
    for (Index t = 0; t < 60; ++t) {
        const double angle = std::numbers::pi * t / 60, c = std::cos(angle), s = std::sin(angle);
        fan.vertices.middleRows(3 * t, 3) << -c, -s, -1, c, s, -1, 0, 0, 1 + 0.01 * t;
        fan.triangles.row(t) << 3 * t, 3 * t + 1, 3 * t + 2;
    }
    for (const Defect& defect : find_defects(joined(moved(cube_surface(2), 5), fan), {.closed = false})) {
        if (defect.kind != "self_intersection") continue;
        ASSERT_EQ(defect.elements.size(), 60u);
        EXPECT_EQ(defect.elements.front(), 48);
        EXPECT_EQ(defect.elements.back(), 48 + 59);
        return;
    }
    FAIL() << "no self-intersection found";
}

TEST(Validate, FarFromTheOriginSoundMeshesStaySound) {
    for (const double sizes_away : {1e3, 1e5})
        for (TriangleMesh mesh : {icosphere(3), cube_surface(4), torus(20, 10, 1, 0.4),
                                  joined(reversed(cube_surface(1)), moved(icosphere(2, 3), 0.25))}) {
            mesh.vertices.rowwise() += Eigen::RowVector3d(2, -1, 0.5) * sizes_away;
            EXPECT_EQ(kinds(mesh), Kinds{});
        }
}

TEST(Validate, ManyCavitiesAreToldFromManyIslands) {
    // 1728 small cubes side by side: inside a large one they must face inward, without it outward.
    const TriangleMesh one = cube_surface(1);
    TriangleMesh many;
    many.vertices.resize(8 * 1728, 3);
    many.triangles.resize(12 * 1728, 3);
    for (Index i = 0; i < 1728; ++i) {
        many.vertices.middleRows(8 * i, 8) =
            one.vertices.rowwise() + 2 * Eigen::RowVector3d(i % 12, i / 12 % 12, i / 144);
        many.triangles.middleRows(12 * i, 12) = (one.triangles.array() + 8 * i).matrix();
    }
    TriangleMesh box = one;
    box.vertices = (30 * one.vertices).array() - 1;
    EXPECT_EQ(kinds(many), Kinds{});
    EXPECT_EQ(kinds(joined(box, reversed(many))), Kinds{});
    EXPECT_EQ(repair(joined(box, many)).mesh.triangles, joined(box, reversed(many)).triangles);
}

TEST(Validate, UnusedVerticesAreNoDefect) {
    TriangleMesh mesh = icosphere(1);
    mesh.vertices.conservativeResize(mesh.vertices.rows() + 2, 3);
    mesh.vertices.bottomRows(2) = mesh.vertices.topRows(2);
    EXPECT_EQ(kinds(mesh), Kinds{});
}

TEST(Validate, RequireValidThrowsTheFirstDefect) {
    EXPECT_NO_THROW(require_valid(icosphere(1)));
    TriangleMesh mesh = without(icosphere(1), 0);
    mesh.triangles.row(40).reverseInPlace();
    try {
        require_valid(mesh);
        FAIL();
    } catch (const GeometryError& error) {
        EXPECT_EQ(error.kind(), "inconsistent_orientation");
        EXPECT_EQ(error.elements().size(), 6u);
        EXPECT_NE(std::string(error.what()).find("1 further kind"), std::string::npos) << error.what();
    }
}

TEST(Repair, LeavesASoundMeshAlone) {
    for (const TriangleMesh& mesh :
         {icosphere(2), torus(20, 10, 1, 0.4), joined(icosphere(2, 3), reversed(icosphere(2, 2)))}) {
        const RepairResult result = repair(mesh);
        EXPECT_EQ(result.actions, Kinds{});
        EXPECT_EQ(result.mesh.vertices, mesh.vertices);
        EXPECT_EQ(result.mesh.triangles, mesh.triangles);
    }
}

TEST(Repair, HealsASoupWithMixedOrientation) {
    TriangleMesh soup = as_soup(torus(20, 10, 1, 0.4));
    for (Index t = 0; t < soup.triangles.rows(); t += 3) soup.triangles.row(t).reverseInPlace();
    const RepairResult result = repair(soup);
    EXPECT_EQ(kinds(result.mesh), Kinds{});
    EXPECT_EQ(euler_characteristic(result.mesh), 0);
    EXPECT_EQ(result.mesh.vertices.rows(), 200);
    EXPECT_EQ(result.actions.size(), 2u);
}

TEST(Repair, ReversesTheFewestTriangles) {
    TriangleMesh mesh = icosphere(2);
    mesh.triangles.row(17).reverseInPlace();
    const RepairResult result = repair(mesh);
    EXPECT_EQ(kinds(result.mesh), Kinds{});
    ASSERT_EQ(result.actions.size(), 1u);
    EXPECT_EQ(result.actions[0].find("reversed 1 triangle "), 0u) << result.actions[0];
}

// A point put on an edge of one triangle only leaves a triangle without area when the gap is closed by its three
// points.
TEST(Repair, FlipsAwayTrianglesWithoutArea) {
    TriangleMesh mesh = cube_surface(1);
    const Index a = mesh.triangles(0, 0), b = mesh.triangles(0, 1), c = mesh.triangles(0, 2), m = 8;
    mesh.vertices.conservativeResize(9, 3);
    mesh.vertices.row(m) = (mesh.vertices.row(a) + mesh.vertices.row(b)) / 2;
    mesh.triangles.row(0) << a, m, c;
    mesh = with(with(mesh, m, b, c), a, b, m);
    EXPECT_EQ(kinds(mesh).front(), "degenerate_triangle");
    const RepairResult result = repair(mesh);
    EXPECT_EQ(kinds(result.mesh), Kinds{});
    EXPECT_EQ(result.mesh.triangles.rows(), 14);
    EXPECT_NEAR(signed_volume(result.mesh), 1, 1e-14);
    expect_same_vertices_kept(mesh, result.mesh);
}

TEST(Repair, FlipsAwayALongChainOfTrianglesWithoutArea) {
    // Points along a line from a corner, joined to it by flat triangles: only the last can be flipped at first.
    const Index n = 3000;
    TriangleMesh mesh;
    mesh.vertices.resize(n + 3, 3);
    for (Index i = 0; i <= n; ++i) mesh.vertices.row(i) << i, 0, 0;
    mesh.vertices.row(n + 1) << 0, -5, 0;
    mesh.vertices.row(n + 2) << n, 5, 0;
    mesh.triangles.resize(2 * n, 3);
    for (Index i = 0; i < n; ++i) mesh.triangles.row(i) << i + 1, i, n + 1;
    for (Index i = 1; i < n; ++i) mesh.triangles.row(n + i - 1) << 0, i, i + 1;
    mesh.triangles.row(2 * n - 1) << 0, n, n + 2;
    const RepairResult result = repair(mesh, {.closed = false});
    EXPECT_EQ(kinds(result.mesh, {.closed = false, .self_intersection = false}), Kinds{});
    EXPECT_EQ(result.mesh.triangles.rows(), 2 * n);
    EXPECT_NEAR(triangle_areas(result.mesh).sum(), triangle_areas(mesh).sum(), 1e-9 * n);
}

TEST(Repair, FillsHolesUpToTheGivenSizeOnly) {
    TriangleMesh mesh = icosphere(3);
    std::vector<Index> kept;
    for (Index t = 0; t < mesh.triangles.rows(); ++t)
        if ((mesh.triangles.row(t).array() != 0).all()) kept.push_back(t);  // the 5 triangles round vertex 0 go
    mesh.triangles = mesh.triangles(kept, Eigen::all).eval();
    const RepairResult filled = repair(mesh);
    EXPECT_EQ(kinds(filled.mesh), Kinds{});
    EXPECT_EQ(filled.mesh.triangles.rows(), mesh.triangles.rows() + 3);
    EXPECT_EQ(filled.mesh.vertices, mesh.vertices.bottomRows(mesh.vertices.rows() - 1));  // the unused one went
    const RepairResult left = repair(mesh, {.small_hole_edges = 4});
    EXPECT_EQ(kinds(left.mesh), Kinds{"not_closed"});
    EXPECT_EQ(left.mesh.triangles.rows(), mesh.triangles.rows());
}

TEST(Repair, LeavesWhatIsNoHole) {
    const TriangleMesh triangle = make_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
    EXPECT_EQ(repair(triangle).actions, Kinds{});
    const TriangleMesh bow =
        make_mesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}}, {{0, 1, 2}, {0, 3, 4}});
    EXPECT_EQ(repair(bow).actions, Kinds{});
}

TEST(Repair, LevelNoneDoesNothing) {
    const TriangleMesh broken = with(without(as_soup(icosphere(1)), 3), 3, 3, 4);
    const RepairResult result = repair(broken, {.level = RepairLevel::none});
    EXPECT_EQ(result.actions, Kinds{});
    EXPECT_EQ(result.mesh.triangles, broken.triangles);
}

TEST(Repair, DoesNotThrowOnWhatItCannotRepair) {
    EXPECT_EQ(repair({}).actions, Kinds{});
    TriangleMesh mesh = icosphere(1);
    mesh.triangles(0, 0) = 99999;
    EXPECT_EQ(kinds(repair(mesh).mesh), Kinds{"index_out_of_range"});
    mesh = icosphere(1);
    mesh.vertices(0, 0) = INFINITY;
    EXPECT_EQ(kinds(repair(mesh).mesh), Kinds{"non_finite_vertex"});
    // A Moebius strip cannot be oriented.
    const TriangleMesh strip =
        make_mesh({{1, 0, 0}, {1, 0, 1}, {-0.5, 0.8, 0}, {-0.5, 0.8, 1}, {-0.5, -0.8, 0}, {-0.5, -0.8, 1}},
                  {{0, 2, 1}, {1, 2, 3}, {2, 4, 3}, {3, 4, 5}, {4, 1, 5}, {5, 1, 0}});
    EXPECT_FALSE(find_defects(repair(strip).mesh).empty());
    // All points on one line, all points the same.
    const TriangleMesh line =
        make_mesh({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}});
    EXPECT_FALSE(find_defects(repair(line).mesh).empty());
    TriangleMesh point = icosphere(1);
    point.vertices.setZero();
    EXPECT_FALSE(find_defects(repair(point).mesh).empty());
    for (const TriangleMesh& hopeless : {strip, line, point})
        EXPECT_FALSE(find_defects(repair(hopeless, {.level = RepairLevel::wrap}).mesh).empty());
    EXPECT_THROW(repair(strip, {.max_hole_edges = -1}), InvalidInput);
    EXPECT_THROW(repair(strip, {.wrap_alpha = NAN}), InvalidInput);
    EXPECT_THROW(repair_level("all"), InvalidInput);
}

struct Case {
    std::string name, kind;
};

class SharedDefects : public ::testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Manifest, SharedDefects,
                         ::testing::Values(Case{"hole_s17", "not_closed"},
                                           Case{"flipped_s01", "inconsistent_orientation"},
                                           Case{"selfcross_s15", "self_intersection"}, Case{"soup_s04", "soup"},
                                           Case{"insideout_s16", "inside_out"}, Case{"fin_s01", "non_manifold_edge"},
                                           Case{"degenerate_s17", "degenerate_triangle"}),
                         [](const auto& info) { return info.param.name; });

TEST_P(SharedDefects, AreNamedInObjAndStlAndHealedWhereSafe) {
    const fs::path folder = fs::path(OCTAFIELD_SHARED_DATA) / "surfaces";
    if (!fs::exists(folder)) GTEST_SKIP() << "no data in " << folder;
    for (const std::string extension : {".obj", ".stl"}) {
        const TriangleMesh mesh = read_surface(folder / ("bad_" + GetParam().name + extension));
        const Kinds found = kinds(mesh);
        if (GetParam().kind == "soup" && extension == ".stl") {  // every STL is one; reading merges the points
            EXPECT_EQ(found, Kinds{});
            continue;
        }
        const Kinds expected =
            GetParam().kind == "non_manifold_edge" ? Kinds{"non_manifold_edge", "not_closed"} : Kinds{GetParam().kind};
        EXPECT_EQ(found, expected) << extension;
        const RepairResult result = repair(mesh);
        expect_same_vertices_kept(mesh, result.mesh);
        if (GetParam().kind == "self_intersection") {
            EXPECT_EQ(kinds(result.mesh), found);
            EXPECT_EQ(result.actions, Kinds{});
        } else {
            EXPECT_EQ(kinds(result.mesh), Kinds{}) << extension;
            EXPECT_GE(result.actions.size(), 1u);
        }
        if (GetParam().kind == "non_manifold_edge") {
            EXPECT_EQ(kinds(repair(mesh, {.level = RepairLevel::merge}).mesh), expected);
        }
    }
}

TEST(SharedSurfaces, SoundOnesHaveNoDefect) {
    const fs::path folder = fs::path(OCTAFIELD_SHARED_DATA) / "surfaces";
    if (!fs::exists(folder)) GTEST_SKIP() << "no data in " << folder;
    for (const std::string name : {"s01", "s04", "s15", "s16", "s17", "i10"})
        for (const std::string extension : {"_surface.obj", "_surface.stl", "_surface_binary.stl.gz"})
            EXPECT_EQ(kinds(read_surface(folder / (name + extension))), Kinds{}) << name << extension;
}

}  // namespace
}  // namespace octafield::surface
