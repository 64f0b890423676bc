#include "octafield/volume/tetrahedralize.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <set>

#include "../surface/mesh_fixtures.hpp"
#include "fill_surface.hpp"
#include "octafield/error.hpp"
#include "octafield/surface/read_write.hpp"

namespace octafield::volume {
namespace {

using surface::TriangleMesh;
using surface::testing::cube_surface;
using surface::testing::icosphere;
using surface::testing::torus;

TriangleMesh flipped(TriangleMesh mesh) {
    mesh.triangles.col(1).swap(mesh.triangles.col(2));
    return mesh;
}

TriangleMesh moved(TriangleMesh mesh, double x, double y, double z) {
    mesh.vertices.rowwise() += Eigen::RowVector3d(x, y, z);
    return mesh;
}

TriangleMesh together(const TriangleMesh& first, const TriangleMesh& second) {
    TriangleMesh both{Points(first.vertices.rows() + second.vertices.rows(), 3),
                      Triangles(first.triangles.rows() + second.triangles.rows(), 3)};
    both.vertices << first.vertices, second.vertices;
    both.triangles << first.triangles, (second.triangles.array() + static_cast<Index>(first.vertices.rows())).matrix();
    return both;
}

std::set<std::array<Index, 3>> oriented(const Triangles& triangles, const std::vector<Index>* map = nullptr) {
    std::set<std::array<Index, 3>> set;
    for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
        std::array<Index, 3> ids;
        for (int k = 0; k < 3; ++k) ids[k] = map ? (*map)[triangles(t, k)] : triangles(t, k);
        std::rotate(ids.begin(), std::min_element(ids.begin(), ids.end()), ids.end());
        set.insert(ids);
    }
    return set;
}

// Everything the header promises of a filled surface.
void expect_fills(const TetMesh& mesh, const TriangleMesh& surface) {
    ASSERT_NO_THROW(require_valid(mesh));
    ASSERT_GE(mesh.vertices.rows(), surface.vertices.rows());
    EXPECT_EQ(mesh.vertices.topRows(surface.vertices.rows()), surface.vertices);  // the same bits
    const BoundarySurface boundary = boundary_surface(mesh);
    EXPECT_EQ(oriented(boundary.mesh.triangles, &boundary.vertex_map), oriented(surface.triangles));
    const double volume = surface::signed_volume(surface);
    EXPECT_NEAR(tet_volumes(mesh).sum() / volume, 1, 1e-9);
    std::vector<std::uint8_t> used(mesh.vertices.rows(), 0);
    for (const Index v : mesh.tets.reshaped()) used[v] = 1;
    EXPECT_EQ(std::count(used.begin(), used.end(), 0), 0);
}

TEST(Tetrahedralize, KeepsTheSurfaceTriangleByTriangleAndFillsIt) {
    for (const TriangleMesh& surface : {icosphere(2), cube_surface(4), torus(24, 12, 1, 0.4)})
        expect_fills(tetrahedralize(surface), surface);
}

TEST(Tetrahedralize, CavitiesStayEmpty) {
    const TriangleMesh shell = together(icosphere(2), flipped(icosphere(1, 0.4)));
    expect_fills(tetrahedralize(shell), shell);
}

TEST(Tetrahedralize, SolidsInsideCavitiesAndBesideEachOtherAreFilled) {
    const TriangleMesh nested = together(together(icosphere(2), flipped(icosphere(2, 0.6))), icosphere(1, 0.3));
    expect_fills(tetrahedralize(nested), nested);
    const TriangleMesh apart = together(icosphere(1), moved(cube_surface(2), 2, 0, 0));
    expect_fills(tetrahedralize(apart), apart);
}

TEST(Tetrahedralize, TwoCavitiesStayEmpty) {
    const TriangleMesh shell = together(together(cube_surface(4), flipped(moved(icosphere(1, 0.15), 0.3, 0.3, 0.3))),
                                        flipped(moved(icosphere(1, 0.15), 0.7, 0.6, 0.7)));
    expect_fills(tetrahedralize(shell), shell);
}

TEST(Tetrahedralize, WorksAtEverySizeAndPlace) {
    const TriangleMesh ball = icosphere(2);
    const Eigen::Index tets = tetrahedralize(ball).tets.rows();
    for (const int exponent : {-20, 20}) {  // about 1e-6 and 1e6; powers of two change nothing but the exponent
        TriangleMesh scaled = ball;
        scaled.vertices *= std::ldexp(1.0, exponent);
        const TetMesh mesh = tetrahedralize(scaled);
        expect_fills(mesh, scaled);
        EXPECT_EQ(mesh.tets.rows(), tets);
    }
    TriangleMesh decimal = ball;
    decimal.vertices *= 1e-6;
    expect_fills(tetrahedralize(decimal), decimal);
    const TriangleMesh far = moved(ball, 1000, -2000, 500);
    expect_fills(tetrahedralize(far), far);
}

TEST(Tetrahedralize, EdgeLengthBoundsTheTetVolumesUnlessTheSurfaceIsCoarser) {
    const TriangleMesh cube = cube_surface(6);  // mean edge 0.19
    Eigen::Index previous = 0;
    for (const double edge : {0.3, 0.25, 0.15, 0.08}) {
        const TetMesh mesh = tetrahedralize(cube, {.edge_length = edge});
        expect_fills(mesh, cube);
        EXPECT_GE(mesh.tets.rows(), previous);
        previous = mesh.tets.rows();
        const double bound = 1.5 * edge * edge * edge / (6 * std::sqrt(2.0));
        const Eigen::VectorXd volumes = tet_volumes(mesh);
        if (edge > 0.2) {
            EXPECT_LE(volumes.maxCoeff(), bound * (1 + 1e-9));
        } else {
            EXPECT_LE(volumes.mean(), bound);
        }
    }
    EXPECT_GT(previous, 5000);
}

TEST(Tetrahedralize, GivesTheSameBitsEveryTime) {
    const TriangleMesh surface = torus(24, 12, 1, 0.4);
    const TetMesh first = tetrahedralize(surface), second = tetrahedralize(surface);
    EXPECT_EQ(first.vertices, second.vertices);
    EXPECT_EQ(first.tets, second.tets);
}

TEST(Tetrahedralize, PrintsNothing) {
    ::testing::internal::CaptureStdout();
    ::testing::internal::CaptureStderr();
    tetrahedralize(icosphere(1));
    EXPECT_THROW(tetrahedralize(together(icosphere(1), moved(icosphere(1), 0.7, 0.1, 0.2))), GeometryError);
    fflush(stdout);
    EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(Tetrahedralize, StopsWhenProgressSaysSo) {
    int calls = 0;
    const Progress stop = [&](std::string_view phase, double, double) {
        EXPECT_EQ(phase, "tetrahedralize");
        return ++calls < 2;
    };
    EXPECT_THROW(tetrahedralize(icosphere(3), {.edge_length = 0.02}, stop), Cancelled);
    EXPECT_EQ(calls, 2);
}

template <class Exception, class Call>
Exception caught(const Call& call, const std::string& kind) {
    try {
        call();
    } catch (const Exception& error) {
        EXPECT_EQ(error.kind(), kind) << error.what();
        return error;
    }
    ADD_FAILURE() << "no error of kind " << kind;
    return Exception("");
}

// What a failure of TetGen leads to: each way must keep what the first one promises.
TEST(FillSurface, EveryWayKeepsTheSurfaceAndItsCavities) {
    const TriangleMesh hollow = together(cube_surface(3), moved(flipped(icosphere(1, 0.3)), 0.5, 0.5, 0.5));
    TetgenParameters asked;
    asked.radius_edge_ratio = 1.3;
    asked.max_volume = 0.01;
    ASSERT_GE(attempts().size(), 3u);
    for (const Attempt& attempt : attempts()) {
        SCOPED_TRACE(attempt.what);
        expect_fills(fill_surface(hollow, asked, attempt, {}), hollow);
    }
}

TEST(TetgenReason, PassesNothingOnOfWhatTetgenPrints) {
    const std::string aborted =
        "python: /build/tetgen-Xy12/tetgen-1.5.0/tetgen.cxx:13523: tetgenmesh::interresult "
        "tetgenmesh::finddirection(...): Assertion `(farsh != NULL)' failed.\nAborted (core dumped)";
    EXPECT_EQ(tetgen_reason(aborted), "it stopped at a check of its own");
    EXPECT_EQ(tetgen_reason("Error:  Out of memory.\n"), "memory ran out");
    EXPECT_EQ(tetgen_reason("Found two facets intersect each other.\n  1st: [12, 13, 14] #5\n"),
              "it found parts of the surface that cross");
    for (const std::string& printed : {aborted, std::string("/home/someone/tetgen.cxx(12): bad"), std::string()})
        for (const char* foreign : {"/", "tetgen", ".cxx", "Assertion", "core", "`"})
            EXPECT_EQ(tetgen_reason(printed).find(foreign), std::string::npos) << tetgen_reason(printed);
}

TEST(TetrahedralizeRefuses, SelfIntersectionsNamingTriangles) {
    const TriangleMesh crossing = together(icosphere(1), moved(icosphere(1), 0.7, 0.1, 0.2));
    const auto error = caught<GeometryError>([&] { tetrahedralize(crossing); }, "tetgen_self_intersection");
    EXPECT_FALSE(error.elements().empty());
}

TEST(TetrahedralizeRefuses, OpenSurfaces) {
    TriangleMesh open = icosphere(1);
    open.triangles.conservativeResize(open.triangles.rows() - 1, 3);
    caught<GeometryError>([&] { tetrahedralize(open); }, "not_closed");
}

TEST(TetrahedralizeRefuses, ComponentsInsideOneAnotherThatAreNoCavities) {
    const TriangleMesh doubled = together(icosphere(2), icosphere(1, 0.4));
    EXPECT_THROW(tetrahedralize(doubled), GeometryError);
}

TEST(TetrahedralizeRefuses, UnusedVerticesNamingThem) {
    TriangleMesh mesh = icosphere(1);
    mesh.vertices.conservativeResize(mesh.vertices.rows() + 1, 3);
    mesh.vertices.bottomRows<1>() << 0.1, 0.2, 0.3;
    const auto error = caught<InvalidInput>([&] { tetrahedralize(mesh); }, "unused_vertex");
    EXPECT_EQ(error.elements(), std::vector<Index>{42});
}

TEST(TetrahedralizeRefuses, OptionsOutOfRange) {
    const TriangleMesh ball = icosphere(1);
    caught<InvalidInput>([&] { tetrahedralize(ball, {.radius_edge_ratio = 0.9}); }, "radius_edge_ratio");
    caught<InvalidInput>([&] { tetrahedralize(ball, {.min_dihedral = 20}); }, "min_dihedral");
    caught<InvalidInput>([&] { tetrahedralize(ball, {.edge_length = -1}); }, "edge_length");
    caught<InvalidInput>([&] { tetrahedralize(ball, {.edge_length = std::nan("")}); }, "edge_length");
    caught<InvalidInput>([&] { tetrahedralize(ball, {.edge_length = 1e-4}); }, "edge_length");
}

class SharedSurface : public ::testing::TestWithParam<const char*> {
protected:
    std::filesystem::path path() const {
        return std::filesystem::path(OCTAFIELD_SHARED_DATA) / "surfaces" / GetParam();
    }
    void SetUp() override {
        if (!std::filesystem::exists(path())) GTEST_SKIP() << path() << " is absent";
    }
};

TEST_P(SharedSurface, IsFilled) {
    const TriangleMesh surface = surface::read_surface(path());
    const TetMesh mesh = tetrahedralize(surface);
    expect_fills(mesh, surface);
    RecordProperty("tets", std::to_string(mesh.tets.rows()));
}

INSTANTIATE_TEST_SUITE_P(Data, SharedSurface,
                         ::testing::Values("s01_surface.obj", "s04_surface.obj", "s15_surface.obj", "s16_surface.obj",
                                           "s17_surface.obj", "i10_surface.obj"));

class BrokenSurface : public SharedSurface {};

TEST_P(BrokenSurface, IsRefused) {
    const TriangleMesh surface = surface::read_surface(path());
    EXPECT_THROW(tetrahedralize(surface), GeometryError);
}

INSTANTIATE_TEST_SUITE_P(Data, BrokenSurface,
                         ::testing::Values("bad_degenerate_s17.obj", "bad_fin_s01.obj", "bad_flipped_s01.obj",
                                           "bad_hole_s17.obj", "bad_insideout_s16.obj", "bad_selfcross_s15.obj",
                                           "bad_soup_s04.obj"));

}  // namespace
}  // namespace octafield::volume
