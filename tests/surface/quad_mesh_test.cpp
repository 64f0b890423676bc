#include "octafield/surface/quad_mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "octafield/error.hpp"

namespace octafield::surface {
namespace {

// A house: a unit cube without its top, under a roof of two quads and two triangles.
QuadMesh house() {
    QuadMesh mesh;
    mesh.vertices.resize(10, 3);
    mesh.vertices << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1, 0.5, 0, 1.5, 0.5, 1, 1.5;
    mesh.quads.resize(7, 4);
    mesh.quads << 0, 3, 2, 1, 0, 1, 5, 4, 1, 2, 6, 5, 2, 3, 7, 6, 3, 0, 4, 7, 5, 6, 9, 8, 7, 4, 8, 9;
    mesh.triangles.resize(2, 3);
    mesh.triangles << 4, 5, 8, 6, 7, 9;
    return mesh;
}

std::pair<std::string, std::vector<Index>> refusal_of_quads(const QuadMesh& mesh, bool closed = true) {
    try {
        require_valid(mesh, closed);
    } catch (const GeometryError& error) {
        return {error.kind(), error.elements()};
    }
    return {"valid", {}};
}

using Refusal = std::pair<std::string, std::vector<Index>>;

TEST(QuadMesh, AHouseIsValidAndItsDefectsAreNamed) {
    EXPECT_EQ(refusal_of_quads(house()), Refusal("valid", {}));
    EXPECT_EQ(refusal_of_quads({}), Refusal("empty", {}));
    QuadMesh mesh = house();
    mesh.quads(0, 2) = 10;
    EXPECT_EQ(refusal_of_quads(mesh), Refusal("index_out_of_range", {2}));  // after the triangles
    EXPECT_THROW(scaled_jacobians(mesh), GeometryError);
    EXPECT_THROW(split_quads(mesh), GeometryError);
    mesh = house();
    mesh.vertices(9, 1) = INFINITY;
    EXPECT_EQ(refusal_of_quads(mesh), Refusal("non_finite_vertex", {9}));
    mesh = house();
    mesh.quads(1, 2) = 1;
    EXPECT_EQ(refusal_of_quads(mesh), Refusal("repeated_vertex", {3}));
    mesh = house();
    mesh.vertices.row(0) << 0.8, 0.8, 0;  // the floor is a dart
    EXPECT_EQ(refusal_of_quads(mesh).first, "degenerate_face");
    EXPECT_EQ(refusal_of_quads(mesh).second.front(), 2);
    mesh = house();
    mesh.triangles.row(1).reverseInPlace();
    EXPECT_EQ(refusal_of_quads(mesh), Refusal("inconsistent_orientation", {6, 7, 6, 9, 7, 9}));
    mesh = house();
    mesh.triangles.conservativeResize(1, 3);
    EXPECT_EQ(refusal_of_quads(mesh), Refusal("not_closed", {6, 7, 6, 9, 7, 9}));
    EXPECT_EQ(refusal_of_quads(mesh, false), Refusal("valid", {}));
    mesh = house();
    mesh.triangles.conservativeResize(3, 3);
    mesh.triangles.row(2) << 4, 5, 9;  // inside, from an eaves edge
    EXPECT_EQ(refusal_of_quads(mesh, false), Refusal("non_manifold_edge", {4, 5}));
}

TEST(QuadMesh, SplitAlongShorterDiagonalsItIsTheSameSurface) {
    const QuadMesh mesh = house();
    const TriangleMesh split = split_quads(mesh);
    EXPECT_EQ(split.triangles.rows(), 2 + 2 * 7);
    EXPECT_EQ(euler_characteristic(split), 2);
    EXPECT_NEAR(signed_volume(split), 1.25, 1e-14);
    QuadMesh kite;
    kite.vertices.resize(4, 3);
    kite.vertices << 0, 0, 0, 3, -1, 0, 4, 0, 0, 3, 1, 0;
    kite.quads.resize(1, 4);
    kite.quads << 0, 1, 2, 3;
    EXPECT_EQ(split_quads(kite).triangles, (Triangles{{1, 2, 3}, {1, 3, 0}}));
}

TEST(QuadMesh, SquaresAndEquilateralTrianglesHaveScaledJacobianOne) {
    QuadMesh mesh = house();
    mesh.vertices.row(8) << 0.5, 0, 1 + std::sqrt(3.0) / 2;
    const Eigen::VectorXd quality = scaled_jacobians(mesh);
    EXPECT_NEAR(quality[0], 1, 1e-14);                                    // equilateral
    EXPECT_NEAR(quality[1], 2 / std::sqrt(3.0) * std::sqrt(0.5), 1e-14);  // 45, 45, 90 degrees
    for (Index f = 2; f < 7; ++f) EXPECT_NEAR(quality[f], 1, 1e-14);
    mesh.quads.row(0) << 0, 2, 3, 1;  // crosses itself
    EXPECT_LE(scaled_jacobians(mesh)[2], 0);
}

}  // namespace
}  // namespace octafield::surface
