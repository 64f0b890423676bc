#include "octafield/volume/operators.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "octafield/error.hpp"
#include "octafield/frames/octahedral_group.hpp"
#include "octafield/frames/sh4.hpp"
#include "tet_fixtures.hpp"

namespace octafield::volume {
namespace {

using frames::Quaternion;
using frames::Vector3;
using testing::kuhn_cube;
using testing::sample;

// The unit cube sheared and stretched, so that no tet is right-angled.
TetMesh skewed_cube(int n) {
    TetMesh mesh = kuhn_cube(n);
    Eigen::Matrix3d map;
    map << 1.3, 0.2, -0.1, 0.4, 0.7, 0.3, 0.0, -0.2, 1.1;
    mesh.vertices = mesh.vertices * map.transpose();
    return mesh;
}

TEST(Operators, EnergyOfALinearFunctionIsHalfTheVolumeTimesItsSquaredGradient) {
    const TetMesh mesh = skewed_cube(4);
    const Vector3 g(0.3, -1.2, 2.5);
    const Eigen::VectorXd f = mesh.vertices * g;
    const double expected = g.squaredNorm() * tet_volumes(mesh).sum() / 2;
    EXPECT_NEAR(f.dot(stiffness(mesh) * f) / 2, expected, 1e-12 * expected);
}

TEST(Operators, StiffnessIsExactlySymmetricAndItsRowsSumToZero) {
    const SparseMatrix L = stiffness(skewed_cube(4));
    EXPECT_EQ((L - SparseMatrix(L.transpose())).norm(), 0);
    EXPECT_LT((L * Eigen::VectorXd::Ones(L.cols())).cwiseAbs().maxCoeff(), 1e-13 * L.norm());
}

TEST(Operators, StiffnessOfOneTetIsMinusASixthOfTheOppositeEdgeTimesTheCotangent) {
    // L_01 = -1/6 |p2 p3| cot(dihedral angle at p2 p3); an independent formula for gradients' products.
    TetMesh mesh{Points(4, 3), Tets(1, 4)};
    mesh.vertices << 0, 0, 0, 1, 0.1, 0, 0.2, 1.4, 0.1, 0.3, 0.2, 0.8;
    mesh.tets << 0, 1, 2, 3;
    const auto p = [&](int i) { return Vector3(mesh.vertices.row(i)); };
    const Vector3 edge = p(3) - p(2);
    const Vector3 n0 = edge.cross(p(0) - p(2)), n1 = edge.cross(p(1) - p(2));
    const double cotangent = n0.dot(n1) / n0.cross(n1).norm();
    EXPECT_NEAR(stiffness(mesh).coeff(0, 1), -edge.norm() * cotangent / 6, 1e-14);
}

TEST(Operators, MassIntegratesProductsOfLinearFunctionsExactly) {
    const TetMesh mesh = kuhn_cube(3);
    const Eigen::VectorXd x = mesh.vertices.col(0), y = mesh.vertices.col(1), one = Eigen::VectorXd::Ones(x.size());
    const SparseMatrix M = mass(mesh);
    EXPECT_NEAR(one.dot(M * one), 1, 1e-14);
    EXPECT_NEAR(x.dot(M * one), 0.5, 1e-14);
    EXPECT_NEAR(x.dot(M * x), 1.0 / 3, 1e-14);
    EXPECT_NEAR(x.dot(M * y), 0.25, 1e-14);
}

TEST(Operators, LumpedMassIsTheRowSumOfTheMass) {
    const TetMesh mesh = skewed_cube(3);
    const Eigen::VectorXd sums = mass(mesh) * Eigen::VectorXd::Ones(mesh.vertices.rows());
    EXPECT_LT((lumped_mass(mesh) - sums).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(Operators, EnergyOfAConstantFieldIsZero) {
    const TetMesh mesh = skewed_cube(3);
    const Quaternion q = frames::exp({0.3, 0.2, -0.9});
    EXPECT_EQ(dirichlet_energy(mesh, sample(mesh, [&](const Vector3&) { return q; })), 0);
    int i = 0;  // the same frame in other representatives
    const auto other = sample(mesh, [&](const Vector3&) { return q * frames::binary_octahedral_group()[i++ % 48]; });
    EXPECT_LT(dirichlet_energy(mesh, other), 1e-28);
}

TEST(Operators, EnergyOfAUniformTwistConvergesAtSecondOrderAndKnowsTheUnitSpeed) {
    const double k = 0.9;
    std::vector<double> errors;
    for (const int n : {3, 6, 12}) {
        const TetMesh mesh = kuhn_cube(n);
        const double energy = dirichlet_energy(mesh, sample(mesh, [&](const Vector3& x) {
                                                   return frames::exp({0, 0, k * x.z()});
                                               }));
        errors.push_back(std::abs(energy * unit_speed_factor - k * k / 2));
    }
    EXPECT_NEAR(errors[0] / errors[1], 4, 0.2);
    EXPECT_NEAR(errors[1] / errors[2], 4, 0.1);
}

TEST(Operators, EnergyIsHalfTheQuadraticFormOfTheStiffness) {
    const TetMesh mesh = skewed_cube(3);
    const auto field = sample(mesh, [](const Vector3& x) { return frames::exp(0.8 * x); });
    Eigen::MatrixXd a(field.rows(), 9);
    for (Eigen::Index v = 0; v < a.rows(); ++v)
        a.row(v) = frames::Sh4::embed(frames::from_wxyz(field.row(v))).transpose();
    const double expected = (a.transpose() * (stiffness(mesh) * a)).trace() / 2;
    EXPECT_NEAR(dirichlet_energy(mesh, field), expected, 1e-12 * expected);
}

TEST(Operators, EnergyHasTheSameBitsAtAnyThreadCount) {
    const TetMesh mesh = kuhn_cube(8);
    const auto field = sample(mesh, [](const Vector3& x) { return frames::exp({x.x() * x.y(), x.z(), 0.5 * x.x()}); });
    const double serial = dirichlet_energy(mesh, field, 1);
    for (const int threads : {2, 3, 7}) EXPECT_EQ(dirichlet_energy(mesh, field, threads), serial);
}

TEST(Operators, EnergyScalesWithLength) {
    const TetMesh mesh = kuhn_cube(4);
    const auto field = sample(mesh, [](const Vector3& x) { return frames::exp(0.8 * x); });
    const double energy = dirichlet_energy(mesh, field);
    for (const double scale : {1e-6, 1e6}) {
        const TetMesh scaled{mesh.vertices * scale, mesh.tets};
        EXPECT_NEAR(dirichlet_energy(scaled, field) / (energy * scale), 1, 1e-12);
    }
}

template <class Exception, class Call>
void expect_error(const Call& call, const std::string& kind) {
    try {
        call();
        FAIL() << "no error of kind " << kind;
    } catch (const Exception& error) {
        EXPECT_EQ(error.kind(), kind) << error.what();
    }
}

TEST(TetMeshValidation, NamesTheDefect) {
    const TetMesh good = kuhn_cube(1);
    EXPECT_NO_THROW(require_valid(good));
    expect_error<GeometryError>([] { require_valid(TetMesh{}); }, "empty");
    TetMesh bad = good;
    bad.tets(2, 1) = 8;
    expect_error<GeometryError>([&] { require_valid(bad); }, "index_out_of_range");
    expect_error<GeometryError>([&] { boundary_surface(bad); }, "index_out_of_range");
    bad = good;
    bad.vertices(3, 1) = std::nan("");
    expect_error<GeometryError>([&] { require_valid(bad); }, "non_finite_vertex");
    bad = good;
    std::swap(bad.tets(4, 0), bad.tets(4, 1));
    expect_error<GeometryError>([&] { require_valid(bad); }, "inverted_tet");
    expect_error<GeometryError>([&] { stiffness(bad); }, "inverted_tet");
}

TEST(TetMeshValidation, AVolumeThatIsRoundingIsNone) {
    TetMesh mesh;
    mesh.vertices.resize(4, 3);
    mesh.tets.resize(1, 4);
    mesh.tets << 0, 1, 2, 3;
    for (const double size : {1e-6, 1., 1e6}) {
        for (const double height : {1e-157, 1e-16, 1e-13}) {
            mesh.vertices << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, height;
            mesh.vertices *= size;
            if (height > 1e-15)
                EXPECT_NO_THROW(require_valid(mesh));
            else
                expect_error<GeometryError>([&] { require_valid(mesh); }, "inverted_tet");
        }
    }
}

TEST(TetMeshValidation, ThreeTetsOnOneTriangleAreRefused) {
    TetMesh mesh{Points(6, 3), Tets(3, 4)};
    mesh.vertices << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0.2, 0.2, 2, 0.1, 0.1, 3;
    mesh.tets << 0, 1, 2, 3, 0, 1, 2, 4, 0, 1, 2, 5;
    expect_error<GeometryError>([&] { boundary_surface(mesh); }, "non_manifold_face");
}

TEST(TetMeshValidation, FramesMustBeOneUnitQuaternionPerVertex) {
    const TetMesh mesh = kuhn_cube(2);
    Quaternions field = sample(mesh, [](const Vector3&) { return Quaternion::Identity(); });
    expect_error<InvalidInput>([&] { dirichlet_energy(mesh, field.topRows(5)); }, "wrong_size");
    field(7, 2) = 0.1;
    expect_error<InvalidInput>([&] { dirichlet_energy(mesh, field); }, "not_unit");
    field(7, 2) = std::nan("");
    expect_error<InvalidInput>([&] { dirichlet_energy(mesh, field); }, "not_unit");
}

TEST(BoundarySurface, OfACubeIsClosedOutwardAndMapsBackToTheMesh) {
    const int n = 3;
    const TetMesh mesh = kuhn_cube(n);
    const BoundarySurface boundary = boundary_surface(mesh);
    EXPECT_EQ(boundary.mesh.triangles.rows(), 12 * n * n);
    EXPECT_EQ(boundary.mesh.vertices.rows(), 6 * n * n + 2);
    EXPECT_EQ(surface::euler_characteristic(boundary.mesh), 2);
    EXPECT_NEAR(surface::signed_volume(boundary.mesh), 1, 1e-14);
    EXPECT_TRUE(std::is_sorted(boundary.vertex_map.begin(), boundary.vertex_map.end()));
    for (std::size_t b = 0; b < boundary.vertex_map.size(); ++b)
        EXPECT_EQ(boundary.mesh.vertices.row(b), mesh.vertices.row(boundary.vertex_map[b]));
}

TEST(BoundarySurface, OfACubeWithACavityHasTwoShells) {
    const TetMesh mesh = testing::kuhn_grid(3, 3, 3, 1.0, Vector3::Zero(),
                                            [](int i, int j, int k) { return i != 1 || j != 1 || k != 1; });
    const BoundarySurface boundary = boundary_surface(mesh);
    EXPECT_EQ(boundary.mesh.triangles.rows(), 12 * 9 + 12);
    EXPECT_EQ(surface::euler_characteristic(boundary.mesh), 4);
    EXPECT_NEAR(surface::signed_volume(boundary.mesh), 26, 1e-12);
}

}  // namespace
}  // namespace octafield::volume
