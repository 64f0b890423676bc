#include "octafield/volume/locking.hpp"
#include "octafield/volume/singular_split.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "field_fixtures.hpp"
#include "octafield/frames/quaternion.hpp"
#include "octafield/volume/tet_singularities.hpp"
#include "tet_fixtures.hpp"

namespace octafield::volume {
namespace {

using Row = std::array<Index, 3>;

// Triangles of the boundary by tet-mesh vertices, each rotated to begin with its lowest: orientation stays.
std::set<Row> boundary_triangles(const TetMesh& mesh) {
    const BoundarySurface boundary = boundary_surface(mesh);
    std::set<Row> triangles;
    for (const auto triangle : boundary.mesh.triangles.rowwise()) {
        Row row;
        for (int k = 0; k < 3; ++k) row[k] = boundary.vertex_map[triangle[k]];
        std::rotate(row.begin(), std::min_element(row.begin(), row.end()), row.end());
        triangles.insert(row);
    }
    return triangles;
}

// All tets of one cell have their vertices on the boundary, and so have most near the edges of a bar.
class Locking : public ::testing::TestWithParam<std::array<int, 3>> {
protected:
    TetMesh mesh = testing::kuhn_grid(GetParam()[0], GetParam()[1], GetParam()[2], 0.37, {5, -3, 2});
    LockingSplit split = split_locking(mesh);
};

TEST_P(Locking, NothingIsLeftThatJoinsTheBoundaryToItself) {
    EXPECT_TRUE(split.left.empty());
    const LockingElements after = find_locking(split.mesh);
    EXPECT_TRUE(after.tets.empty());
    EXPECT_EQ(after.edges.rows(), 0);
    EXPECT_EQ(after.triangles.rows(), 0);
}

TEST_P(Locking, BoundaryAndVolumeStayAndEveryTetIsPartOfItsParent) {
    EXPECT_EQ(boundary_triangles(split.mesh), boundary_triangles(mesh));
    EXPECT_EQ(split.mesh.vertices.topRows(mesh.vertices.rows()), mesh.vertices);
    EXPECT_EQ(split.added_vertices, split.mesh.vertices.rows() - mesh.vertices.rows());
    const Eigen::VectorXd before = tet_volumes(mesh), after = tet_volumes(split.mesh);
    EXPECT_GT(after.minCoeff(), 0);
    Eigen::VectorXd sums = Eigen::VectorXd::Zero(before.size());
    for (Eigen::Index t = 0; t < after.size(); ++t) sums[split.parent[t]] += after[t];
    EXPECT_LT((sums - before).cwiseAbs().maxCoeff(), 1e-14);
}

INSTANTIATE_TEST_SUITE_P(Grids, Locking,
                         ::testing::Values(std::array{1, 1, 1}, std::array{4, 1, 1}, std::array{3, 3, 1},
                                           std::array{2, 2, 2}, std::array{5, 4, 3}));

TEST(FindLocking, CountsThoseOfOneCell) {  // six tets round one diagonal
    const TetMesh cell = testing::kuhn_cube(1);
    const LockingElements found = find_locking(cell);
    EXPECT_EQ(found.tets.size(), 6u);
    ASSERT_EQ(found.edges.rows(), 1);
    EXPECT_NEAR((cell.vertices.row(found.edges(0, 0)) - cell.vertices.row(found.edges(0, 1))).norm(), std::sqrt(3),
                1e-15);
    EXPECT_EQ(found.triangles.rows(), 0);
    EXPECT_EQ(split_locking(cell).mesh.tets.rows(), 12);
}

TEST(FindLocking, CountsATetAloneAndATriangleBetweenTwo) {
    TetMesh pair{Points(5, 3), Tets(2, 4)};
    pair.vertices << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, -1;
    pair.tets << 0, 1, 2, 3, 0, 2, 1, 4;
    const LockingElements found = find_locking(pair);
    EXPECT_EQ(found.tets.size(), 2u);
    EXPECT_EQ(found.edges.rows(), 0);
    EXPECT_EQ(found.triangles.rows(), 1);
    EXPECT_EQ(split_locking(pair).mesh.tets.rows(), 6);  // three on each side of the triangle

    const TetMesh alone{pair.vertices.topRows(4), pair.tets.topRows(1)};
    const LockingSplit split = split_locking(alone);
    EXPECT_EQ(split.mesh.tets.rows(), 4);
    EXPECT_TRUE(split.mesh.vertices.row(4).isApprox(Eigen::RowVector3d(0.25, 0.25, 0.25)));
}

TEST(SplitLocking, KeepsInterfacesToo) {
    const TetMesh mesh = testing::kuhn_grid(2, 2, 2, 0.5);
    std::vector<Index> regions;
    for (const auto tet : mesh.tets.rowwise()) {
        double x = 0;
        for (const Index v : tet) x += mesh.vertices(v, 0) / 4;
        regions.push_back(x < 0.5 ? 1 : 2);
    }
    const TetDomain before(mesh, regions);
    const LockingSplit split = split_locking(before);
    std::vector<Index> after_regions;
    for (const Index parent : split.parent) after_regions.push_back(regions[parent]);
    const TetDomain after(split.mesh, after_regions);
    EXPECT_EQ(after.interface_triangles(), before.interface_triangles());
    EXPECT_EQ(after.surface().vertex_map, before.surface().vertex_map);
    EXPECT_TRUE(find_locking(after).tets.empty());
    EXPECT_FALSE(find_locking(before).tets.empty());
}

TEST(SplitLocking, LeavesAMeshWithoutSuchTetsAsItIs) {
    // Every tet of a ball of cells round one vertex has it.
    TetMesh star{Points(7, 3), Tets(8, 4)};
    star.vertices << 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1;
    int t = 0;
    for (const int x : {1, 2})
        for (const int y : {3, 4})
            for (const int z : {5, 6}) {
                star.tets.row(t) << 0, x, y, z;
                if ((x + y + z) % 2 == 0) std::swap(star.tets(t, 2), star.tets(t, 3));
                ++t;
            }
    const LockingSplit split = split_locking(star);
    EXPECT_EQ(split.mesh.tets, star.tets);
    EXPECT_EQ(split.added_vertices, 0);
    EXPECT_TRUE(split.found.tets.empty());
}

// Two curves of valence 3 and 5 side by side, which zigzag, and frames that lean: many edges join singular vertices.
class BetweenSingular : public ::testing::Test {
protected:
    using EdgeSet = std::set<std::array<Index, 2>>;

