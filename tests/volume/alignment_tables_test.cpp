// Axes that the surface and its feature curves hold.
#include "octafield/volume/alignment_tables.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "field_fixtures.hpp"
#include "octafield/error.hpp"
#include "tet_fixtures.hpp"

namespace octafield::volume {
namespace {

using frames::Quaternion;
using frames::Vector3;
using testing::centroid;
using testing::kuhn_cube;
using testing::kuhn_grid;
using testing::sample_in_tets;

Quaternions constant(const TetMesh& mesh, const Vector3& turn) {
    return sample_in_tets(mesh, [&](const Vector3&) { return frames::exp(turn); });
}

Vector3 direction(const CombedField& combed, Index tet, Index axis) {
    return frames::from_wxyz(combed.frames.row(tet)) *
           Vector3((axis > 0 ? 1.0 : -1.0) * Vector3::Unit(std::abs(axis) - 1));
}

TEST(AlignmentTables, OfACubeHaveSixPatchesOfOneAxisAndTheTurnAsAngle) {
    const TetMesh mesh = kuhn_cube(3);
    const BoundarySurface surface = boundary_surface(mesh);
    const surface::FeatureGraph features = surface::detect_features(surface.mesh);
    const CombedField combed = comb(mesh, constant(mesh, {0, 0, 0.2}));
    const AlignmentTables found = alignment_tables(TetDomain(mesh, {}, features), combed);
    const Points normals = surface::triangle_normals(surface.mesh);
    EXPECT_EQ(found.patch_one_axis, std::vector<std::uint8_t>(6, 1));
    for (Eigen::Index f = 0; f < normals.rows(); ++f) {
        const Vector3 normal = normals.row(f).transpose();
        const double angle = std::abs(normal.z()) > 0.5 ? 0 : 0.2;
        EXPECT_NEAR(found.triangle_angle[f], angle, 1e-12);
        EXPECT_NEAR(direction(combed, found.triangle_tet[f], found.triangle_axis[f]).dot(normal), std::cos(angle),
                    1e-12);
        EXPECT_LT(
            (centroid(mesh, found.triangle_tet[f]).transpose() -
             Vector3(surface.mesh.vertices(surface.mesh.triangles.row(f), Eigen::all).colwise().mean()).transpose())
                .dot(normal.transpose()),
            0);
        EXPECT_EQ(found.triangle_patch[f] == found.triangle_patch[0], (normals.row(f) - normals.row(0)).norm() < 1e-9);
    }
    ASSERT_EQ(found.feature_edges.rows(), 36);
    for (Eigen::Index e = 0; e < 36; ++e) {
        const Index a = found.feature_edges(e, 0), b = found.feature_edges(e, 1), tet = found.feature_tet[e];
        const Vector3 along = (mesh.vertices.row(b) - mesh.vertices.row(a)).normalized().transpose();
        EXPECT_NEAR(found.feature_angle[e], std::abs(along.z()) > 0.5 ? 0 : 0.2, 1e-12);
        EXPECT_NEAR(direction(combed, tet, found.feature_axis[e]).dot(along), std::cos(found.feature_angle[e]), 1e-12);
        for (Index t = 0; t <= tet; ++t)
            EXPECT_EQ((mesh.tets.row(t).array() == a).any() && (mesh.tets.row(t).array() == b).any(), t == tet);
    }
}

// A line of a quarter turn through top and bottom: the cut crosses the patches, whose axis is one only up to it.
TEST(AlignmentTables, CarryTheNormalsAxisAcrossTheCut) {
    const int n = 5;
    const TetMesh mesh = kuhn_grid(n, n, n, 1.0 / n, Vector3(-0.5 + 1.137 / n, -0.5 + 0.071 / n, -0.5));
    const BoundarySurface surface = boundary_surface(mesh);
    const Points normals = surface::triangle_normals(surface.mesh);
    int crossed = 0;
    for (const double start : {0.0, 0.5, 1.0, 1.5}) {    // half turns of the direction in which the field is aligned
        const Vector3 to_x(0, std::numbers::pi / 2, 0);  // takes z to x: the matchings turn about the frame's x
        const Quaternions field = sample_in_tets(mesh, [&](const Vector3& p) {
            const Vector3 turned = frames::exp({0, 0, start * std::numbers::pi}) * p;
            return Quaternion(frames::exp({0, 0, std::atan2(turned.y(), turned.x()) / 4}) * frames::exp(to_x));
        });
        const CombedField combed = comb(mesh, field);
        const AlignmentTables found =
            alignment_tables(TetDomain(mesh, {}, surface::detect_features(surface.mesh)), combed);
        ASSERT_EQ(found.patch_one_axis.size(), 6u);
        for (Index patch = 0; patch < 6; ++patch) {
            std::set<Index> axes;
            double angle = 0;
            for (Eigen::Index f = 0; f < normals.rows(); ++f)
                if (found.triangle_patch[f] == patch) {
                    axes.insert(found.triangle_axis[f]);
                    angle = std::max(angle, found.triangle_angle[f]);
                }
            if (angle > 0.7) continue;  // near 45 degrees another axis may take over
            EXPECT_TRUE(found.patch_one_axis[patch]);
            crossed += axes.size() > 1;
        }
        // Without features all of the surface is one patch, which no one axis is normal to.
        EXPECT_EQ(alignment_tables(mesh, combed).patch_one_axis, std::vector<std::uint8_t>{0});
    }
    EXPECT_GT(crossed, 0);
}

TEST(AlignmentTables, OfARoundedFieldTellSidesThatItsNormalAxisLeaves) {
    // Turned about x by up to 120 degrees along y: the axis normal to the side z = 1 becomes another.
    const TetMesh mesh = kuhn_cube(6);
    const BoundarySurface surface = boundary_surface(mesh);
    const CombedField combed = comb(mesh, sample_in_tets(mesh, [](const Vector3& p) {
                                        return frames::exp({2 * std::numbers::pi / 3 * p.y(), 0, 0});
                                    }));
    const AlignmentTables found = alignment_tables(TetDomain(mesh, {}, surface::detect_features(surface.mesh)), combed);
    const Points normals = surface::triangle_normals(surface.mesh);
    for (Eigen::Index f = 0; f < normals.rows(); ++f)
        EXPECT_EQ(found.patch_one_axis[found.triangle_patch[f]], std::abs(normals(f, 2)) < 0.5);
}

TEST(AlignmentTables, TakeTheTetBehindAnInterface) {
    const TetMesh mesh = kuhn_cube(4);
    std::vector<Index> regions;
    for (Eigen::Index t = 0; t < mesh.tets.rows(); ++t) regions.push_back(centroid(mesh, t).x() < 0.5 ? 7 : 2);
    const TetDomain domain(mesh, regions);
    const CombedField combed = comb(mesh, constant(mesh, {0, 0, 0}));
    const AlignmentTables found = alignment_tables(domain, combed);
    for (Eigen::Index f = 0; f < domain.sides().rows(); ++f) EXPECT_EQ(found.triangle_tet[f], domain.sides()(f, 0));
    // Edges where the interface meets the boundary have three triangles and part the patches.
    EXPECT_EQ(found.patch_one_axis, (std::vector<std::uint8_t>{0, 0, 1}));
}

TEST(AlignmentTables, RefuseWhatIsOfAnotherMesh) {
    const TetMesh mesh = kuhn_cube(2), other = kuhn_cube(3);
    const CombedField combed = comb(mesh, constant(mesh, {0, 0, 0}));
    EXPECT_THROW(alignment_tables(other, combed), InvalidInput);
    CombedField broken = combed;
    broken.faces.matching.pop_back();
    EXPECT_THROW(alignment_tables(mesh, broken), InvalidInput);
    broken.faces.matching.push_back(24);
    EXPECT_THROW(alignment_tables(mesh, broken), InvalidInput);
}

}  // namespace
}  // namespace octafield::volume
