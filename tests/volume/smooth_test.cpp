#include "octafield/volume/smooth.hpp"

#include <ceres/manifold_test_utils.h>
#include <gtest/gtest.h>

#include <cmath>

#include "dirichlet_blocks.hpp"
#include "frame_manifolds.hpp"
#include "octafield/frames/octahedral_group.hpp"
#include "octafield/volume/operators.hpp"
#include "tet_fixtures.hpp"

namespace octafield::volume {
namespace {

using frames::Quaternion;
using frames::Vector3;
using testing::kuhn_cube;

// Interior vertices displaced by up to `amount` grid steps: obtuse tets, negative cotangents.
TetMesh jittered_cube(int n, double amount, std::uint64_t seed) {
    TetMesh mesh = kuhn_cube(n);
    std::mt19937_64 generator(seed);
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v)
        for (int c = 0; c < 3; ++c) {
            const double shift = amount / n * (2 * frames::uniform01(generator) - 1);
            const auto x = mesh.vertices.row(v);
            if (x.minCoeff() > 1e-9 && x.maxCoeff() < 1 - 1e-9) mesh.vertices(v, c) += shift;
        }
    return mesh;
}

BoundaryConstraints constraints_on(const TetMesh& mesh, VertexConstraint kind, const Quaternions& frames) {
    BoundaryConstraints c;
    const std::size_t n = mesh.vertices.rows();
    c.kind.assign(n, VertexConstraint::free);
    c.on_boundary.assign(n, 0);
    c.axis = Points::Zero(n, 3);
    c.frames = Quaternions::Zero(n, 4);
    c.frames.col(0).setOnes();
    for (const Index v : boundary_surface(mesh).vertex_map) {
        c.kind[v] = kind;
        c.on_boundary[v] = 1;
        c.frames.row(v) = frames.row(v);
        if (kind == VertexConstraint::axis)
            c.axis.row(v) =
                (frames::from_wxyz(frames::Vector4(frames.row(v).transpose())) * Vector3::UnitZ()).transpose();
    }
    return c;
}

// A smooth field without singularities, far from constant.
Quaternions smooth_field(const TetMesh& mesh) {
    return testing::sample(mesh, [](const Vector3& x) {
        return frames::exp({0.4 * std::sin(2 * x.y()), 0.5 * x.x() * x.z(), 0.6 * x.x() - 0.3 * x.z()});
    });
}

double largest_distance(const Quaternions& a, const Quaternions& b) {
    double largest = 0;
    for (Eigen::Index v = 0; v < a.rows(); ++v)
        largest = std::max(largest, frames::distance(frames::from_wxyz(frames::Vector4(a.row(v).transpose())),
                                                     frames::from_wxyz(frames::Vector4(b.row(v).transpose()))));
    return largest;
}

TEST(FrameManifold, ObeysCeresManifoldInvariants) {
    using namespace ceres;  // the macro names its helpers unqualified
    const FrameManifold manifold;
    const Quaternions q = frames::random_rotations(40, 1);
    for (Eigen::Index i = 0; i + 1 < q.rows(); ++i) {
        const Eigen::VectorXd x = q.row(i).transpose();
        Eigen::VectorXd y = q.row(i + 1).transpose();
        if (x.dot(y) < 0) y = -y;  // q and -q are one rotation: Plus(x, Minus(y, x)) returns the one on x's side
        const Eigen::VectorXd delta = 0.3 * Vector3(std::sin(i), std::cos(2.0 * i), 0.5);
        EXPECT_THAT_MANIFOLD_INVARIANTS_HOLD(manifold, x, delta, y, 1e-8);
    }
}

TEST(TwistManifold, ObeysCeresManifoldInvariantsAndKeepsTheAxis) {
    using namespace ceres;  // the macro names its helpers unqualified
    const Quaternions q = frames::random_rotations(40, 2);
    for (Eigen::Index i = 0; i < q.rows(); ++i) {
        const Eigen::VectorXd x = q.row(i).transpose();
        const Quaternion frame = frames::from_wxyz(frames::Vector4(x));
        const Vector3 axis = frame * Vector3::UnitY();
        const TwistManifold manifold(axis);
        const Eigen::VectorXd delta = Eigen::VectorXd::Constant(1, 0.7),
                              y = frames::to_wxyz(frames::exp(0.4 * axis) * frame);
        EXPECT_THAT_MANIFOLD_INVARIANTS_HOLD(manifold, x, delta, y, 1e-8);
        Eigen::Vector4d moved;
        manifold.Plus(x.data(), delta.data(), moved.data());
        EXPECT_LT((frames::from_wxyz(moved) * Vector3::UnitY() - axis).norm(), 1e-14);
    }
}

// Against an independent assembly: the stiffness matrix of operators.hpp.
TEST(DirichletBlocks, SumOfSquaresIsTheStiffnessFormOnObtuseMeshesToo) {
    for (const double amount : {0.0, 0.2}) {
        const TetMesh mesh = jittered_cube(4, amount, 3);
        const DirichletBlocks blocks = dirichlet_blocks(mesh);
        const SparseMatrix stiff = stiffness(mesh);
        EXPECT_EQ(blocks.tets.empty(), amount == 0);
        for (int trial = 0; trial < 5; ++trial) {
            const Eigen::VectorXd a = Eigen::VectorXd::NullaryExpr(
                mesh.vertices.rows(), [&](Eigen::Index v) { return std::sin(3.0 * v + trial); });
            double sum = 0;
            for (const auto& edge : blocks.edges) {
                EXPECT_GT(edge.weight, 0);
                sum += edge.weight * std::pow(a[edge.i] - a[edge.j], 2);
            }
            for (const auto& tet : blocks.tets) {
                Eigen::Vector4d corner;
                for (int k = 0; k < 4; ++k) corner[k] = a[tet.vertices[k]];
                sum += (tet.gradient * corner).squaredNorm();
            }
            EXPECT_NEAR(sum, a.dot(stiff * a), 1e-10 * sum);
        }
    }
}

TEST(InitialFrames, ExtendAConstantBoundaryByTheConstant) {
    const TetMesh mesh = jittered_cube(5, 0.2, 4);
    const Quaternion q = frames::exp({0.3, 0.9, -0.4});
    const Quaternions constant = testing::sample(mesh, [&](const Vector3&) { return q; });
    EXPECT_LT(largest_distance(initial_frames(mesh, constraints_on(mesh, VertexConstraint::fixed, constant)), constant),
              1e-7);
}

TEST(Smooth, ReachesZeroEnergyWhereAConstantFieldFits) {
    const TetMesh mesh = jittered_cube(5, 0.2, 5);
    const Quaternion q = frames::exp({-0.3, 0.2, 0.5});
    const Quaternions constant = testing::sample(mesh, [&](const Vector3&) { return q; });
    Quaternions start = constant;
    const Quaternions noise = frames::random_rotations(start.rows(), 6);
    for (Eigen::Index v = 0; v < start.rows(); ++v) {  // up to 0.3 rad away, in a random representative
        const Vector3 shift = 0.3 * Vector3(noise(v, 0), noise(v, 1), noise(v, 2));
        start.row(v) = frames::to_wxyz(frames::exp(shift) * q * frames::binary_octahedral_group()[v % 48]).transpose();
    }
    const SmoothResult result = smooth(mesh, constraints_on(mesh, VertexConstraint::fixed, constant), start);
    EXPECT_LT(result.energy, 1e-12 * dirichlet_energy(mesh, noise));
    EXPECT_LT(largest_distance(result.frames, constant), 1e-6);
    EXPECT_TRUE(result.converged);
}

TEST(Smooth, NeverRaisesTheEnergyAndReportsTheOneOfTheTables) {
    const TetMesh mesh = jittered_cube(5, 0.2, 7);
    const BoundaryConstraints constraints = constraints_on(mesh, VertexConstraint::fixed, smooth_field(mesh));
    const Quaternions start = frames::random_rotations(mesh.vertices.rows(), 8);
    const SmoothResult result = smooth(mesh, constraints, start);
    ASSERT_EQ(result.energy_history.size(), static_cast<std::size_t>(result.iterations) + 1);
    for (std::size_t i = 1; i < result.energy_history.size(); ++i)
        EXPECT_LE(result.energy_history[i], result.energy_history[i - 1] * (1 + 1e-12));
    EXPECT_NEAR(result.energy_history.back(), result.energy, 1e-9 * result.energy);
    EXPECT_NEAR(result.energy, dirichlet_energy(mesh, result.frames), 1e-12 * result.energy);
}

TEST(Smooth, IsStationary) {
    const TetMesh mesh = jittered_cube(5, 0.2, 9);
    const BoundaryConstraints constraints = constraints_on(mesh, VertexConstraint::fixed, smooth_field(mesh));
    const SmoothResult result = smooth(mesh, constraints, initial_frames(mesh, constraints));
    std::mt19937_64 generator(10);
    for (int trial = 0; trial < 20; ++trial) {  // no small perturbation of free vertices lowers the energy
        Quaternions moved = result.frames;
        for (Eigen::Index v = 0; v < moved.rows(); ++v) {
            if (constraints.kind[v] == VertexConstraint::fixed) continue;
            const Vector3 w = 1e-3 * Vector3(frames::uniform01(generator) - 0.5, frames::uniform01(generator) - 0.5,
                                             frames::uniform01(generator) - 0.5);
            moved.row(v) =
                frames::to_wxyz(frames::exp(w) * frames::from_wxyz(frames::Vector4(moved.row(v).transpose())))
                    .transpose();
        }
        EXPECT_GT(dirichlet_energy(mesh, moved), result.energy);
    }
}

TEST(Smooth, HoldsItsConstraintsExactly) {
    const TetMesh mesh = jittered_cube(4, 0.2, 11);
    const Quaternions field = smooth_field(mesh);
    const Quaternions start = frames::random_rotations(mesh.vertices.rows(), 12);
    for (const VertexConstraint kind : {VertexConstraint::fixed, VertexConstraint::axis}) {
        const BoundaryConstraints constraints = constraints_on(mesh, kind, field);
        const SmoothResult result = smooth(mesh, constraints, start);
        for (Eigen::Index v = 0; v < field.rows(); ++v) {
            const Quaternion q = frames::from_wxyz(frames::Vector4(result.frames.row(v).transpose()));
            EXPECT_NEAR(q.norm(), 1, 1e-14);
            if (constraints.kind[v] == VertexConstraint::fixed) {
                EXPECT_LT(frames::distance(q, frames::from_wxyz(frames::Vector4(field.row(v).transpose()))), 1e-14);
            }
            if (constraints.kind[v] == VertexConstraint::axis) {
                EXPECT_NEAR((q.conjugate() * Vector3(constraints.axis.row(v).transpose())).cwiseAbs().maxCoeff(), 1,
                            1e-13);
            }
        }
    }
}

TEST(Smooth, FreeTwistLowersTheEnergyFurtherThanTheFixedFrame) {
    const TetMesh mesh = jittered_cube(4, 0.2, 13);
    const Quaternions field = smooth_field(mesh);
    const BoundaryConstraints fixed = constraints_on(mesh, VertexConstraint::fixed, field),
                              aligned = constraints_on(mesh, VertexConstraint::axis, field);
    const Quaternions start = initial_frames(mesh, fixed);
    EXPECT_LT(smooth(mesh, aligned, start).energy, smooth(mesh, fixed, start).energy);
}

TEST(Smooth, DoesNotDependOnTheInputsUnit) {
    const TetMesh mesh = jittered_cube(4, 0.2, 14);
    const BoundaryConstraints constraints = constraints_on(mesh, VertexConstraint::fixed, smooth_field(mesh));
    const SmoothResult reference = smooth(mesh, constraints, initial_frames(mesh, constraints));
    for (const double unit : {1e-6, 1e6}) {
        TetMesh scaled = mesh;
        scaled.vertices *= unit;
        const SmoothResult result = smooth(scaled, constraints, initial_frames(scaled, constraints));
        EXPECT_NEAR(result.energy / unit, reference.energy, 1e-8 * reference.energy);
        EXPECT_LT(largest_distance(result.frames, reference.frames), 1e-4);
    }
}

TEST(Smooth, GivesTheSameBitsAtAnyThreadCount) {
    const TetMesh mesh = jittered_cube(10, 0.2, 15);
    const BoundaryConstraints constraints = constraints_on(mesh, VertexConstraint::axis, smooth_field(mesh));
    SmoothOptions options;
    options.max_iterations = 5;
    const Quaternions start = initial_frames(mesh, constraints, 1);
    EXPECT_EQ(start, initial_frames(mesh, constraints, 3));
    options.threads = 1;
    const SmoothResult one = smooth(mesh, constraints, start, options);
    options.threads = 3;
    const SmoothResult three = smooth(mesh, constraints, start, options);
    EXPECT_EQ(one.frames, three.frames);
    EXPECT_EQ(one.energy_history, three.energy_history);
    EXPECT_EQ(one.energy, three.energy);
}

TEST(Smooth, LinearSolversAgree) {
    const TetMesh mesh = jittered_cube(6, 0.2, 16);
    const BoundaryConstraints constraints = constraints_on(mesh, VertexConstraint::fixed, smooth_field(mesh));
    SmoothOptions options;
    const Quaternions start = initial_frames(mesh, constraints);
    options.linear_solver = LinearSolver::cholesky;
    const SmoothResult direct = smooth(mesh, constraints, start, options);
    options.linear_solver = LinearSolver::conjugate_gradients;
    const SmoothResult iterative = smooth(mesh, constraints, start, options);
    EXPECT_NEAR(direct.energy, iterative.energy, 1e-6 * direct.energy);
}

TEST(Smooth, CancellingKeepsTheBestState) {
    const TetMesh mesh = jittered_cube(6, 0.2, 17);
    const BoundaryConstraints constraints = constraints_on(mesh, VertexConstraint::fixed, smooth_field(mesh));
    const Quaternions start = frames::random_rotations(mesh.vertices.rows(), 18);
    int calls = 0;
    const SmoothResult result =
        smooth(mesh, constraints, start, {}, [&](std::string_view, double, double) { return ++calls < 3; });
    EXPECT_EQ(calls, 3);
    EXPECT_EQ(result.message, "cancelled");
    EXPECT_FALSE(result.converged);
    EXPECT_NEAR(result.energy, result.energy_history.back(), 1e-9 * result.energy);
    EXPECT_LT(result.energy, result.energy_history.front());
}

TEST(Smooth, RefusesArraysThatDoNotFitTheMesh) {
    const TetMesh mesh = kuhn_cube(2);
    const Quaternions field = smooth_field(mesh);
    const BoundaryConstraints constraints = constraints_on(mesh, VertexConstraint::fixed, field);
    EXPECT_THROW(smooth(mesh, constraints, field.topRows(3)), InvalidInput);
    EXPECT_THROW(smooth(kuhn_cube(3), constraints, field), InvalidInput);
    Quaternions broken = field;
    broken.row(5).setZero();
    EXPECT_THROW(smooth(mesh, constraints, broken), InvalidInput);
    SmoothOptions options;
    options.max_iterations = -1;
    EXPECT_THROW(smooth(mesh, constraints, field, options), InvalidInput);
}

}  // namespace
}  // namespace octafield::volume
