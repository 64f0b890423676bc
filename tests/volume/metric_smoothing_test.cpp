// Smoothing in metrics on frames: what is consistent, and what is not (docs/su2_smoothing.md).

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "difference_laws.hpp"
#include "field_fixtures.hpp"
#include "frame_difference.hpp"
#include "octafield/frames/geodesic.hpp"
#include "octafield/frames/registry.hpp"
#include "octafield/volume/frame_field.hpp"
#include "octafield/volume/operators.hpp"
#include "octafield/volume/schemes.hpp"
#include "octafield/volume/singularities.hpp"

namespace octafield::volume {
namespace {

using frames::Quaternion;
using frames::Vector3;
using testing::constraints_on;
using testing::degree;
using testing::jittered_cube;
using testing::kuhn_cube;
using testing::largest_distance;
using testing::row;
using testing::smooth_field;

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

}  // namespace
template <>
inline constexpr double derivative_error<GeodesicScheme> = 1e-8;
template <>
inline constexpr double derivative_error<Su2GeodesicScheme> = 1e-8;
template <>
inline constexpr double derivative_error<MidpointScheme> = 1e-6;
namespace {

INSTANTIATE_TYPED_TEST_SUITE_P(Geodesic, DifferenceLaws, GeodesicScheme);
INSTANTIATE_TYPED_TEST_SUITE_P(Su2Geodesic, DifferenceLaws, Su2GeodesicScheme);
INSTANTIATE_TYPED_TEST_SUITE_P(Surface, DifferenceLaws, SurfaceScheme);
INSTANTIATE_TYPED_TEST_SUITE_P(Midpoint, DifferenceLaws, MidpointScheme);
INSTANTIATE_TYPED_TEST_SUITE_P(Symmetric, DifferenceLaws, SymmetricScheme);
// Without a limit; the frozen scheme's metric has nothing to compare with.
struct MidpointWithoutLimit : MidpointScheme {
    static MidpointWithoutLimit made(const SmoothOptions&) { return {{std::numeric_limits<double>::infinity()}}; }
};
INSTANTIATE_TYPED_TEST_SUITE_P(MidpointWithoutLimit, DifferenceLaws, MidpointWithoutLimit);

// Names of the metrics in the table for which a property holds: a new row joins by itself.
template <class Property>
std::vector<std::string> metrics_that(const Property& property) {
    std::vector<std::string> names;
    for (const Scheme& each : schemes())
        if (each.sort == SchemeSort::metric && property(each)) names.push_back(each.name);
    return names;
}
std::string name_of(const ::testing::TestParamInfo<std::string>& info) { return info.param; }

class EveryMetric : public ::testing::TestWithParam<std::string> {};
class EveryConsistentMetric : public EveryMetric {
protected:
    // Of errors: one scheme has three times those of the others (docs/su2_smoothing.md).
    const double allowed = GetParam() == "su2_symmetric" ? 3 : 1;
};
class EveryDescendingMetric : public EveryMetric {};
INSTANTIATE_TEST_SUITE_P(Table, EveryMetric, ::testing::ValuesIn(metrics_that([](const Scheme&) { return true; })),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Table, EveryConsistentMetric,
                         ::testing::ValuesIn(metrics_that([](const Scheme& s) { return s.consistent; })), name_of);
INSTANTIATE_TEST_SUITE_P(Table, EveryDescendingMetric,
                         ::testing::ValuesIn(metrics_that([](const Scheme& s) { return s.descends; })), name_of);

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

TEST_P(EveryConsistentMetric, ConvergesToTheMinimiserOfSh4AtSecondOrder) {
    const double coarse = deviation(GetParam(), 4), fine = deviation(GetParam(), 8);
    EXPECT_LT(fine, (allowed == 1 ? 0.3 : 0.33) * coarse);  // 0.25 at second order
    EXPECT_LT(fine, allowed * 0.15 * degree);
}

// The naive embedding and the frozen metric, by the table.
TEST(MetricSmoothing, InconsistentSchemesDoNotConvergeToIt) {
    int tested = 0;
    for (const Scheme& each : schemes()) {
        if (each.consistent || each.sort == SchemeSort::embedding_with_lengths) continue;
        const double coarse = deviation(each.name, 4), fine = deviation(each.name, 8);
        EXPECT_GT(fine, 0.6 * coarse) << each.name;
        EXPECT_GT(fine, 1 * degree) << each.name;
        ++tested;
    }
    EXPECT_GE(tested, 2);
}

TEST_P(EveryConsistentMetric, DoesNotDependOnTheRepresentativesOfTheStart) {
    const TetMesh mesh = jittered_cube(5, 0.2, 22);
    const BoundaryConstraints constraints = constraints_on(mesh, VertexConstraint::fixed, smooth_field(mesh));
    const Quaternions start = initial_frames(mesh, constraints);
    const SmoothResult reference = smooth(mesh, constraints, start, with(GetParam()));
    const SmoothResult other = smooth(mesh, constraints, in_random_representatives(start, 23), with(GetParam()));
    EXPECT_LT(largest_distance(reference.frames, other.frames), 1e-5);
    EXPECT_NEAR(reference.objective, other.objective, 1e-9 * reference.objective);
}

// The jitter makes obtuse tets, which are kept whole. The start is rough for the metrics but not for sh4.
TEST_P(EveryConsistentMetric, ReachesTheSameFieldOnObtuseMeshesFromANoisyStart) {
    const TetMesh mesh = jittered_cube(6, 0.2, 24);
    const BoundaryConstraints constraints = constraints_on(mesh, VertexConstraint::fixed, smooth_field(mesh));
    const Quaternions reference = smooth(mesh, constraints, smooth_field(mesh), with("sh4")).frames;
    const Quaternions start = in_random_representatives(noisy(smooth_field(mesh), 0.05, 25), 26);
    const SmoothResult result = smooth(mesh, constraints, start, with(GetParam()));
    EXPECT_TRUE(result.converged);
    EXPECT_LT(mean_distance(result.frames, reference, constraints), allowed * 0.3 * degree);
    // Unit speed: 3/20.
    EXPECT_NEAR(result.objective, 0.15 * result.energy, (allowed == 1 ? 0.04 : 0.126) * result.objective);
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

TEST_P(EveryDescendingMetric, NeverRaisesItsObjectiveAndHoldsConstraintsExactly) {
    const TetMesh mesh = jittered_cube(4, 0.2, 28);
    const Quaternions start = frames::random_rotations(mesh.vertices.rows(), 29);
    const BoundaryConstraints constraints = constraints_on(mesh, VertexConstraint::axis, smooth_field(mesh));
    for (const SmoothSolver solver : {SmoothSolver::levenberg_marquardt, SmoothSolver::lbfgs}) {
        SmoothOptions options = with(GetParam());
        options.solver = solver;
        const SmoothResult result = smooth(mesh, constraints, start, options);
        for (std::size_t i = 1; i < result.objective_history.size(); ++i)
            EXPECT_LE(result.objective_history[i], result.objective_history[i - 1] * (1 + 1e-12));
        options.max_iterations = 0;
        EXPECT_NEAR(smooth(mesh, constraints, result.frames, options).objective, result.objective,
                    1e-9 * result.objective);
        EXPECT_NEAR(result.energy, dirichlet_energy(mesh, result.frames), 1e-12 * result.energy);
        for (Eigen::Index v = 0; v < start.rows(); ++v) {
            if (constraints.kind[v] != VertexConstraint::axis) continue;
            const Vector3 in_frame = row(result.frames, v).conjugate() * Vector3(constraints.axis.row(v).transpose());
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
struct RoundACentre {
    const TetMesh mesh = kuhn_cube(8);
    const BoundaryConstraints constraints =
        constraints_on(mesh, VertexConstraint::axis, testing::sample(mesh, [](const Vector3& x) {
                           return frames::frame_from_axes({1, 0.3, 0.2}, x - Vector3::Constant(0.5));
                       }));
    const SmoothResult start = frame_field(mesh, constraints).smooth;
};

TEST_P(EveryConsistentMetric, StaysNearTheFieldOfSh4RoundSingularCurves) {
    const RoundACentre part;
    ASSERT_GT(singular_graph(part.mesh, part.start.frames).triangles.size(), 100u);
    SmoothOptions options = with(GetParam());
    options.tolerance = 1e-7;
    const SmoothResult result = smooth(part.mesh, part.constraints, part.start.frames, options);
    EXPECT_TRUE(result.converged);
    EXPECT_LT(result.energy, (allowed == 1 ? 1.06 : 1.22) * part.start.energy);
    EXPECT_LT(mean_distance(result.frames, part.start.frames, part.constraints), allowed * 4 * degree);
}

TEST(MetricSmoothing, TheNaiveSchemeLeavesTheFieldOfSh4RoundSingularCurves) {
    const RoundACentre part;
    EXPECT_GT(smooth(part.mesh, part.constraints, part.start.frames, with("su2")).energy, 1.3 * part.start.energy);
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

TEST_P(EveryMetric, DoesNotDependOnTheInputsUnit) {
    const TetMesh mesh = jittered_cube(4, 0.2, 30);
    const BoundaryConstraints constraints = constraints_on(mesh, VertexConstraint::fixed, smooth_field(mesh));
    const Quaternions start = initial_frames(mesh, constraints);
    const SmoothResult reference = smooth(mesh, constraints, start, with(GetParam()));
    for (const double unit : {1e-6, 1e6}) {
        TetMesh scaled = mesh;
        scaled.vertices *= unit;
        const SmoothResult result = smooth(scaled, constraints, start, with(GetParam()));
        EXPECT_NEAR(result.objective / unit, reference.objective, 1e-8 * reference.objective);
        EXPECT_LT(largest_distance(result.frames, reference.frames), 1e-4);
    }
}

TEST_P(EveryMetric, GivesTheSameBitsAtAnyThreadCount) {
    const TetMesh mesh = jittered_cube(9, 0.2, 31);
    const BoundaryConstraints constraints = constraints_on(mesh, VertexConstraint::axis, smooth_field(mesh));
    const Quaternions start = initial_frames(mesh, constraints, Start::constraints, 1);
    SmoothOptions options = with(GetParam());
    options.max_iterations = 3;
    options.threads = 1;
    const SmoothResult one = smooth(mesh, constraints, start, options);
    options.threads = 3;
    const SmoothResult three = smooth(mesh, constraints, start, options);
    EXPECT_EQ(one.frames, three.frames);
    EXPECT_EQ(one.energy_history, three.energy_history);
    EXPECT_EQ(one.objective_history, three.objective_history);
}

TEST_P(EveryMetric, CancellingKeepsTheBestState) {
    const TetMesh mesh = jittered_cube(4, 0.2, 32);
    const BoundaryConstraints constraints = constraints_on(mesh, VertexConstraint::fixed, smooth_field(mesh));
    int calls = 0;
    const SmoothResult result = smooth(mesh, constraints, frames::random_rotations(mesh.vertices.rows(), 33),
                                       with(GetParam()), [&](std::string_view, double, double) { return ++calls < 3; });
    EXPECT_EQ(calls, 3);
    EXPECT_EQ(result.message, "cancelled");
    EXPECT_FALSE(result.converged);
}

TEST_P(EveryMetric, RefusesTheTrustRegionBeforeAnyWork) {
    const TetMesh mesh = kuhn_cube(2);
    const BoundaryConstraints constraints = constraints_on(mesh, VertexConstraint::fixed, smooth_field(mesh));
    FrameFieldOptions recipe;
    recipe.smooth = with(GetParam());
    recipe.smooth.solver = SmoothSolver::trust_region;
    EXPECT_THROW(smooth(mesh, constraints, smooth_field(mesh), recipe.smooth), InvalidInput);
    EXPECT_THROW(frame_field(mesh, constraints, recipe, [](std::string_view, double, double) { return false; }),
                 InvalidInput);
}

TEST(MetricSmoothing, SaysWhatItCannotDo) {
    const TetMesh mesh = kuhn_cube(2);
    const Quaternions field = smooth_field(mesh);
    const BoundaryConstraints constraints = constraints_on(mesh, VertexConstraint::fixed, field);
    SmoothOptions options = with("su2_midpoint");
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
        for (const Scheme& each : schemes()) EXPECT_NE(std::string(error.what()).find(each.name), std::string::npos);
    }
}

}  // namespace
}  // namespace octafield::volume
