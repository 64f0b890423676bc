// Tets between a surface and what lies in it.
#include "fill_cavity.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>
#include <set>

#include "isolated_process.hpp"
#include "octafield/error.hpp"
#include "octafield/volume/tet_domain.hpp"
#include "tet_fixtures.hpp"

namespace octafield::volume {
namespace {

using testing::kuhn_grid;

Cavity all_of(const TetDomain& domain) {
    Cavity cavity;
    cavity.mesh = domain.surface().mesh;
    for (const Index t : domain.sides().col(1)) cavity.two_sided.push_back(t >= 0);
    cavity.edge_length = 1;
    return cavity;
}

double volume(const TetMesh& mesh) {
    double sum = 0;
    for (const auto tet : mesh.tets.rowwise()) {
        const auto edge = [&](int k) -> Eigen::Vector3d {
            return mesh.vertices.row(tet[k]) - mesh.vertices.row(tet[0]);
        };
        const double six = edge(1).cross(edge(2)).dot(edge(3));
        EXPECT_GT(six, 0);
        sum += six / 6;
    }
    return sum;
}

void expect_all_vertices_used(const TetMesh& mesh) {
    std::set<Index> used;
    for (const Index v : mesh.tets.reshaped()) used.insert(v);
    EXPECT_EQ(static_cast<Eigen::Index>(used.size()), mesh.vertices.rows());
}

TetMesh hollow_cube(double h = 1, const Eigen::Vector3d& origin = Eigen::Vector3d::Zero()) {
    return kuhn_grid(5, 5, 5, h, origin, [](int i, int j, int k) {
        return std::min({i, j, k}) == 0 || std::max({i, j, k}) == 4;
    });
}

TEST(FillCavity, CavitiesOfTheDomainStayEmpty) {
    const TetMesh tets = fill_cavity(all_of(hollow_cube()), {});
    EXPECT_NEAR(volume(tets), 125 - 27, 1e-9);
    expect_all_vertices_used(tets);
    for (const auto tet : tets.tets.rowwise()) {
        const Eigen::Vector3d middle = tets.vertices(tet, Eigen::all).colwise().mean().transpose();
        EXPECT_GT((middle - Eigen::Vector3d::Constant(2.5)).cwiseAbs().maxCoeff(), 1.5);
    }
}

TEST(FillCavity, CubesThatTouchAtEdgesAreFilledAndNotWhatTheyEnclose) {
    const TetMesh checkers =
        kuhn_grid(3, 3, 3, 1, Eigen::Vector3d::Zero(), [](int i, int j, int k) { return (i + j + k) % 2 == 1; });
    EXPECT_NEAR(volume(fill_cavity(all_of(checkers), {})), 13, 1e-9);
}

TEST(FillCavity, TheSameInAnyUnitAndFarFromTheOrigin) {
    for (const double h : {1e-6, 1e6}) {
        const TetMesh mesh = hollow_cube(h, Eigen::Vector3d(100, -200, 300) * h);
        Cavity cavity = all_of(mesh);
        cavity.edge_length = h;
        const TetMesh tets = fill_cavity(cavity, {});
        EXPECT_NEAR(volume(tets) / (h * h * h), 98, 1e-6);
        EXPECT_EQ(tets.vertices.topRows(cavity.mesh.vertices.rows()), cavity.mesh.vertices);
    }
}

TEST(FillCavity, WorkThatDoesNotEndIsEnded) {
    const IsolatedOutcome endless = run_isolated(
        [](const Emit&) {
            end_after(1);
            while (std::clock() >= 0) {
            }
        },
        "", {});
    EXPECT_TRUE(endless.out_of_time && !endless.finished);
    const IsolatedOutcome soon = run_isolated([](const Emit&) { end_after(1); }, "", {});
    EXPECT_TRUE(!soon.out_of_time && soon.finished);
}

TEST(FillCavity, BothSidesOfATriangleBetweenRegionsAreFilled) {
    const TetMesh mesh = kuhn_grid(4, 2, 2, 1);
    std::vector<Index> regions;
    for (const auto tet : mesh.tets.rowwise())
        regions.push_back(mesh.vertices(tet, Eigen::all).colwise().mean()[0] > 2 ? 7 : 3);
    const TetDomain domain(mesh, regions);
    const Cavity cavity = all_of(domain);
    const TetMesh tets = fill_cavity(cavity, {});
    EXPECT_NEAR(volume(tets), 16, 1e-9);
    std::multiset<std::set<Index>> faces;
    for (const auto tet : tets.tets.rowwise())
        for (int k = 0; k < 4; ++k) faces.insert({tet[(k + 1) % 4], tet[(k + 2) % 4], tet[(k + 3) % 4]});
    for (Index t = 0; t < cavity.mesh.triangles.rows(); ++t) {
        const auto row = cavity.mesh.triangles.row(t);
        EXPECT_EQ(faces.count({row[0], row[1], row[2]}), cavity.two_sided[t] ? 2u : 1u);
    }
}

TEST(FillCavity, ASurfaceThatIsOpenOrInsideOutIsNotFilled) {
    for (const bool open : {true, false}) {
        Cavity cavity = all_of(kuhn_grid(2, 2, 2, 1));
        if (open) {
            cavity.mesh.triangles.conservativeResize(cavity.mesh.triangles.rows() - 1, 3);
            cavity.two_sided.pop_back();
        } else {
            cavity.mesh.triangles.col(0).swap(cavity.mesh.triangles.col(1));
        }
        try {
            fill_cavity(cavity, {});
            FAIL() << "filled";
        } catch (const GeometryError& error) {
            EXPECT_EQ(error.kind(), "tetgen_failed");
        }
    }
}

TEST(FillCavity, TetsInsideAreThoseOnTheInnerSideOrNoneWhereATriangleIsMissing) {
    const TetMesh mesh = kuhn_grid(3, 3, 3, 1);
    const TetMesh inner =
        kuhn_grid(3, 3, 3, 1, Eigen::Vector3d::Zero(), [](int i, int j, int k) { return i == 1 && j == 1 && k == 1; });
    surface::TriangleMesh cube = boundary_surface(inner).mesh;
    const auto same_in_mesh = [&](Index v) {
        for (Index w = 0; w < mesh.vertices.rows(); ++w)
            if (mesh.vertices.row(w) == cube.vertices.row(v)) return w;
        return Index(-1);
    };
    for (Index& v : cube.triangles.reshaped()) v = same_in_mesh(v);
    cube.vertices = mesh.vertices;
    std::vector<std::uint8_t> one_sided(cube.triangles.rows(), 0);
    const std::vector<Index> found = tets_inside(mesh, cube, one_sided);
    ASSERT_EQ(found.size(), 6u);
    for (const Index t : found)
        EXPECT_TRUE(mesh.vertices(mesh.tets.row(t), Eigen::all)
                        .isApprox(mesh.vertices(mesh.tets.row(t), Eigen::all).cwiseMax(1).cwiseMin(2)));
    cube.triangles.conservativeResize(cube.triangles.rows() + 1, 3);
    cube.triangles.bottomRows(1) << 0, 1, 2;
    one_sided.push_back(0);
    EXPECT_TRUE(tets_inside(mesh, cube, one_sided).empty());
}

}  // namespace
}  // namespace octafield::volume
