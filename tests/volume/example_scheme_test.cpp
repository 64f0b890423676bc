// The scheme of docs/extend.md obeys every law that those of the library obey, and runs in their solver.
#include "../../studies/examples/new_scheme/sine.hpp"

#include "difference_laws.hpp"
#include "field_fixtures.hpp"
#include "metric_smoothing.hpp"

namespace octafield::volume {

INSTANTIATE_TYPED_TEST_SUITE_P(ExampleSine, DifferenceLaws, example::SineScheme);

TEST(ExampleSine, ReachesTheFieldOfTheGeodesicWhereAnglesAreSmall) {
    const TetMesh mesh = testing::jittered_cube(6, 0.2, 24);
    const Sampling sampling = vertex_sampling(mesh);
    const BoundaryConstraints constraints =
        testing::constraints_on(mesh, VertexConstraint::fixed, testing::smooth_field(mesh));
    const Quaternions start = initial_frames(sampling, constraints);
    const SmoothOptions options = {.representation = "geodesic", .solver = SmoothSolver::levenberg_marquardt};
    const SmoothResult sine = smooth_metric<example::SineScheme>(sampling, constraints, start, options, {}),
                       geodesic = smooth(sampling, constraints, start, options);
    EXPECT_TRUE(sine.converged);
    EXPECT_LT(sine.objective, geodesic.objective);  // 2 sin(t / 2) < t
    EXPECT_GT(sine.objective, 0.99 * geodesic.objective);
    EXPECT_LT(testing::largest_distance(sine.frames, geodesic.frames), 0.01);
    EXPECT_GT(testing::largest_distance(sine.frames, start), 1e-4);
}

}  // namespace octafield::volume
