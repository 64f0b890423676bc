// Sized fields on curved surfaces, and where sizes come from.
#include "alignment.hpp"
#include "octafield/surface/extended_region.hpp"
#include "octafield/surface/imposed_field.hpp"
#include "sized_fixtures.hpp"

namespace octafield::surface {
namespace {

TEST(SizedFieldOnSurfaces, AConstantSizeGivesTheSphereEightPoints) {
    const SurfaceDomain domain(icosphere(3));
    for (const int n : {4, 6}) {
        SizedFieldOptions options;
        options.symmetry = n;
        const SizedField field =
            sized_field(domain, wanted_sizes(domain, Eigen::VectorXd::Ones(domain.vertex_count())), options);
        EXPECT_EQ(sum_of(field.triangle_indices), 2 * n);
        EXPECT_NEAR(field.holonomy.sum(), n * 4 * pi, 1e-9);
        const auto points = surface_singularities(field.field);
        EXPECT_EQ(points.points.size(), static_cast<std::size_t>(2 * n));
        EXPECT_TRUE(points.agree);
        EXPECT_NEAR(field.eigenvalue, n, 0.03 * n);  // of a bundle of degree 2n on the sphere: |degree| / 2
    }
}

TEST(SizedFieldOnSurfaces, ATorusMeasuredSoThatItIsFlatHasAParallelField) {
    // Along the lines of curvature: sigma is the distance from the axis.
    const SurfaceDomain domain(torus(96, 48, 1, 0.4));
    const auto size = [](const Vector& x) { return std::hypot(x.x(), x.y()); };
    const SizedField flat = sized_field(domain, sizes_of(domain, size));
    const SizedField round = sized_field(domain, wanted_sizes(domain, Eigen::VectorXd::Ones(domain.vertex_count())));
    EXPECT_LT(flat.eigenvalue, 2e-3);
    EXPECT_GT(round.eigenvalue, 0.5);
    EXPECT_EQ(sum_of(flat.triangle_indices), 0);
    EXPECT_TRUE(surface_singularities(flat.field).points.empty());
    double most = 0;
    for (Index v = 0; v < domain.vertex_count(); ++v) {
        const Vector x = domain.mesh().vertices.row(v), d = flat.directions.row(v), first = flat.directions.row(0);
        const auto angle = [](const Vector& at, const Vector& along) {
            return 4 * std::acos(std::clamp(azimuth(at).dot(along), -1.0, 1.0));
        };
        most = std::max(most, std::abs(std::cos(angle(x, d)) - std::cos(angle(domain.mesh().vertices.row(0), first))));
    }
    EXPECT_LT(most, 0.02);
}

TEST(SizedFieldOnSurfaces, FeaturesAreFollowed) {
    const TriangleMesh cube = cube_surface(6);
    const FeatureGraph features = detect_features(cube);
    const SurfaceDomain domain(cube, features);
    const SizedField field = sized_field(domain, wanted_sizes(domain, Eigen::VectorXd::Ones(domain.vertex_count())));
    const auto points = surface_singularities(field.field);
    EXPECT_EQ(points.points.size(), 8u);
    EXPECT_TRUE(points.agree);
    for (Index e = 0; e < domain.edge_count(); ++e) {
        if (!domain.is_feature()[e]) continue;
        EXPECT_EQ(field.field.values[e], Complex(1, 0));
    }
    SizedFieldOptions odd;
    odd.symmetry = 3;
    EXPECT_THROW(sized_field(domain, wanted_sizes(domain, Eigen::VectorXd::Ones(domain.vertex_count())), odd),
                 InvalidInput);
}

TEST(ReachedSizes, AreThoseThatAnImposedFieldWasMadeFrom) {
    for (const SurfaceDomain& domain : {SurfaceDomain(disk(8)), SurfaceDomain(icosphere(2))}) {
        SingularPattern pattern;
        const auto found = surface_singularities(
            sized_field(domain, wanted_sizes(domain, Eigen::VectorXd::Ones(domain.vertex_count()))).field);
        for (const auto& point : found.points)
            if (!point.boundary)
                pattern.points.push_back(imposed_point(domain, point.position, point.index_times_symmetry));
        const ImposedField imposed = impose_singular_points(domain, pattern);
        const ReachedSizes reached = reached_sizes(imposed.field);
        EXPECT_LT(reached.misfit, 1e-6);
        const Eigen::VectorXd ratios = size_ratios(imposed.field.domain, reached, imposed.log_size.array().exp());
        for (const auto& fan : imposed.field.domain.fans().fans) EXPECT_NEAR(ratios[fan.vertex], 1, 1e-6);
    }
}

TEST(BoundarySizes, GrowByTheDistanceFromTheBoundarysEdges) {
    const SurfaceDomain domain(square(10));
    BoundarySizeOptions options;
    options.growth = 0.5;
    options.largest = 0.3;
    const Eigen::VectorXd sizes = boundary_sizes(domain, options);
    for (Index v = 0; v < sizes.size(); ++v) {
        const Vector x = domain.mesh().vertices.row(v);
        const double distance = std::min({x.x(), x.y(), 1 - x.x(), 1 - x.y()});
        EXPECT_NEAR(sizes[v], std::min(0.1 + 0.5 * distance, 0.3), 1e-12);
    }
    EXPECT_THROW(boundary_sizes(SurfaceDomain(icosphere(1))), InvalidInput);
}

TEST(ExtendedRegion, KeepsTheRegionAndFillsItsHolesAndWhatIsRoundIt) {
    TriangleMesh ring =
        plate(8, [](double x, double y) { return std::max(std::abs(x - 0.5), std::abs(y - 0.5)) > 0.2; });
    const Eigen::AngleAxisd turn(0.7, Vector(1, 2, 0.5).normalized());
    for (Index v = 0; v < ring.vertices.rows(); ++v)
        ring.vertices.row(v) = (turn * Vector(ring.vertices.row(v).transpose())).transpose();
    const SurfaceDomain region(ring);
    const ExtendedRegion extended = extended_region(region, 0.5, 0.2);
    const SurfaceDomain whole(extended.mesh);
    EXPECT_NEAR(whole.areas().sum(), 4, 1e-9);
    EXPECT_EQ(euler_characteristic(extended.mesh), 1);
    EXPECT_EQ(extended.mesh.triangles.topRows(extended.triangles), ring.triangles);
    EXPECT_EQ(extended.mesh.vertices.topRows(extended.vertices), ring.vertices);
    EXPECT_GT(whole.corner_angles().minCoeff(), 15 * testing::degree);
    for (Index t = 0; t < whole.triangle_count(); ++t)
        EXPECT_GT(whole.normals().row(t).dot(whole.normals().row(0)), 0.999);
    const Eigen::VectorXd sizes = extended_sizes(extended, Eigen::VectorXd::Constant(ring.vertices.rows(), 0.3));
    EXPECT_NEAR((sizes.array() - 0.3).abs().maxCoeff(), 0, 1e-12);
    EXPECT_THROW(extended_region(SurfaceDomain(icosphere(1))), InvalidInput);
}

TEST(ExtendedRegion, AFieldOfTheLargerMeshIsTakenBackAsItIs) {
    const SurfaceDomain region(disk(10));
    const ExtendedRegion extended = extended_region(region);
    const SurfaceDomain whole(extended.mesh);
    const auto bump = [](const Vector& x) { return std::exp(2 * std::pow(1 - x.squaredNorm(), 2)); };
    const Eigen::VectorXd sizes = extended_sizes(extended, at_points(region.mesh().vertices, bump));
    EXPECT_NEAR(sizes.tail(sizes.size() - extended.vertices).maxCoeff(), 1, 1e-12);
    const SizedField field = sized_field(whole, wanted_sizes(whole, sizes), unaligned());
    const DirectionField inside = restricted_field(field.field, region);
    const auto count = [&](const DirectionField& of) {
        int sum = 0;
        for (const auto& point : surface_singularities(of).points)
            if (!point.boundary && point.position.norm() < 0.55) sum += point.index_times_symmetry;
        return sum;
    };
    EXPECT_EQ(count(inside), count(field.field));
    const auto ends = region.topology().edges.row(7);
    const Index same = detail::find_edge(whole.topology(), ends[0], ends[1]);
    EXPECT_EQ(inside.values[7], field.field.values[same]);
    EXPECT_THROW(restricted_field(inside, SurfaceDomain(square(2))), InvalidInput);
}

}  // namespace
}  // namespace octafield::surface
