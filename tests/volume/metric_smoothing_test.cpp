// Smoothing in metrics on frames: what is consistent, and what is not (docs/su2_smoothing.md).

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "field_fixtures.hpp"
#include "frame_difference.hpp"
#include "octafield/frames/geodesic.hpp"
#include "octafield/frames/registry.hpp"
#include "octafield/volume/frame_field.hpp"
#include "octafield/volume/operators.hpp"
#include "octafield/volume/singularities.hpp"

namespace octafield::volume {
namespace {

using frames::Quaternion;
using frames::Vector3;
using testing::constraints_on;
using testing::jittered_cube;
using testing::kuhn_cube;
using testing::largest_distance;
using testing::smooth_field;

constexpr double degree = std::numbers::pi / 180;
const std::vector<std::string> consistent = {"geodesic", "su2_geodesic", "su2_midpoint"};

Quaternion row(const Quaternions& q, Eigen::Index v) {
    return frames::from_wxyz(frames::Vector4(q.row(v).transpose()));
}

Quaternions in_random_representatives(Quaternions field, std::uint64_t seed) {
    std::mt19937_64 generator(seed);
    for (Eigen::Index v = 0; v < field.rows(); ++v)
        field.row(v) =
            frames::to_wxyz((row(field, v) * frames::binary_octahedral_group()[generator() % 48]).normalized())
                .transpose();
    return field;
}

Quaternions noisy(Quaternions field, double amount, std::uint64_t seed) {
    std::mt19937_64 generator(seed);
    for (Eigen::Index v = 0; v < field.rows(); ++v) {
        const Vector3 w = amount * Vector3(2 * frames::uniform01(generator) - 1, 2 * frames::uniform01(generator) - 1,
                                           2 * frames::uniform01(generator) - 1);
        field.row(v) = frames::to_wxyz(frames::frame_exp(row(field, v), w)).transpose();
    }
    return field;
}

SmoothOptions with(const std::string& representation) {
    SmoothOptions options;
    options.representation = representation;
    options.tolerance = 1e-10;
    return options;
}

// Over the vertices that are not fixed.
double mean_distance(const Quaternions& a, const Quaternions& b, const BoundaryConstraints& constraints) {
    double sum = 0;
    int free = 0;
    for (Eigen::Index v = 0; v < a.rows(); ++v) {
        if (constraints.kind[v] == VertexConstraint::fixed) continue;
        sum += frames::distance(row(a, v), row(b, v));
        ++free;
    }
    return sum / free;
}

// Of a scheme's result from the minimiser of sh4 on the Kuhn cube of n cells a side.
double deviation(const std::string& representation, int n) {
    const TetMesh mesh = kuhn_cube(n);
    const BoundaryConstraints constraints = constraints_on(mesh, VertexConstraint::fixed, smooth_field(mesh));
    const Quaternions reference = smooth(mesh, constraints, initial_frames(mesh, constraints), with("sh4")).frames;
    const SmoothResult result =
        smooth(mesh, constraints, in_random_representatives(reference, 21), with(representation));
    EXPECT_TRUE(result.converged) << representation << ": " << result.message;
    return mean_distance(result.frames, reference, constraints);
}

// Against differences of the values, for frames `angle` apart in random representatives.
template <class Scheme>
double jacobian_error(const Scheme& scheme, double angle, std::uint64_t seed) {
    const Quaternions sample = frames::random_rotations(40, seed);
    double worst = 0;
    for (Eigen::Index i = 0; i + 1 < sample.rows(); ++i) {
        const Quaternion p = row(sample, i);
        const Vector3 w = angle * row(sample, i + 1).vec().normalized();
        const Quaternion q = frames::frame_exp(p, w) * frames::binary_octahedral_group()[(7 * i) % 48];
        const auto value = [&](const Quaternion& a, const Quaternion& b) {
            return scheme.difference(0, Scheme::at(a, false), Scheme::at(b, false), false).value;
        };
        const auto exact = scheme.difference(0, Scheme::at(p, true), Scheme::at(q, true), true);
        EXPECT_LT((exact.value - value(p, q)).norm(), 1e-15);
        constexpr double h = 1e-5;
        for (int k = 0; k < 3; ++k) {
            const Vector3 e = h * Vector3::Unit(k);
            const auto by_first =
                ((value(frames::frame_exp(p, e), q) - value(frames::frame_exp(p, -e), q)) / (2 * h)).eval();
            const auto by_second =
                ((value(p, frames::frame_exp(q, e)) - value(p, frames::frame_exp(q, -e))) / (2 * h)).eval();
            worst = std::max(worst, (by_first - exact.by_first.col(k)).norm());
            worst = std::max(worst, (by_second - exact.by_second.col(k)).norm());
        }
    }
    return worst;
}

// The frozen metric has nothing to compare with: its derivative is exact at matrices that do not move.
TEST(FrameDifference, JacobiansAgreeWithNumericOnesAtEveryAngle) {
    const double never = std::numeric_limits<double>::infinity();
    for (const double angle : {0.0, 1e-6, 1e-3, 0.02, 0.1, 0.25, 0.5}) {
        EXPECT_LT(jacobian_error(GeodesicScheme{}, angle, 1), 1e-8) << angle;
        EXPECT_LT(jacobian_error(Su2GeodesicScheme{}, angle, 2), 1e-8) << angle;
        EXPECT_LT(jacobian_error(MidpointScheme{20 * degree}, angle, 3), 1e-6) << angle;
        EXPECT_LT(jacobian_error(MidpointScheme{never}, angle, 4), 1e-5) << angle;
        EXPECT_LT(jacobian_error(SymmetricScheme{}, angle, 5), 1e-5) << angle;
    }
}

// Oracle: the distances of frames/.
TEST(FrameDifference, LengthsAreTheMetricsOfFrames) {
    const double never = std::numeric_limits<double>::infinity();
    const Quaternions sample = frames::random_rotations(50, 6);
    for (Eigen::Index i = 0; i + 1 < sample.rows(); ++i) {
        const Quaternion p = row(sample, i), q = row(sample, i + 1);
        const auto length = [&](const auto& scheme) {
            return scheme.difference(0, scheme.at(p, false), scheme.at(q, false), false).value.norm();
        };
        EXPECT_NEAR(length(GeodesicScheme{}), frames::metric("geodesic").distance(p, q), 1e-13);
        EXPECT_NEAR(length(Su2GeodesicScheme{}), frames::metric("su2_geodesic").distance(p, q), 1e-13);
        EXPECT_NEAR(length(MidpointScheme{never}), frames::metric("su2_midpoint").distance(p, q), 1e-12);
        EXPECT_NEAR(length(SymmetricScheme{}), frames::metric("su2_symmetric").distance(p, q), 1e-12);
    }
}

TEST(MetricSmoothing, ConsistentSchemesConvergeToTheMinimiserOfSh4AtSecondOrder) {
    for (const std::string& name : consistent) {
        const double coarse = deviation(name, 4), fine = deviation(name, 8);
        EXPECT_LT(fine, 0.3 * coarse) << name;  // 0.25 at second order
        EXPECT_LT(fine, 0.15 * degree) << name;
    }
}

TEST(MetricSmoothing, NaiveAndFrozenSchemesDoNotConvergeToIt) {
    for (const char* name : {"su2", "su2_frozen"}) {
        const double coarse = deviation(name, 4), fine = deviation(name, 8);
        EXPECT_GT(fine, 0.6 * coarse) << name;
        EXPECT_GT(fine, 1 * degree) << name;
    }
}

TEST(MetricSmoothing, DoesNotDependOnTheRepresentativesOfTheStart) {
    const TetMesh mesh = jittered_cube(5, 0.2, 22);
    const BoundaryConstraints constraints = constraints_on(mesh, VertexConstraint::fixed, smooth_field(mesh));
    const Quaternions start = initial_frames(mesh, constraints);
    for (const std::string& name : consistent) {
        const SmoothResult reference = smooth(mesh, constraints, start, with(name));
        const SmoothResult other = smooth(mesh, constraints, in_random_representatives(start, 23), with(name));
        EXPECT_LT(largest_distance(reference.frames, other.frames), 1e-5) << name;
        EXPECT_NEAR(reference.objective, other.objective, 1e-9 * reference.objective) << name;
    }
}

// The jitter makes obtuse tets, which are kept whole. The start is rough for the metrics but not for sh4.
TEST(MetricSmoothing, ReachesTheSameFieldOnObtuseMeshesFromANoisyStart) {
    const TetMesh mesh = jittered_cube(6, 0.2, 24);
    const BoundaryConstraints constraints = constraints_on(mesh, VertexConstraint::fixed, smooth_field(mesh));
    const Quaternions reference = smooth(mesh, constraints, smooth_field(mesh), with("sh4")).frames;
    const Quaternions start = in_random_representatives(noisy(smooth_field(mesh), 0.05, 25), 26);
    for (const std::string& name : consistent) {
        const SmoothResult result = smooth(mesh, constraints, start, with(name));
        EXPECT_TRUE(result.converged) << name;
        EXPECT_LT(mean_distance(result.frames, reference, constraints), 0.3 * degree) << name;
        EXPECT_NEAR(result.objective, 0.15 * result.energy, 0.04 * result.objective) << name;  // unit speed: 3/20
    }
}

TEST(MetricSmoothing, Su2GeodesicIsTheGeodesicReadFromTheInvariants) {
    const TetMesh mesh = jittered_cube(5, 0.2, 27);
    const BoundaryConstraints constraints = constraints_on(mesh, VertexConstraint::axis, smooth_field(mesh));
    const Quaternions start = initial_frames(mesh, constraints);
    const SmoothResult one = smooth(mesh, constraints, start, with("geodesic")),
                       other = smooth(mesh, constraints, start, with("su2_geodesic"));
    EXPECT_LT(largest_distance(one.frames, other.frames), 1e-4);
    EXPECT_NEAR(one.objective, other.objective, 1e-9 * one.objective);
}

TEST(MetricSmoothing, NeverRaisesItsObjectiveAndHoldsConstraintsExactly) {
    const TetMesh mesh = jittered_cube(4, 0.2, 28);
    const Quaternions start = frames::random_rotations(mesh.vertices.rows(), 29);
    const BoundaryConstraints constraints = constraints_on(mesh, VertexConstraint::axis, smooth_field(mesh));
    for (const char* name : {"geodesic", "su2_geodesic", "su2_midpoint", "su2_symmetric"})
        for (const SmoothSolver solver : {SmoothSolver::levenberg_marquardt, SmoothSolver::lbfgs}) {
            SmoothOptions options = with(name);
            options.solver = solver;
            const SmoothResult result = smooth(mesh, constraints, start, options);
            for (std::size_t i = 1; i < result.objective_history.size(); ++i)
                EXPECT_LE(result.objective_history[i], result.objective_history[i - 1] * (1 + 1e-12)) << name;
            options.max_iterations = 0;
            EXPECT_NEAR(smooth(mesh, constraints, result.frames, options).objective, result.objective,
                        1e-9 * result.objective);
            EXPECT_NEAR(result.energy, dirichlet_energy(mesh, result.frames), 1e-12 * result.energy);
            for (Eigen::Index v = 0; v < start.rows(); ++v) {
                if (constraints.kind[v] != VertexConstraint::axis) continue;
                const Vector3 in_frame =
                    row(result.frames, v).conjugate() * Vector3(constraints.axis.row(v).transpose());
                EXPECT_NEAR(in_frame.cwiseAbs().maxCoeff(), 1, 1e-13);
            }
        }
}

// Frames turned by 40 degrees from one side to the other of one layer of tets: far beyond the midpoint metric.
TEST(MetricSmoothing, MidpointIsTheGeodesicWhereFramesDifferByMoreThanTheLimit) {
    const TetMesh mesh = kuhn_cube(1);
    const Quaternions field = testing::sample(mesh, [](const Vector3& x) {
        return frames::exp({0, 0, x.x() * 40 * degree}) * frames::exp({0, 0.1, 0});
    });
    const BoundaryConstraints constraints = constraints_on(mesh, VertexConstraint::fixed, field);
    const double expected = std::pow(40 * degree, 2) / 2;  // unit cube, gradient 40 degrees over length 1
    SmoothOptions options = with("su2_midpoint");
    EXPECT_NEAR(smooth(mesh, constraints, field, options).objective, expected, 1e-9);
    options.midpoint_limit = std::numeric_limits<double>::infinity();
    EXPECT_GT(std::abs(smooth(mesh, constraints, field, options).objective - expected), 0.01 * expected);
}

// A cube whose boundary frames hold the direction from its centre: singular curves as in a ball.
TEST(MetricSmoothing, StaysNearTheFieldOfSh4RoundSingularCurvesWhereTheNaiveSchemeLeavesIt) {
    const TetMesh mesh = kuhn_cube(8);
    const BoundaryConstraints constraints =
        constraints_on(mesh, VertexConstraint::axis, testing::sample(mesh, [](const Vector3& x) {
                           return frames::frame_from_axes({1, 0.3, 0.2}, x - Vector3::Constant(0.5));
                       }));
    const SmoothResult start = frame_field(mesh, constraints).smooth;
    ASSERT_GT(singular_graph(mesh, start.frames).triangles.size(), 100u);
    for (const std::string& name : consistent) {
        SmoothOptions options = with(name);
        options.tolerance = 1e-7;
        const SmoothResult result = smooth(mesh, constraints, start.frames, options);
        EXPECT_TRUE(result.converged) << name;
        EXPECT_LT(result.energy, 1.06 * start.energy) << name;
        EXPECT_LT(mean_distance(result.frames, start.frames, constraints), 4 * degree) << name;
    }
    const SmoothResult naive = smooth(mesh, constraints, start.frames, with("su2"));
    EXPECT_GT(naive.energy, 1.3 * start.energy);
}

TEST(MetricSmoothing, EndsTheRecipe) {
    const TetMesh mesh = jittered_cube(5, 0.2, 34);
    const BoundaryConstraints constraints = constraints_on(mesh, VertexConstraint::fixed, smooth_field(mesh));
    const SmoothResult direct =
        smooth(mesh, constraints, frame_field(mesh, constraints).smooth.frames, with("geodesic"));
    FrameFieldOptions options;
    options.smooth = with("geodesic");
    const SmoothResult result = frame_field(mesh, constraints, options).smooth;
    EXPECT_NEAR(result.objective, direct.objective, 1e-9 * direct.objective);
    EXPECT_LT(largest_distance(result.frames, direct.frames), 1e-4);
}

TEST(MetricSmoothing, DoesNotDependOnTheInputsUnit) {
    const TetMesh mesh = jittered_cube(4, 0.2, 30);
    const BoundaryConstraints constraints = constraints_on(mesh, VertexConstraint::fixed, smooth_field(mesh));
    const Quaternions start = initial_frames(mesh, constraints);
    for (const char* name : {"geodesic", "su2_midpoint", "su2_frozen"}) {
        const SmoothResult reference = smooth(mesh, constraints, start, with(name));
        for (const double unit : {1e-6, 1e6}) {
            TetMesh scaled = mesh;
            scaled.vertices *= unit;
            const SmoothResult result = smooth(scaled, constraints, start, with(name));
            EXPECT_NEAR(result.objective / unit, reference.objective, 1e-8 * reference.objective) << name;
            EXPECT_LT(largest_distance(result.frames, reference.frames), 1e-4) << name;
        }
    }
}

TEST(MetricSmoothing, GivesTheSameBitsAtAnyThreadCount) {
    const TetMesh mesh = jittered_cube(9, 0.2, 31);
    const BoundaryConstraints constraints = constraints_on(mesh, VertexConstraint::axis, smooth_field(mesh));
    const Quaternions start = initial_frames(mesh, constraints, Start::constraints, 1);
    for (const char* name : {"geodesic", "su2_geodesic", "su2_midpoint", "su2_symmetric", "su2_frozen"}) {
        SmoothOptions options = with(name);
        options.max_iterations = 3;
        options.threads = 1;
        const SmoothResult one = smooth(mesh, constraints, start, options);
        options.threads = 3;
        const SmoothResult three = smooth(mesh, constraints, start, options);
        EXPECT_EQ(one.frames, three.frames) << name;
        EXPECT_EQ(one.energy_history, three.energy_history) << name;
        EXPECT_EQ(one.objective_history, three.objective_history) << name;
    }
}

TEST(MetricSmoothing, CancellingKeepsTheBestState) {
    const TetMesh mesh = jittered_cube(4, 0.2, 32);
    const BoundaryConstraints constraints = constraints_on(mesh, VertexConstraint::fixed, smooth_field(mesh));
    for (const char* name : {"geodesic", "su2_frozen"}) {
        int calls = 0;
        const SmoothResult result = smooth(mesh, constraints, frames::random_rotations(mesh.vertices.rows(), 33),
                                           with(name), [&](std::string_view, double, double) { return ++calls < 3; });
        EXPECT_EQ(calls, 3);
        EXPECT_EQ(result.message, "cancelled");
        EXPECT_FALSE(result.converged);
    }
}

TEST(MetricSmoothing, SaysWhatItCannotDo) {
    const TetMesh mesh = kuhn_cube(2);
    const Quaternions field = smooth_field(mesh);
    const BoundaryConstraints constraints = constraints_on(mesh, VertexConstraint::fixed, field);
    SmoothOptions options = with("geodesic");
    options.solver = SmoothSolver::trust_region;
    EXPECT_THROW(smooth(mesh, constraints, field, options), InvalidInput);
    FrameFieldOptions recipe;
    recipe.smooth = options;
    EXPECT_THROW(frame_field(mesh, constraints, recipe, [](std::string_view, double, double) { return false; }),
                 InvalidInput);  // before any work
    options = with("su2_midpoint");
    options.midpoint_limit = 0;
    EXPECT_THROW(smooth(mesh, constraints, field, options), InvalidInput);
    options.midpoint_limit = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(smooth(mesh, constraints, field, options), InvalidInput);
    options = {};
    options.representation = "su2_middle";
    try {
        smooth(mesh, constraints, field, options);
        FAIL();
    } catch (const InvalidInput& error) {
        for (const std::string& name : smooth_representations())
            EXPECT_NE(std::string(error.what()).find(name), std::string::npos);
    }
}

}  // namespace
}  // namespace octafield::volume
