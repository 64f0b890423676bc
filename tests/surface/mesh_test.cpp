// Edge topology and elementary geometry against closed formulas.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mesh_fixtures.hpp"
#include "octafield/error.hpp"
#include "octafield/surface/triangle_mesh.hpp"

namespace octafield::surface {
namespace {

using namespace testing;

TEST(TriangleMesh, EulerCharacteristicsOfKnownShapes) {
    EXPECT_EQ(euler_characteristic(icosphere(2)), 2);
    EXPECT_EQ(euler_characteristic(cube_surface(3)), 2);
    EXPECT_EQ(euler_characteristic(torus(12, 7, 1, 0.4)), 0);
    EXPECT_EQ(euler_characteristic(disk(4)), 1);
}

TEST(TriangleMesh, UnusedVerticesDoNotCountForTheEulerCharacteristic) {
    TriangleMesh mesh = icosphere(1);
    mesh.vertices.conservativeResize(mesh.vertices.rows() + 5, 3);
    mesh.vertices.bottomRows(5).setZero();
    EXPECT_EQ(euler_characteristic(mesh), 2);
}

TEST(TriangleMesh, EdgeTopologyIsConsistent) {
    const TriangleMesh mesh = disk(3);
    const EdgeTopology topology = edge_topology(mesh);
    EXPECT_EQ(topology.edges.rows(), 37 + 54 - 1);
    for (Index e = 0; e < topology.edges.rows(); ++e) {
        EXPECT_LT(topology.edges(e, 0), topology.edges(e, 1));
        if (e > 0) {
            const auto before = std::pair(topology.edges(e - 1, 0), topology.edges(e - 1, 1));
            EXPECT_LT(before, std::pair(topology.edges(e, 0), topology.edges(e, 1)));
        }
    }
    int uses = 0;
    for (Index t = 0; t < mesh.triangles.rows(); ++t)
        for (int k = 0; k < 3; ++k) {
            const Index a = mesh.triangles(t, k), b = mesh.triangles(t, (k + 1) % 3), e = topology.triangle_edges(t, k);
            EXPECT_EQ(topology.edges(e, a < b ? 0 : 1), a);
            EXPECT_EQ(topology.edges(e, a < b ? 1 : 0), b);
            EXPECT_EQ(topology.edge_triangles(e, a < b ? 0 : 1), t);
            ++uses;
        }
    EXPECT_EQ((topology.edge_triangles.array() >= 0).count(), uses);
    EXPECT_EQ((topology.edge_triangles.array() < 0).count(), 18);
}

TEST(TriangleMesh, EdgeTopologyNamesTheUnsoundEdge) {
    TriangleMesh mesh = cube_surface(1);
    std::swap(mesh.triangles(0, 0), mesh.triangles(0, 1));
    try {
        edge_topology(mesh);
        FAIL() << "an inconsistent orientation passed";
    } catch (const GeometryError& error) {
        EXPECT_EQ(error.kind(), "inconsistent_orientation");
        EXPECT_EQ(error.elements().size(), 2u);
    }
    TriangleMesh fin =
        make_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}}, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}});
    try {
        edge_topology(fin);
        FAIL() << "a non-manifold edge passed";
    } catch (const GeometryError& error) {
        EXPECT_EQ(error.kind(), "non_manifold_edge");
        EXPECT_EQ(error.elements(), (std::vector<Index>{0, 1}));
    }
    fin.triangles.row(0) << 1, 1, 2;
    EXPECT_THROW(edge_topology(fin), GeometryError);
}

class MeshAtSizes : public ::testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(InputUnits, MeshAtSizes, ::testing::Values(1e-6, 1.0, 1e6));

TEST_P(MeshAtSizes, VolumeAreaAndNormalsOfTheCube) {
    const double size = GetParam();
    TriangleMesh cube = cube_surface(4);
    cube.vertices = (cube.vertices.array() + 5) * size;
    EXPECT_NEAR(signed_volume(cube), size * size * size, 1e-13 * size * size * size);
    EXPECT_NEAR(triangle_areas(cube).sum(), 6 * size * size, 1e-13 * size * size);
    EXPECT_NEAR(bounding_box_diagonal(cube.vertices), std::sqrt(3) * size, 1e-14 * size);
    EXPECT_NEAR(mean_edge_length(cube), size * (2 + std::sqrt(2)) / 12, 1e-14 * size);
    const Points normals = triangle_normals(cube);
    EXPECT_TRUE((normals.rowwise().norm().array() - 1 < 1e-14).all());
    EXPECT_NEAR(normals.cwiseAbs().rowwise().maxCoeff().minCoeff(), 1, 1e-14);
}

TEST_P(MeshAtSizes, NormalsOfTheSpherePointOutward) {
    const double size = GetParam();
    const TriangleMesh sphere = icosphere(3, size);
    const Points normals = vertex_normals(sphere);
    const Eigen::VectorXd cosines = (normals.array() * sphere.vertices.array()).rowwise().sum() / size;
    EXPECT_GT(cosines.minCoeff(), 0.999);
    const double ball = 4.0 / 3 * std::numbers::pi * size * size * size;
    EXPECT_NEAR(signed_volume(sphere), ball, 0.02 * ball);
}

TEST(TriangleMesh, TheNormalOfATriangleWithoutAreaIsZero) {
    const TriangleMesh mesh = make_mesh({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}});
    EXPECT_EQ(triangle_normals(mesh).norm(), 0);
    EXPECT_EQ(triangle_areas(mesh).sum(), 0);
}

TEST(TriangleMesh, AnEmptyMeshHasNoSize) {
    EXPECT_EQ(bounding_box_diagonal(Points(0, 3)), 0);
    EXPECT_EQ(signed_volume({}), 0);
    EXPECT_EQ(mean_edge_length({}), 0);
    EXPECT_EQ(edge_topology({}).edges.rows(), 0);
}

}  // namespace
}  // namespace octafield::surface