    static EdgeSet joining(const TetMesh& mesh, const SingularEdges& singular) {
        std::set<Index> on_singular;
        EdgeSet kept, found;
        for (const SingularEdge& e : singular.edges) {
            on_singular.insert({e.a, e.b});
            kept.insert({e.a, e.b});
        }
        const BoundarySurface surface = boundary_surface(mesh);
        for (const auto t : surface.mesh.triangles.rowwise())
            for (int k = 0; k < 3; ++k) {
                const auto [low, high] = std::minmax({surface.vertex_map[t[k]], surface.vertex_map[t[(k + 1) % 3]]});
                kept.insert({low, high});
            }
        for (const auto t : mesh.tets.rowwise())
            for (int i = 0; i < 4; ++i)
                for (int j = 0; j < 4; ++j)
                    if (t[i] < t[j] && on_singular.contains(t[i]) && on_singular.contains(t[j]) &&
                        !kept.contains({t[i], t[j]}))
                        found.insert({t[i], t[j]});
        return found;
    }

    TetMesh mesh = testing::kuhn_grid(8, 6, 6, 0.15, {1, 2, -1});
    Quaternions frames = testing::sample_in_tets(mesh, [](const frames::Vector3& x) {
        const auto angle = [&](double at) { return std::atan2(x.y() - 2.41 - 0.5 * (x.z() + 1), x.x() - at); };
        return frames::exp({0.1, -0.2, 0.1}) * frames::exp({0, 0, (angle(1.52) - angle(1.73)) / 4});
    });
    SingularEdges before = singular_edges(mesh, frames);
    SingularSplit split = split_between_singular(mesh, frames);
    Quaternions of_children = frames(split.parent, Eigen::all);
    SingularEdges after = singular_edges(split.mesh, of_children);
};

TEST_F(BetweenSingular, NoEdgeInsideIsLeftThatJoinsSingularVerticesWithoutBeingSingular) {
    EXPECT_GT(joining(mesh, before).size(), 3u);
    EXPECT_EQ(joining(mesh, before).size(), static_cast<std::size_t>(split.edges.rows()));
    EXPECT_EQ(split.left.rows(), 0);
    EXPECT_TRUE(joining(split.mesh, after).empty());
    EXPECT_EQ(split.added_vertices, split.edges.rows());
}

TEST_F(BetweenSingular, TheSingularEdgesAndTheSurfaceStay) {
    ASSERT_EQ(after.edges.size(), before.edges.size());
    for (std::size_t i = 0; i < before.edges.size(); ++i) {
        EXPECT_EQ(after.edges[i].a, before.edges[i].a);
        EXPECT_EQ(after.edges[i].b, before.edges[i].b);
        EXPECT_EQ(after.edges[i].quarter_turns, before.edges[i].quarter_turns);
        EXPECT_EQ(after.edges[i].valence, before.edges[i].valence);
    }
    EXPECT_EQ(after.vertices, before.vertices);
    EXPECT_EQ(after.graph.curves, before.graph.curves);
    EXPECT_EQ(boundary_triangles(split.mesh), boundary_triangles(mesh));
}

TEST_F(BetweenSingular, EveryTetIsPartOfItsParent) {
    const Eigen::VectorXd volumes = tet_volumes(split.mesh), old = tet_volumes(mesh);
    EXPECT_GT(volumes.minCoeff(), 0);
    Eigen::VectorXd sums = Eigen::VectorXd::Zero(old.size());
    for (Eigen::Index t = 0; t < volumes.size(); ++t) sums[split.parent[t]] += volumes[t];
    EXPECT_LT((sums - old).cwiseAbs().maxCoeff(), 1e-14);
}

}  // namespace
}  // namespace octafield::volume
