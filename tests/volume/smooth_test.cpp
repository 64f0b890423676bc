#include "octafield/volume/smooth.hpp"

#include <gtest/gtest.h>
#include "ceres_manifold_matchers.hpp"

#include <cmath>

#include "dirichlet_blocks.hpp"
#include "field_fixtures.hpp"
#include "frame_manifolds.hpp"
#include "octafield/frames/octahedral_group.hpp"
#include "octafield/volume/diffuse.hpp"
#include "octafield/volume/operators.hpp"
#include "octafield/volume/schemes.hpp"
#include "tet_fixtures.hpp"

namespace octafield::volume {
namespace {

using frames::Quaternion;
using frames::Vector3;
using testing::constraints_on;
using testing::jittered_cube;
using testing::kuhn_cube;
using testing::largest_distance;
using testing::smooth_field;

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

TEST(FixedAxisManifold, ObeysCeresManifoldInvariantsAndKeepsTheAxis) {
    using namespace ceres;  // the macro names its helpers unqualified
    const Quaternions q = frames::random_rotations(40, 2);
    for (Eigen::Index i = 0; i < q.rows(); ++i) {
        const Eigen::VectorXd x = q.row(i).transpose();
        const Quaternion frame = frames::from_wxyz(frames::Vector4(x));
        const Vector3 axis = frame * Vector3::UnitY();
        const ConstraintManifold<FixedAxis> manifold(FixedAxis({axis, frames::Vector4(x)}));
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

// Whatever is minimised, by whatever solver: E of the frames beside the objective, from the start to what is returned.
TEST(Smooth, HistoriesBeginAtTheStartAndEndWithWhatIsReturned) {
    const TetMesh mesh = jittered_cube(4, 0.2, 7);
    const BoundaryConstraints constraints = constraints_on(mesh, VertexConstraint::fixed, smooth_field(mesh));
    const Quaternions start = initial_frames(mesh, constraints);
    for (const Scheme& each : schemes())
        for (const SchemeSolver& by : each.solvers) {
            const std::string& name = each.name;
            const SmoothSolver solver = by.solver;
            SmoothOptions options;
            options.representation = name;
            options.solver = solver;
            options.max_iterations = 12;
            const SmoothResult result = smooth(mesh, constraints, start, options);
            const std::string where = name + " " + std::to_string(static_cast<int>(solver));
            ASSERT_EQ(result.energy_history.size(), result.objective_history.size()) << where;
            EXPECT_NEAR(result.energy_history.front(), dirichlet_energy(mesh, start), 1e-9 * result.energy) << where;
            EXPECT_NEAR(result.energy_history.back(), dirichlet_energy(mesh, result.frames), 1e-9 * result.energy)
                << where;
            EXPECT_NEAR(result.objective_history.back(), result.objective, 1e-9 * result.objective) << where;
            options.max_iterations = 0;
            const SmoothResult at_start = smooth(mesh, constraints, start, options);
            EXPECT_NEAR(result.objective_history.front(), at_start.objective, 1e-9 * at_start.objective) << where;
        }
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
    const Quaternions start = initial_frames(mesh, constraints, Start::constraints, 1);
    EXPECT_EQ(start, initial_frames(mesh, constraints, Start::constraints, 3));
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

// Vertices of no tet have neither neighbours nor mass; they keep their start.
TEST(Smooth, LeavesVerticesOfNoTetAlone) {
    TetMesh mesh = jittered_cube(3, 0.2, 19);
    const Eigen::Index used = mesh.vertices.rows();
    mesh.vertices.conservativeResize(used + 20, 3);
    mesh.vertices.bottomRows(20).setConstant(0.5);
    const Quaternions start = frames::random_rotations(mesh.vertices.rows(), 20);
    for (const VertexConstraint kind : {VertexConstraint::fixed, VertexConstraint::axis}) {
        const BoundaryConstraints constraints = constraints_on(mesh, kind, smooth_field(mesh));
        EXPECT_TRUE(initial_frames(mesh, constraints).allFinite());
        EXPECT_TRUE(diffuse(mesh, constraints, start).frames.allFinite());
        const SmoothResult result = smooth(mesh, constraints, start);
        EXPECT_LT(largest_distance(result.frames.bottomRows(20), start.bottomRows(20)), 1e-7);
    }
}

TEST(Smooth, NamesTheUnsoundTetBeforeWorking) {
    TetMesh mesh = kuhn_cube(2);
    const BoundaryConstraints constraints = constraints_on(mesh, VertexConstraint::fixed, smooth_field(mesh));
    const Quaternions start = smooth_field(mesh);
    std::swap(mesh.tets(5, 0), mesh.tets(5, 1));
    EXPECT_THROW(smooth(mesh, constraints, start), GeometryError);
    EXPECT_THROW(diffuse(mesh, constraints, start), GeometryError);
    EXPECT_THROW(initial_frames(mesh, constraints), GeometryError);
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
