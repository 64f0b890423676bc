#include "octafield/volume/feature_alignment.hpp"

#include <gtest/gtest.h>

#include "octafield/error.hpp"
#include "tet_fixtures.hpp"

namespace octafield::volume {
namespace {

using frames::Quaternion;
using frames::Vector3;
using testing::kuhn_cube;
using testing::sample;

struct CubeFeatures {
    TetMesh mesh = kuhn_cube(4);
    BoundarySurface boundary = boundary_surface(mesh);
    surface::FeatureGraph features = surface::detect_features(boundary.mesh);
    TetDomain domain = TetDomain(mesh).with_features(features);
    Quaternions turned(double angle) const {
        return sample(mesh, [=](const Vector3&) { return frames::exp({0, 0, angle}); });
    }
};

TEST(FeatureAlignment, TangentsRunAlongTheEdgesOfACube) {
    const CubeFeatures cube;
    const FeatureTangents found = feature_tangents(cube.domain);
    EXPECT_EQ(found.vertex.size(), 12u * 3 + 8 * 3);  // 3 vertices inside each edge, 3 edges at each corner
    EXPECT_TRUE(std::is_sorted(found.vertex.begin(), found.vertex.end()));
    for (Eigen::Index i = 0; i < found.tangent.rows(); ++i)
        EXPECT_NEAR(found.tangent.row(i).cwiseAbs().maxCoeff(), 1, 1e-15);
}

TEST(FeatureAlignment, IsTheAngleFromTheTangentToTheNearestAxis) {
    const CubeFeatures cube;
    const FeatureTangents found = feature_tangents(cube.domain);
    for (const double angle : {0.0, 1e-9, 0.1, 0.7, 1.5}) {
        const Eigen::VectorXd angles = feature_alignment_angles(cube.domain, cube.turned(angle));
        ASSERT_EQ(angles.size(), found.tangent.rows());
        const double expected = std::min(angle, std::abs(std::acos(0.0) - angle));
        for (Eigen::Index i = 0; i < angles.size(); ++i)
            EXPECT_NEAR(angles[i], std::abs(found.tangent(i, 2)) > 0.5 ? 0 : expected, 1e-15);
    }
}

TEST(FeatureAlignment, OfASmoothSurfaceThereIsNone) {
    const CubeFeatures cube;
    EXPECT_EQ(feature_alignment_angles(cube.mesh, cube.turned(0.3)).size(), 0);
}

TEST(FeatureAlignment, BadInputIsRefused) {
    const CubeFeatures cube;
    EXPECT_THROW(feature_alignment_angles(cube.domain, Quaternions::Zero(3, 4)), InvalidInput);
}

}  // namespace
}  // namespace octafield::volume
