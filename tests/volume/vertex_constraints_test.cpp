#include "octafield/volume/vertex_constraints.hpp"

#include <gtest/gtest.h>

#include "octafield/error.hpp"
#include "octafield/frames/octahedral_group.hpp"
#include "octafield/volume/frame_field.hpp"
#include "tet_fixtures.hpp"

namespace octafield::volume {
namespace {

using frames::Quaternion;
using frames::Vector3;

struct CubeConstraints {
    TetMesh mesh = testing::kuhn_cube(4);
    BoundarySurface boundary = boundary_surface(mesh);
    surface::FeatureGraph features = surface::detect_features(boundary.mesh);
    BoundaryConstraints base = boundary_constraints(
        TetDomain(mesh, {}, features),
        Eigen::RowVector3d(0.3, 0.5, 0.8).normalized().replicate(boundary.mesh.vertices.rows(), 1));
    Index at(double x, double y, double z) const {
        Index nearest = 0;
        (mesh.vertices.rowwise() - Eigen::RowVector3d(x, y, z)).rowwise().norm().minCoeff(&nearest);
        return nearest;
    }
};

std::string kind_of(const BoundaryConstraints& base, const VertexConstraints& given) {
    try {
        with_constraints(base, given);
    } catch (const InvalidInput& error) {
        return error.kind();
    }
    return "no error";
}

TEST(VertexConstraints, HoldInsideTheVolume) {
    const CubeConstraints cube;
    const Index a = cube.at(0.5, 0.5, 0.5), b = cube.at(0.25, 0.5, 0.75);
    const Quaternion turned = frames::exp({0.2, -0.3, 0.1});
    const Vector3 axis = Vector3(1, 2, 3).normalized();
    VertexConstraints given{.vertices = {a, b},
                            .kinds = {VertexConstraint::fixed, VertexConstraint::axis},
                            .axes = Points::Zero(2, 3),
                            .frames = Quaternions::Zero(2, 4)};
    given.frames.row(0) = frames::to_wxyz(turned).transpose();
    given.axes.row(1) = 5 * axis.transpose();
    const BoundaryConstraints held = with_constraints(cube.base, given);
    const Quaternions field = frame_field(cube.mesh, held).smooth.frames;
    EXPECT_LT(frames::distance(frames::from_wxyz(field.row(a)), turned), 1e-7);
    const frames::Matrix3 axes = frames::from_wxyz(field.row(b)).toRotationMatrix();
    EXPECT_NEAR((axes.transpose() * axis).cwiseAbs().maxCoeff(), 1, 1e-12);
    for (std::size_t v = 0; v < held.kind.size(); ++v)
        if (static_cast<Index>(v) != a && static_cast<Index>(v) != b) {
            EXPECT_EQ(held.kind[v], cube.base.kind[v]);
            EXPECT_EQ(held.frames.row(v), cube.base.frames.row(v));
        }
}

TEST(VertexConstraints, TakeThePlaceOfThoseOfTheBoundary) {
    const CubeConstraints cube;
    BoundaryConstraints base = cube.base;
    const Index corner = cube.at(0, 0, 0), side = cube.at(0.5, 0.5, 0);
    base.kind[corner] = VertexConstraint::free;
    base.released_corners = {corner};
    const VertexConstraints given{.vertices = {side, corner},
                                  .kinds = {VertexConstraint::free, VertexConstraint::axis},
                                  .axes = Eigen::RowVector3d(0, 0, 1e-300).replicate(2, 1),
                                  .frames = {}};
    const BoundaryConstraints held = with_constraints(base, given);
    EXPECT_EQ(held.kind[side], VertexConstraint::free);
    EXPECT_TRUE(held.axis.row(side).isZero(0));
    EXPECT_EQ(held.kind[corner], VertexConstraint::axis);
    EXPECT_NEAR(held.axis(corner, 2), 1, 1e-15);
    EXPECT_TRUE(held.released_corners.empty());
}

TEST(VertexConstraints, BadOnesAreRefusedWithTheirKind) {
    const CubeConstraints cube;
    const auto axis = VertexConstraint::axis, fixed = VertexConstraint::fixed, free = VertexConstraint::free;
    EXPECT_EQ(kind_of(cube.base, {{0, 1}, {free}, {}, {}}), "wrong_size");
    EXPECT_EQ(kind_of(cube.base, {{125}, {free}, {}, {}}), "index_out_of_range");
    EXPECT_EQ(kind_of(cube.base, {{-1}, {free}, {}, {}}), "index_out_of_range");
    EXPECT_EQ(kind_of(cube.base, {{3, 3}, {free, free}, {}, {}}), "repeated_value");
    EXPECT_EQ(kind_of(cube.base, {{3}, {axis}, {}, {}}), "zero_axis");
    EXPECT_EQ(kind_of(cube.base, {{3}, {axis}, Points::Zero(1, 3), {}}), "zero_axis");
    EXPECT_EQ(kind_of(cube.base, {{3}, {fixed}, {}, {}}), "not_unit");
    EXPECT_EQ(kind_of(cube.base, {{3}, {fixed}, {}, Quaternions::Constant(1, 4, 1)}), "not_unit");
    EXPECT_EQ(kind_of(cube.base, {}), "no error");
}

}  // namespace
}  // namespace octafield::volume
