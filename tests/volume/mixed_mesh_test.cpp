#include "octafield/volume/mixed_mesh.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <random>

#include "octafield/error.hpp"

namespace octafield::volume {
namespace {

using Vector = Eigen::Vector3d;

// A unit cube, a pyramid on its top, a wedge at its side x = 1, a tet on the pyramid's face towards the wedge: one cell
// of each kind, and every kind of inner face.
MixedMesh one_of_each() {
    MixedMesh mesh;
    mesh.vertices.resize(12, 3);
    mesh.vertices << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0,  //
        0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1,               //
        0.5, 0.5, 1.7,                                    // apex
        2, 0, 0.5, 2, 1, 0.5,                             // edge of the wedge
        1.5, 0.5, 1.5;                                    // of the tet
    mesh.tets.resize(1, 4);
    mesh.tets << 5, 6, 8, 11;
    mesh.hexahedra.resize(1, 8);
    mesh.hexahedra << 0, 1, 2, 3, 4, 5, 6, 7;
    mesh.wedges.resize(1, 6);
    mesh.wedges << 1, 5, 9, 2, 6, 10;
    mesh.pyramids.resize(1, 5);
    mesh.pyramids << 4, 5, 6, 7, 8;
    const auto p = [&](int k) { return Vector(mesh.vertices.row(mesh.tets(0, k))); };
    if ((p(1) - p(0)).cross(p(2) - p(0)).dot(p(3) - p(0)) < 0) std::swap(mesh.tets(0, 0), mesh.tets(0, 1));
    return mesh;
}

// Kinds and cells, in their order.
std::vector<std::pair<std::string, std::vector<Index>>> defects(const MixedMesh& mesh) {
    std::vector<std::pair<std::string, std::vector<Index>>> found;
    for (const CellDefect& defect : find_cell_defects(mesh)) found.emplace_back(defect.kind, defect.cells);
    return found;
}

using Found = std::vector<std::pair<std::string, std::vector<Index>>>;

TEST(MixedMesh, CellsThatMatchAreValidAndTheirBoundaryClosesRoundTheirVolume) {
    const MixedMesh mesh = one_of_each();
    EXPECT_EQ(defects(mesh), Found{});
    require_valid(mesh);
    const CellBoundary found = cell_boundary(mesh);
    surface::require_valid(found.mesh);
    EXPECT_EQ(found.mesh.quads.rows(), 4 + 2);          // of cube and wedge
    EXPECT_EQ(found.mesh.triangles.rows(), 3 + 2 + 3);  // of pyramid, wedge and tet
    EXPECT_EQ(found.vertex_map.size(), 12u);
    const Eigen::VectorXd volumes = cell_volumes(mesh);
    EXPECT_NEAR(volumes[1], 1, 1e-14);
    EXPECT_NEAR(volumes[2], 0.5, 1e-14);
    EXPECT_NEAR(volumes[3], 0.7 / 3, 1e-14);
    EXPECT_NEAR(volumes.sum(), surface::signed_volume(surface::split_quads(found.mesh)), 1e-14);
    for (Index f = 0; f < found.mesh.face_count(); ++f) {
        EXPECT_GE(found.cells[f], 0);
        EXPECT_LT(found.cells[f], 4);
    }
}

TEST(MixedMesh, DefectsAreNamedWithTheirCells) {
    const MixedMesh sound = one_of_each();
    MixedMesh mesh = sound;
    EXPECT_EQ(defects(MixedMesh{}), (Found{{"empty", {}}}));
    mesh.wedges(0, 2) = 12;
    EXPECT_EQ(defects(mesh), (Found{{"index_out_of_range", {2}}}));
    EXPECT_THROW(scaled_jacobians(mesh), GeometryError);
    EXPECT_THROW(cell_boundary(mesh), GeometryError);
    mesh = sound;
    mesh.vertices(8, 0) = std::numeric_limits<double>::quiet_NaN();
    mesh.hexahedra(0, 3) = 2;
    EXPECT_EQ(defects(mesh), (Found{{"non_finite_vertex", {0, 3}}, {"repeated_vertex", {1}}}));
    mesh = sound;
    mesh.vertices.row(8) << 0.5, 0.5, 0.9;  // the apex inside the cube
    EXPECT_EQ(defects(mesh), (Found{{"inverted_cell", {3}}}));
    try {
        require_valid(mesh);
        FAIL();
    } catch (const GeometryError& error) {
        EXPECT_EQ(error.kind(), "inverted_cell");
        EXPECT_EQ(error.elements(), std::vector<Index>{3});
    }
}

TEST(MixedMesh, AHexahedronWithOneInvertedCornerOfEightIsFound) {
    for (int corner = 0; corner < 8; ++corner) {
        MixedMesh mesh = one_of_each();
        mesh.hexahedra.conservativeResize(1, 8);
        mesh.tets.resize(0, 4);
        mesh.wedges.resize(0, 6);
        mesh.pyramids.resize(0, 5);
        EXPECT_EQ(defects(mesh), Found{});
        const Vector middle(0.5, 0.5, 0.5), at = mesh.vertices.row(corner);
        mesh.vertices.row(corner) = middle + 0.5 * (middle - at);  // past the plane of its neighbours
        EXPECT_EQ(defects(mesh), (Found{{"inverted_cell", {0}}})) << corner;
        EXPECT_LE(scaled_jacobians(mesh)[0], 0) << corner;
    }
}

TEST(MixedMesh, FacesThatDoNotMatchAreFound) {
    MixedMesh mesh = one_of_each();
    mesh.pyramids.resize(0, 5);  // two tets in its place
    mesh.tets.resize(2, 4);
    mesh.tets << 4, 5, 6, 8, 4, 6, 7, 8;
    EXPECT_EQ(defects(mesh), (Found{{"mismatched_face", {0, 1, 2}}}));

    mesh = one_of_each();
    mesh.hexahedra.conservativeResize(2, 8);
    mesh.hexahedra.row(1) = mesh.hexahedra.row(0);
    EXPECT_EQ(defects(mesh), (Found{{"crowded_face", {1, 2, 3, 4}}, {"folded_cell", {1, 2}}}));

    mesh = one_of_each();
    mesh.pyramids.row(0) << 4, 6, 5, 7, 8;  // crosses itself
    const Found found = defects(mesh);
    ASSERT_FALSE(found.empty());
    EXPECT_EQ(found[0], (std::pair<std::string, std::vector<Index>>("inverted_cell", {3})));
    EXPECT_EQ(found[1], (std::pair<std::string, std::vector<Index>>("twisted_face", {1, 3})));

    mesh = one_of_each();
    mesh.tets.conservativeResize(2, 4);  // a second tet on the same side of the first one's face
    mesh.tets.row(1) = mesh.tets.row(0);
    mesh.vertices.conservativeResize(13, 3);
    mesh.vertices.row(12) << 1.6, 0.5, 1.6;
    mesh.tets(1, 3) = 12;
    mesh.pyramids.resize(0, 5);
    EXPECT_EQ(defects(mesh), (Found{{"folded_cell", {0, 1}}}));
}

TEST(MixedMesh, TheBestShapesHaveScaledJacobianOne) {
    MixedMesh mesh = one_of_each();
    const double h = std::sqrt(3.0) / 2;
    mesh.vertices.resize(8 + 5 + 6 + 4, 3);
    mesh.vertices << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1,  //
        0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.5, 0.5, std::sqrt(0.5),                         //
        0, 0, 0, 1, 0, 0, 0.5, h, 0, 0, 0, 7, 1, 0, 7, 0.5, h, 7,                             //
        0, 0, 0, 1, 0, 0, 0.5, h, 0, 0.5, h / 3, std::sqrt(2.0 / 3);
    mesh.hexahedra << 0, 1, 2, 3, 4, 5, 6, 7;
    mesh.pyramids << 8, 9, 10, 11, 12;
    mesh.wedges << 13, 14, 15, 16, 17, 18;
    mesh.tets << 19, 20, 21, 22;
    for (const double quality : scaled_jacobians(mesh)) EXPECT_NEAR(quality, 1, 1e-14);
    mesh.vertices *= 1e-7;
    for (const double quality : scaled_jacobians(mesh)) EXPECT_NEAR(quality, 1, 1e-14);
}

// The map of a hexahedron at (u, v, w) in the unit cube, and the determinant of its derivative.
double determinant(const Rows<double, 3>& p, double u, double v, double w) {
    Eigen::Matrix3d derivative = Eigen::Matrix3d::Zero();
    for (int k = 0; k < 8; ++k) {
        const bool x = k % 4 == 1 || k % 4 == 2, y = k % 4 >= 2, z = k >= 4;
        const double a = x ? u : 1 - u, b = y ? v : 1 - v, c = z ? w : 1 - w;
        const Eigen::RowVector3d slope((x ? 1 : -1) * b * c, (y ? 1 : -1) * a * c, (z ? 1 : -1) * a * b);
        derivative += p.row(k).transpose() * slope;
    }
    return derivative.determinant();
}

TEST(MixedMesh, VolumesAreTheIntegralsOfTheirMaps) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> jitter(-0.3, 0.3);
    MixedMesh mesh = one_of_each();
    mesh.tets.resize(0, 4);
    mesh.wedges.resize(0, 6);
    mesh.pyramids.resize(0, 5);
    mesh.vertices.conservativeResize(8, 3);
    mesh.vertices = mesh.vertices.unaryExpr([&](double x) { return x + jitter(random); }).eval();
    double integral = 0;  // Gauss' rule of two points, exact for squares
    const double low = 0.5 - std::sqrt(1.0 / 12), high = 1 - low;
    for (const double u : {low, high})
        for (const double v : {low, high})
            for (const double w : {low, high}) integral += determinant(mesh.vertices, u, v, w) / 8;
    EXPECT_NEAR(cell_volumes(mesh)[0], integral, 1e-14);
}

}  // namespace
}  // namespace octafield::volume
