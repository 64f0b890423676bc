#include "octafield/volume/diffuse.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "field_fixtures.hpp"
#include "octafield/frames/octahedral_group.hpp"
#include "octafield/volume/operators.hpp"

namespace octafield::volume {
namespace {

using frames::Quaternion;
using frames::Vector3;
using testing::constraints_on;
using testing::jittered_cube;
using testing::largest_distance;
using testing::smooth_field;

// Linear solves and last step small enough to be those of the flow itself.
DiffuseOptions accurate() {
    DiffuseOptions options;
    options.linear_tolerance = 1e-4;
    options.last_time = 1.0 / 16;
    options.max_steps = 200;
    return options;
}

TEST(Diffuse, FindsTheConstantFieldFromARandomStart) {
    const TetMesh mesh = jittered_cube(6, 0.2, 1);
    const Quaternion q = frames::exp({0.5, -0.2, 0.4});
    const Quaternions constant = testing::sample(mesh, [&](const Vector3&) { return q; });
    const Quaternions random = frames::random_rotations(mesh.vertices.rows(), 2);
    for (const VertexConstraint kind : {VertexConstraint::fixed, VertexConstraint::axis}) {
        const SmoothResult result = diffuse(mesh, constraints_on(mesh, kind, constant), random, accurate());
        EXPECT_LT(result.energy, 1e-5 * dirichlet_energy(mesh, random));
        EXPECT_TRUE(result.converged);
        // With free twist every constant field about the common axis has no energy.
        if (kind == VertexConstraint::fixed) {
            EXPECT_LT(largest_distance(result.frames, constant), 0.02);
        }
    }
}

TEST(Diffuse, ReturnsTheStateOfLowestEnergyMet) {
    const TetMesh mesh = jittered_cube(5, 0.2, 3);
    const BoundaryConstraints constraints = constraints_on(mesh, VertexConstraint::fixed, smooth_field(mesh));
    const SmoothResult far = diffuse(mesh, constraints, frames::random_rotations(mesh.vertices.rows(), 4));
    ASSERT_EQ(far.energy_history.size(), static_cast<std::size_t>(far.iterations) + 1);
    EXPECT_EQ(far.energy, *std::min_element(far.energy_history.begin(), far.energy_history.end()));
    EXPECT_NEAR(far.energy, dirichlet_energy(mesh, far.frames), 1e-12 * far.energy);
    const SmoothResult best = smooth(mesh, constraints, far.frames);
    EXPECT_LE(diffuse(mesh, constraints, best.frames).energy, best.energy * (1 + 1e-12));
}

// Both descend the same energy on a field without singular curves, so they must end at the same one.
TEST(Diffuse, EndsNearTheMinimiserOfSmooth) {
    const TetMesh mesh = jittered_cube(8, 0.15, 5);
    const Quaternions field = smooth_field(mesh);
    for (const VertexConstraint kind : {VertexConstraint::fixed, VertexConstraint::axis}) {
        const BoundaryConstraints constraints = constraints_on(mesh, kind, field);
        const SmoothResult minimum = smooth(mesh, constraints, field);
        const SmoothResult diffused = diffuse(mesh, constraints, field, accurate());
        EXPECT_GE(diffused.energy, minimum.energy * (1 - 1e-6));
        EXPECT_LT(diffused.energy, minimum.energy * 1.02);
        EXPECT_LT(largest_distance(diffused.frames, minimum.frames), 0.1);
    }
}

TEST(Diffuse, HoldsItsConstraintsExactly) {
    const TetMesh mesh = jittered_cube(4, 0.2, 6);
    const Quaternions start = frames::random_rotations(mesh.vertices.rows(), 7);
    for (const VertexConstraint kind : {VertexConstraint::fixed, VertexConstraint::axis}) {
        const BoundaryConstraints constraints = constraints_on(mesh, kind, smooth_field(mesh));
        const Quaternions frames = diffuse(mesh, constraints, start).frames;
        for (Eigen::Index v = 0; v < frames.rows(); ++v) {
            const Quaternion q = frames::from_wxyz(frames::Vector4(frames.row(v).transpose()));
            EXPECT_NEAR(q.norm(), 1, 1e-14);
            if (constraints.kind[v] == VertexConstraint::fixed) {
                EXPECT_EQ(frames.row(v), constraints.frames.row(v).normalized());
            }
            if (constraints.kind[v] == VertexConstraint::axis) {
                const Vector3 axis = constraints.axis.row(v).transpose();
                EXPECT_NEAR((q.conjugate() * axis).cwiseAbs().maxCoeff(), 1, 1e-13);
            }
        }
    }
}

TEST(Diffuse, GivesTheSameBitsAtAnyThreadCountAndDoesNotDependOnTheUnit) {
    const TetMesh mesh = jittered_cube(9, 0.2, 8);
    const BoundaryConstraints constraints = constraints_on(mesh, VertexConstraint::axis, smooth_field(mesh));
    const Quaternions start = frames::random_rotations(mesh.vertices.rows(), 9);
    DiffuseOptions options;
    options.max_steps = 4;
    options.threads = 1;
    const SmoothResult one = diffuse(mesh, constraints, start, options);
    options.threads = 3;
    EXPECT_EQ(one.frames, diffuse(mesh, constraints, start, options).frames);
    for (const double unit : {0x1p-20, 0x1p20}) {  // powers of two: no rounding in the change of unit
        TetMesh scaled = mesh;
        scaled.vertices *= unit;
        const SmoothResult result = diffuse(scaled, constraints, start, options);
        EXPECT_NEAR(result.energy / unit, one.energy, 1e-3 * one.energy);
    }
}

TEST(Diffuse, StopsWhenAsked) {
    const TetMesh mesh = jittered_cube(5, 0.2, 10);
    const BoundaryConstraints constraints = constraints_on(mesh, VertexConstraint::fixed, smooth_field(mesh));
    int calls = 0;
    const SmoothResult result = diffuse(mesh, constraints, smooth_field(mesh), {},
                                        [&](std::string_view, double, double) { return ++calls < 3; });
    EXPECT_EQ(result.iterations, 2);
    EXPECT_EQ(result.message, "cancelled");
    EXPECT_FALSE(result.converged);
}

TEST(Diffuse, RefusesWhatDoesNotFit) {
    const TetMesh mesh = testing::kuhn_cube(2);
    const Quaternions field = smooth_field(mesh);
    const BoundaryConstraints constraints = constraints_on(mesh, VertexConstraint::fixed, field);
    EXPECT_THROW(diffuse(mesh, constraints, field.topRows(2)), InvalidInput);
    EXPECT_THROW(diffuse(testing::kuhn_cube(3), constraints, field), InvalidInput);
    DiffuseOptions options;
    options.first_time = 0;
    EXPECT_THROW(diffuse(mesh, constraints, field, options), InvalidInput);
}

}  // namespace
}  // namespace octafield::volume
