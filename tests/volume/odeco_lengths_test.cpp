// Smoothing of odeco tensors with free axis lengths.

#include <ceres/problem.h>
#include <gtest/gtest.h>

#include <cmath>

#include "dirichlet_costs.hpp"
#include "field_fixtures.hpp"
#include "octafield/frames/odeco.hpp"
#include "octafield/volume/frame_field.hpp"
#include "odeco_field.hpp"

namespace octafield::volume {
namespace {

using frames::Odeco;
using frames::Quaternion;
using frames::Vector3;
using testing::constraints_on;
using testing::jittered_cube;
using testing::row;
using testing::smooth_field;

SmoothOptions with_lengths(SmoothSolver solver = SmoothSolver::levenberg_marquardt) {
    SmoothOptions options;
    options.representation = "odeco_lengths";
    options.solver = solver;
    options.tolerance = 1e-12;
    options.max_iterations = 1000;
    return options;
}

Odeco::Vector tensor(const SmoothResult& result, Eigen::Index v) {
    return Odeco::embed(row(result.frames, v), result.lengths.row(v).transpose());
}

TEST(OdecoField, DerivativesAreThoseOfFiniteDifferences) {
    constexpr int n = 20;
    const Quaternions q = frames::random_rotations(n, 1);
    Points logs(n, 3);
    for (Eigen::Index i = 0; i < n; ++i) logs.row(i) << std::sin(i), 0.5 * std::cos(3 * i), -0.3 * i / n;
    OdecoField field(q, logs, 1);
    field.PrepareForEvaluation(true, true);
    const double h = 1e-5;
    for (int k = 0; k < 6; ++k) {
        const auto moved = [&](double step) {
            Quaternions turned = q;
            Points longer = logs;
            for (Eigen::Index i = 0; i < n; ++i) {
                if (k < 3)
                    turned.row(i) = frames::to_wxyz(frames::exp(step * Vector3::Unit(k)) * row(q, i)).transpose();
                else
                    longer(i, k - 3) += step;
            }
            auto other = std::make_unique<OdecoField>(turned, longer, 1);
            other->PrepareForEvaluation(false, true);
            return other;
        };
        const auto ahead = moved(h), behind = moved(-h);
        for (Index i = 0; i < n; ++i) {
            const Odeco::Vector difference = (ahead->value(i) - behind->value(i)) / (2 * h);
            Odeco::Vector derivative;
            if (k < 3) {
                Eigen::Matrix<double, 4, 3, Eigen::RowMajor> plus;
                FrameManifold().PlusJacobian(q.row(i).data(), plus.data());
                derivative =
                    Eigen::Map<const Eigen::Matrix<double, 15, 4, Eigen::RowMajor>>(field.jacobian(i, 0)) * plus.col(k);
            } else {
                derivative =
                    Eigen::Map<const Eigen::Matrix<double, 15, 3, Eigen::RowMajor>>(field.jacobian(i, 1)).col(k - 3);
            }
            EXPECT_LT((difference - derivative).norm(), 1e-8);
        }
    }
}

// The gradient that Ceres assembles from the costs against differences of its cost.
TEST(OdecoField, GradientOfTheEnergyIsThatOfFiniteDifferences) {
    const TetMesh mesh = jittered_cube(2, 0.2, 2);  // obtuse: tets kept whole
    const Index n = static_cast<Index>(mesh.vertices.rows());
    OdecoField field(
        frames::random_rotations(n, 3),
        Points::NullaryExpr(n, 3, [](Eigen::Index i, Eigen::Index k) { return 0.3 * std::sin(double(i + 5 * k)); }), 1);
    ceres::Problem::Options problem_options;
    problem_options.evaluation_callback = &field;
    ceres::Problem problem(problem_options);
    add_dirichlet_costs(problem, field, dirichlet_blocks(mesh), 1);
    std::vector<double*> blocks;
    for (Index v = 0; v < n; ++v) blocks.push_back(field.parameters(v, 1));
    ceres::Problem::EvaluateOptions options;
    options.parameter_blocks = blocks;
    std::vector<double> gradient;
    double cost = 0;
    ASSERT_TRUE(problem.Evaluate(options, &cost, nullptr, &gradient, nullptr));
    for (const Index v : {0, 5, 13}) {
        for (int k = 0; k < 3; ++k) {
            double costs[2];
            for (int side = 0; side < 2; ++side) {
                const double kept = blocks[v][k];
                blocks[v][k] += side ? -1e-5 : 1e-5;
                problem.Evaluate(options, &costs[side], nullptr, nullptr, nullptr);
                blocks[v][k] = kept;
            }
            EXPECT_NEAR(gradient[3 * v + k], (costs[0] - costs[1]) / 2e-5, 1e-6 * cost);
        }
    }
}

// Between two faces whose lengths differ and where the frames are equal, the linear interpolant of the tensors is odeco
// everywhere: the minimum over all tensors, so that over odeco ones too.
TEST(OdecoLengths, AreInterpolatedLinearlyBetweenTwoFaces) {
    const TetMesh mesh = jittered_cube(4, 0.2, 4);
    const Quaternion q = frames::exp({0.4, -0.2, 0.7});
    const Quaternions constant = testing::sample(mesh, [&](const Vector3&) { return q; });
    BoundaryConstraints constraints = constraints_on(mesh, VertexConstraint::fixed, constant);
    const Eigen::RowVector3d low(1, 2, 0.5), high(3, 0.7, 1);
    constraints.lengths = Points::Ones(mesh.vertices.rows(), 3);
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
        const double z = mesh.vertices(v, 2);
        if (z == 0)
            constraints.lengths.row(v) = low;
        else if (z == 1)
            constraints.lengths.row(v) = high;
        else
            constraints.kind[v] = VertexConstraint::free;
    }
    Quaternions start = constant;  // in other representatives: lengths follow their axes
    for (Eigen::Index v = 0; v < start.rows(); ++v)
        start.row(v) = frames::to_wxyz(q * frames::binary_octahedral_group()[(11 * v) % 48]).transpose();
    for (const SmoothSolver solver : {SmoothSolver::levenberg_marquardt, SmoothSolver::lbfgs}) {
        const SmoothResult result = smooth(mesh, constraints, start, with_lengths(solver));
        ASSERT_EQ(result.lengths.rows(), mesh.vertices.rows());
        for (Eigen::Index v = 0; v < start.rows(); ++v) {
            const double z = mesh.vertices(v, 2);
            const Odeco::Vector expected = Odeco::embed(q, ((1 - z) * low + z * high).transpose());
            EXPECT_LT((tensor(result, v) - expected).norm(), 1e-3) << static_cast<int>(solver);
        }
        // 1/2 |T1 - T0|^2 over the unit cube.
        const double energy = (Odeco::embed(q, high.transpose()) - Odeco::embed(q, low.transpose())).squaredNorm() / 2;
        EXPECT_NEAR(result.objective, energy, 1e-5 * energy);
    }
}

TEST(OdecoLengths, AreHeldAlongFixedAxesWhateverAxisOfTheFrameLiesThere) {
    const TetMesh mesh = jittered_cube(3, 0.2, 5);
    const Quaternions field = smooth_field(mesh);
    BoundaryConstraints constraints = constraints_on(mesh, VertexConstraint::axis, field);
    Quaternions start = initial_frames(mesh, constraints);
    for (const double held : {1.0, 2.5}) {
        if (held != 1) constraints.lengths = Points::Constant(mesh.vertices.rows(), 3, held);
        SmoothResult first;
        for (const int step : {0, 7}) {
            Quaternions other = start;
            for (Eigen::Index v = 0; v < start.rows(); ++v)
                other.row(v) =
                    frames::to_wxyz(row(start, v) * frames::binary_octahedral_group()[(step * v) % 48]).transpose();
            const SmoothResult result = smooth(mesh, constraints, other, with_lengths(SmoothSolver::lbfgs));
            EXPECT_TRUE(result.converged) << result.message;
            EXPECT_GT(result.lengths.minCoeff(), 0);
            bool others_move = false;
            for (Eigen::Index v = 0; v < start.rows(); ++v) {
                if (constraints.kind[v] != VertexConstraint::axis) continue;
                int axis = 0;
                const Vector3 local = row(result.frames, v).conjugate() * Vector3(constraints.axis.row(v).transpose());
                EXPECT_NEAR(local.cwiseAbs().maxCoeff(&axis), 1, 1e-12);
                EXPECT_NEAR(result.lengths(v, axis), held, 1e-12);
                others_move |= std::abs(result.lengths(v, (axis + 1) % 3) - 1) > 1e-3;
            }
            EXPECT_TRUE(others_move);
            if (step == 0) first = result;
            for (Eigen::Index v = 0; v < start.rows(); ++v)  // the same tensors: nothing depends on the representative
                EXPECT_LT((tensor(result, v) - tensor(first, v)).norm(), 2e-3);
        }
    }
}

TEST(OdecoLengths, LowerTheObjectiveOfUnitOdecoAndReportTheEnergyOfSh4) {
    const TetMesh mesh = jittered_cube(4, 0.2, 6);
    const BoundaryConstraints constraints = constraints_on(mesh, VertexConstraint::axis, smooth_field(mesh));
    FrameFieldOptions options;
    options.smooth.representation = "odeco";
    options.smooth.solver = SmoothSolver::levenberg_marquardt;
    const SmoothResult unit = frame_field(mesh, constraints, options).smooth;
    EXPECT_EQ(unit.lengths.rows(), 0);
    options.smooth = with_lengths();
    const SmoothResult free = frame_field(mesh, constraints, options).smooth;
    EXPECT_LT(free.objective, 0.99 * unit.objective);
    EXPECT_GE(free.energy, unit.energy * (1 - 1e-6));  // unit lengths minimise sh4's energy
    EXPECT_NEAR(free.energy, dirichlet_energy(mesh, free.frames), 1e-12 * free.energy);
    options.smooth = with_lengths(SmoothSolver::lbfgs);
    EXPECT_NEAR(frame_field(mesh, constraints, options).smooth.objective, free.objective, 1e-4 * free.objective);
    for (const SmoothSolver solver : {SmoothSolver::default_}) {
        options.smooth = with_lengths(solver);
        options.threads = 3;
        const SmoothResult three = frame_field(mesh, constraints, options).smooth;
        options.threads = 1;
        EXPECT_EQ(three.lengths, frame_field(mesh, constraints, options).smooth.lengths);
    }
}

TEST(OdecoLengths, AreSmoothedInTetsToo) {
    const TetMesh mesh = jittered_cube(3, 0.2, 7);
    const BoundarySurface surface = boundary_surface(mesh);
    Points directions(surface.mesh.triangles.rows(), 3);
    const Points normals = surface::triangle_normals(surface.mesh);
    for (Eigen::Index f = 0; f < directions.rows(); ++f)
        directions.row(f) = Vector3(normals.row(f).transpose()).unitOrthogonal().transpose();
    const SmoothResult result = smooth(tet_sampling(mesh), tet_boundary_constraints(mesh, directions),
                                       frames::random_rotations(mesh.tets.rows(), 8), with_lengths());
    EXPECT_EQ(result.lengths.rows(), mesh.tets.rows());
    EXPECT_LT(result.objective, result.objective_history.front());
}

TEST(OdecoLengths, RefuseWhatHoldsNoneAndWhatIsNoLength) {
    const TetMesh mesh = testing::kuhn_cube(2);
    const Quaternions field = smooth_field(mesh);
    BoundaryConstraints constraints = constraints_on(mesh, VertexConstraint::fixed, field);
    EXPECT_THROW(smooth(mesh, constraints, field, with_lengths(SmoothSolver::trust_region)), InvalidInput);
    constraints.lengths = Points::Ones(mesh.vertices.rows(), 3);
    constraints.lengths(3, 1) = 0;
    EXPECT_THROW(smooth(mesh, constraints, field, with_lengths()), InvalidInput);
    constraints.lengths = Points::Ones(4, 3);
    EXPECT_THROW(smooth(mesh, constraints, field, with_lengths()), InvalidInput);
    EXPECT_THROW(smooth(mesh, constraints_on(mesh, VertexConstraint::free, field), field, with_lengths()),
                 InvalidInput);
}

}  // namespace
}  // namespace octafield::volume
