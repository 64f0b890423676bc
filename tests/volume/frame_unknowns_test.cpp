// Points of the model surface as unknowns: their manifolds, and that smoothing on them is the geodesic scheme.

#include "frame_unknowns.hpp"

#include <gtest/gtest.h>
#include "ceres_manifold_matchers.hpp"

#include <cmath>

#include "field_fixtures.hpp"
#include "octafield/frames/geodesic.hpp"
#include "octafield/volume/smooth.hpp"

namespace octafield::volume {
namespace {

using frames::Quaternion;
using frames::Su2;
using frames::Vector3;
using testing::row;

// All of Ceres' but the derivative of Minus off the surface, where Minus has no meaning.
template <class Manifold>
void expect_invariants(const Manifold& manifold, const Eigen::VectorXd& x, const Eigen::VectorXd& delta,
                       const Eigen::VectorXd& y) {
    using namespace ceres;  // its matchers
    EXPECT_THAT(manifold, XPlusZeroIsXAt(x, 1e-12));
    EXPECT_THAT(manifold, XMinusXIsZeroAt(x, 1e-12));
    EXPECT_THAT(manifold, MinusPlusIsIdentityAt(x, delta, 1e-10));
    EXPECT_THAT(manifold, PlusMinusIsIdentityAt(x, y, 1e-10));
    EXPECT_THAT(manifold, HasCorrectPlusJacobianAt(x, 1e-8));
    EXPECT_THAT(manifold, MinusPlusJacobianIsIdentityAt(x, 1e-10));
    EXPECT_THAT(manifold, HasCorrectRightMultiplyByPlusJacobianAt(x, 1e-10));
}

TEST(SurfaceManifold, ObeysCeresManifoldInvariants) {
    const Quaternions q = frames::random_rotations(40, 1);
    for (Eigen::Index i = 0; i + 1 < q.rows(); ++i) {
        const Vector3 w = 0.01 * Vector3(std::sin(i), std::cos(2.0 * i), 0.5);
        expect_invariants(SurfaceManifold(), Su2::embed(row(q, i)), w,
                          Su2::embed((frames::exp(Vector3(w.y(), -w.x(), w.z())) * row(q, i)).normalized()));
    }
}

TEST(SurfaceManifold, ManySteepStepsStayOnTheSurface) {
    const SurfaceManifold manifold;
    const Quaternions q = frames::random_rotations(300, 2);
    Su2::Vector h = Su2::embed(row(q, 0));
    for (Eigen::Index i = 0; i < q.rows(); ++i) {
        const Vector3 w = 0.4 * row(q, i).vec();
        Su2::Vector next;
        ASSERT_TRUE(manifold.Plus(h.data(), w.data(), next.data()));
        EXPECT_LT((Su2::embed(Su2::inverse_frame(Su2::complex(next))) - next).norm(), 1e-12);
        h = next;
    }
}

TEST(HeldSurfaceManifold, OfAnAxisObeysCeresManifoldInvariantsAndStaysOnItsCurve) {
    const Quaternions q = frames::random_rotations(40, 3);
    for (Eigen::Index i = 0; i < q.rows(); ++i) {
        const Vector3 axis = row(q, i) * Vector3::UnitY();
        const HeldSurfaceManifold<FixedAxis> manifold(FixedAxis({axis, frames::to_wxyz(row(q, i))}));
        const Su2::Vector x = Su2::embed(row(q, i));
        const Eigen::VectorXd delta = Eigen::VectorXd::Constant(1, 0.3);
        expect_invariants(manifold, x, delta, Su2::embed((frames::exp(-0.2 * axis) * row(q, i)).normalized()));
        Su2::Vector moved;
        manifold.Plus(x.data(), delta.data(), moved.data());
        for (const frames::Complex& residual : frames::Su2Axis(axis).residual(Su2::complex(moved)))
            EXPECT_LT(std::abs(residual), 1e-13);
    }
}

TEST(Su2Surface, ReachesTheMinimiserOfTheGeodesicInAsManySteps) {
    const TetMesh mesh = testing::jittered_cube(4, 0.2, 27);
    for (const VertexConstraint held : {VertexConstraint::fixed, VertexConstraint::axis}) {
        const BoundaryConstraints constraints = testing::constraints_on(mesh, held, testing::smooth_field(mesh));
        const Quaternions start = initial_frames(mesh, constraints);
        SmoothOptions options;
        options.tolerance = 1e-10;
        options.representation = "geodesic";
        const SmoothResult expected = smooth(mesh, constraints, start, options);
        options.representation = "su2_surface";
        const SmoothResult found = smooth(mesh, constraints, start, options);
        EXPECT_TRUE(found.converged);
        EXPECT_LT(testing::largest_distance(found.frames, expected.frames), 1e-4);
        EXPECT_NEAR(found.objective, expected.objective, 1e-8 * expected.objective);
        EXPECT_LE(found.iterations, expected.iterations + 2);
    }
}

}  // namespace
}  // namespace octafield::volume
