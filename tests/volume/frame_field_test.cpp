#include "octafield/volume/frame_field.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "field_fixtures.hpp"
#include "octafield/volume/operators.hpp"

namespace octafield::volume {
namespace {

using testing::constraints_on;
using testing::jittered_cube;
using testing::largest_distance;
using testing::smooth_field;

TEST(FrameField, IsNeverAboveItsParts) {
    const TetMesh mesh = jittered_cube(6, 0.2, 1);
    const BoundaryConstraints constraints = constraints_on(mesh, VertexConstraint::axis, smooth_field(mesh));
    const SmoothResult diffused = diffuse(mesh, constraints, initial_frames(mesh, constraints));
    const SmoothResult polished = smooth(mesh, constraints, diffused.frames);
    const FrameFieldResult result = frame_field(mesh, constraints);
    EXPECT_LE(result.smooth.energy, polished.energy * (1 + 1e-5));
    EXPECT_NEAR(result.smooth.energy, dirichlet_energy(mesh, result.smooth.frames), 1e-12 * result.smooth.energy);
    EXPECT_NEAR(result.smooth.energy,
                *std::min_element(result.smooth.energy_history.begin(), result.smooth.energy_history.end()),
                1e-12 * result.smooth.energy);
    EXPECT_TRUE(result.smooth.converged);
    EXPECT_GT(result.diffusion_steps, diffused.iterations);
}

TEST(FrameField, EndsItsHistoryWithTheEnergyOfItsFrames) {
    const TetMesh mesh = jittered_cube(6, 0.2, 1);
    const BoundaryConstraints constraints = constraints_on(mesh, VertexConstraint::axis, smooth_field(mesh));
    for (const char* representation : {"sh4", "su2", "geodesic", "odeco_lengths"})
        for (const int rounds : {0, 1, 3}) {
            FrameFieldOptions options;
            options.smooth.representation = representation;
            options.rounds = rounds;
            const SmoothResult result = frame_field(mesh, constraints, options).smooth;
            EXPECT_NEAR(result.energy_history.back(), result.energy, 1e-9 * result.energy) << representation << rounds;
            EXPECT_NEAR(result.objective_history.back(), result.objective, 1e-9 * result.objective) << representation;
            EXPECT_LE(result.objective_history.size(), result.energy_history.size());
            const bool whole = result.objective_history.size() == result.energy_history.size();
            EXPECT_TRUE(rounds > 0 || whole) << representation;
        }
}

TEST(FrameField, DoesNotDependOnTheSeedWhereTheFieldIsSmooth) {
    const TetMesh mesh = jittered_cube(6, 0.2, 2);
    const BoundaryConstraints constraints = constraints_on(mesh, VertexConstraint::fixed, smooth_field(mesh));
    const FrameFieldResult linear = frame_field(mesh, constraints);
    FrameFieldOptions options;
    for (options.seed = 1; options.seed <= 3; ++options.seed) {
        const FrameFieldResult random = frame_field(mesh, constraints, options);
        EXPECT_NEAR(random.smooth.energy, linear.smooth.energy, 1e-5 * linear.smooth.energy);
        EXPECT_LT(largest_distance(random.smooth.frames, linear.smooth.frames), 0.02);
    }
}

TEST(FrameField, EndsWithTheRepresentationAndSolverAskedFor) {
    const TetMesh mesh = jittered_cube(5, 0.2, 3);
    const BoundaryConstraints constraints = constraints_on(mesh, VertexConstraint::fixed, smooth_field(mesh));
    const FrameFieldResult sh4 = frame_field(mesh, constraints);
    FrameFieldOptions options;
    options.smooth.tolerance = 1e-9;
    for (const SmoothSolver solver : {SmoothSolver::levenberg_marquardt, SmoothSolver::lbfgs}) {
        options.smooth.solver = solver;
        const FrameFieldResult other = frame_field(mesh, constraints, options);
        EXPECT_NEAR(other.smooth.energy, sh4.smooth.energy, 1e-4 * sh4.smooth.energy);
    }
    options.smooth.solver = SmoothSolver::trust_region;
    options.smooth.representation = "tensor4";  // isometric to sh4 but for the factor 6/5
    const FrameFieldResult tensor4 = frame_field(mesh, constraints, options);
    EXPECT_NEAR(tensor4.smooth.energy, sh4.smooth.energy, 1e-5 * sh4.smooth.energy);
    EXPECT_NEAR(tensor4.smooth.objective, 1.2 * tensor4.smooth.energy, 1e-10 * sh4.smooth.energy);
}

TEST(FrameField, StopsWhenAskedAndKeepsTheBest) {
    const TetMesh mesh = jittered_cube(5, 0.2, 4);
    const BoundaryConstraints constraints = constraints_on(mesh, VertexConstraint::axis, smooth_field(mesh));
    for (const int allowed : {1, 5, 12}) {
        int calls = 0;
        double last = 0;
        const FrameFieldResult result =
            frame_field(mesh, constraints, {}, [&](std::string_view, double fraction, double) {
                EXPECT_GE(fraction, last - 1e-12);
                last = fraction;
                return ++calls < allowed;
            });
        EXPECT_EQ(calls, allowed);
        EXPECT_EQ(result.smooth.message, "cancelled");
        EXPECT_FALSE(result.smooth.converged);
        EXPECT_NEAR(result.smooth.energy, dirichlet_energy(mesh, result.smooth.frames), 1e-12 * result.smooth.energy);
    }
}

TEST(FrameField, GivesTheSameBitsAtAnyThreadCount) {
    const TetMesh mesh = jittered_cube(16, 0.2, 5);
    const BoundaryConstraints constraints = constraints_on(mesh, VertexConstraint::axis, smooth_field(mesh));
    FrameFieldOptions options;
    options.threads = 1;
    const FrameFieldResult one = frame_field(mesh, constraints, options);
    options.threads = 3;
    EXPECT_EQ(one.smooth.frames, frame_field(mesh, constraints, options).smooth.frames);
}

TEST(FrameField, RefusesBadOptions) {
    const TetMesh mesh = testing::kuhn_cube(2);
    const BoundaryConstraints constraints = constraints_on(mesh, VertexConstraint::fixed, smooth_field(mesh));
    FrameFieldOptions options;
    options.rounds = -1;
    EXPECT_THROW(frame_field(mesh, constraints, options), InvalidInput);
    options.rounds = 1;
    options.round_time = 0;
    EXPECT_THROW(frame_field(mesh, constraints, options), InvalidInput);
    options.round_time = 1;
    options.smooth.representation = "sh5";
    EXPECT_THROW(frame_field(mesh, constraints, options), InvalidInput);
}

}  // namespace
}  // namespace octafield::volume
