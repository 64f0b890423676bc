// Fields for sizes in the plane: exact ones, their sign, what published and derived numbers say.
#include "sized_fixtures.hpp"

namespace octafield::surface {
namespace {

double exponential(const Vector& x) { return std::exp(1.3 * x.x()); }

TEST(SizedField, AnExponentialSizeIsReachedToRoundingOnAnyMesh) {
    for (const unsigned seed : {1u, 2u}) {
        const SurfaceDomain domain(jittered_square(12, seed));
        const SizedField field = sized_field(domain, sizes_of(domain, exponential), unaligned());
        EXPECT_LT(std::abs(field.eigenvalue), 1e-9);
        EXPECT_LT(largest_error(field, [](const Vector& x) { return 1.3 * x.y(); }), 1e-9);
        EXPECT_GT(largest_error(field, [](const Vector& x) { return -1.3 * x.y(); }), 1);
        EXPECT_LT(field.holonomy.cwiseAbs().maxCoeff(), 1e-12);
        EXPECT_NEAR(field.least_length, 1, 1e-6);
        const ReachedSizes reached = reached_sizes(field.field);
        EXPECT_LT(reached.misfit, 1e-7);
        const Eigen::VectorXd ratios = size_ratios(domain, reached, at_points(domain.mesh().vertices, exponential));
        EXPECT_NEAR(ratios.minCoeff(), 1, 1e-7);
        EXPECT_NEAR(ratios.maxCoeff(), 1, 1e-7);
    }
}

TEST(SizedField, ALinearSizeHasTheDerivedEigenvalue) {
    const auto size = [](const Vector& x) { return 1 + x.x(); };
    const SurfaceDomain domain(jittered_square(32));
    for (const bool quadratic : {true, false}) {
        const WantedSizes sizes =
            quadratic ? sizes_of(domain, size) : wanted_sizes(domain, at_points(domain.mesh().vertices, size));
        const SizedField field = sized_field(domain, sizes, unaligned());
        EXPECT_NEAR(field.eigenvalue, 0.1352, quadratic ? 4e-4 : 2e-3);
        EXPECT_NEAR(field.least_length, 0.982, 2e-3);
        EXPECT_EQ(std::count(field.triangle_indices.begin(), field.triangle_indices.end(), 0), domain.triangle_count());
        EXPECT_TRUE(field.unresolved.empty());
    }
}

TEST(SizedField, AUnitStepAcrossAUnitGradientTurnsByOneRadian) {  // Simons 3.2.5.1: sigma = 1, gradient (1, 0)
    const SurfaceDomain domain(make_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}));
    const WantedSizes sizes = wanted_sizes(domain, Eigen::Vector3d(1, std::exp(1.0), 1));  // ln sigma = x
    const Edges& edges = domain.topology().edges;
    for (Index e = 0; e < 3; ++e) {
        const Vector along = domain.mesh().vertices.row(edges(e, 1)) - domain.mesh().vertices.row(edges(e, 0));
        EXPECT_NEAR(sizes.turns[e], along.y(), 1e-14);
    }
}

TEST(SizedField, HolonomyIsTheIntegralOfTheLaplacianOfLogSigma) {
    const auto size = [](const Vector& x) { return std::exp(0.3 * x.x() * x.x() + 0.2 * x.x() * x.y() - x.y()); };
    const SurfaceDomain domain(jittered_square(6));
    const Eigen::VectorXd areas = domain.areas();
    for (const int n : {1, 4, 6}) {
        SizedFieldOptions options = unaligned();
        options.symmetry = n;
        const SizedField field = sized_field(domain, sizes_of(domain, size), options);
        EXPECT_LT((field.holonomy - n * 0.6 * areas).cwiseAbs().maxCoeff(), 1e-12);
    }
}

TEST(SizedField, TheSizeOfAValenceThreePointHasItsField) {
    const auto size = [](const Vector& x) { return 4.0 / 3 * std::pow(x.norm(), 0.25); };
    TriangleMesh mesh = disk(24);
    mesh.vertices.col(0).array() += 0.011;  // the point in a triangle
    mesh.vertices.col(1).array() += 0.004;
    const SurfaceDomain domain(mesh);
    const SizedField field = sized_field(domain, sizes_of(domain, size), unaligned());
    EXPECT_EQ(sum_of(field.triangle_indices), 1);
    const auto quarter = [](const Vector& x) { return std::arg(flat(x)) / 4; };
    EXPECT_LT(largest_error(field, quarter), 0.4);  // beside the point, where ln sigma is no polynomial
    EXPECT_LT(largest_error(field, quarter, 0.2), 0.05);
    const auto points = surface_singularities(field.field).points;
    std::vector<SurfaceSingularity> inside;
    for (const auto& point : points)
        if (!point.boundary) inside.push_back(point);
    ASSERT_EQ(inside.size(), 1u);
    EXPECT_EQ(inside[0].index_times_symmetry, 1);
    EXPECT_LT(inside[0].position.norm(), 0.05);
}

TEST(SizedField, AValenceSixPointSampledAtVerticesIsAValenceThreeAndThreeValenceFivePoints) {  // Simons, figure 3.10
    TriangleMesh mesh =
        make_mesh({{0, 1, 0}, {-0.87, -0.5, 0}, {0.87, -0.5, 0}, {0, -2, 0}, {1.74, 1, 0}, {-1.74, 1, 0}},
                  {{0, 1, 2}, {1, 3, 2}, {0, 2, 4}, {0, 5, 1}});
    const SurfaceDomain domain(mesh);
    const detail::VertexCharts charts(domain);
    const detail::SizedConnection flat_connection(domain, charts, Eigen::VectorXd::Zero(domain.edge_count()), 4);
    Eigen::VectorXcd values(domain.vertex_count());
    for (Index v = 0; v < values.size(); ++v) {
        const double angle = -std::arg(flat(mesh.vertices.row(v))) / 2;  // index -1/2
        values[v] = std::polar(1.0, 4 * charts.lowered(v, Eigen::RowVector3d(std::cos(angle), std::sin(angle), 0)));
    }
    EXPECT_EQ(detail::turned_triangles(domain, flat_connection, values), (std::vector<int>{1, -1, -1, -1}));
}

TEST(SizedField, HolomorphicAndAntiholomorphicFieldsCostNothingInTheirEnergy) {
    const SurfaceDomain domain(jittered_square(5));
    const detail::VertexCharts charts(domain);
    const detail::SizedConnection connection(domain, charts, Eigen::VectorXd::Zero(domain.edge_count()), 1);
    for (const double s : {1.0, -1.0}) {
        const detail::SizedSystem system(domain, connection, s);
        for (const bool conjugate : {false, true}) {
            Eigen::VectorXcd u(domain.vertex_count());
            for (Index v = 0; v < u.size(); ++v) {
                const Complex z = flat(domain.mesh().vertices.row(v)), value = conjugate ? std::conj(z) : z;
                u[system.row[v]] =
                    std::polar(std::abs(value), charts.lowered(v, Eigen::RowVector3d(value.real(), value.imag(), 0)));
            }
            const Complex cost = u.dot(system.energy.selfadjointView<Eigen::Lower>() * u);
            EXPECT_NEAR(cost.real(), (s > 0) == conjugate ? 4 : 0, 1e-12) << s << conjugate;
        }
    }
}

TEST(SizedField, TheMetricOfTheSizesOnEdgesGivesTheSameField) {
    const auto size = [](const Vector& x) { return 1 + 0.8 * x.x() * x.x() + 0.5 * x.y(); };
    const SurfaceDomain domain(jittered_square(24));
    const Eigen::VectorXd lengths = at_points(domain.mesh().vertices, size);
    const SizedField ours = sized_field(domain, sizes_of(domain, size), unaligned());
    DirectionFieldOptions options;
    options.method = "eigen";
    options.boundary_alignment = Alignment::none;
    const DirectionField other = direction_field(sized_domain(domain, lengths), options);
    Complex mean = 0;
    for (Index e = 0; e < other.values.size(); ++e) mean += other.values[e] * std::conj(ours.field.values[e]);
    double most = 0;
    for (Index e = 0; e < other.values.size(); ++e)
        most = std::max(most, std::abs(std::arg(other.values[e] * std::conj(ours.field.values[e] * mean))));
    EXPECT_LT(most / 4, 1.5 * testing::degree);
    EXPECT_GT(std::abs(mean) / other.values.size(), 0.999);
}

TEST(SizedField, StrongAlignmentFollowsTheBoundaryAndWeakAlignmentNearlyDoes) {
    const SurfaceDomain domain(disk(12));
    const WantedSizes sizes = wanted_sizes(domain, Eigen::VectorXd::Ones(domain.vertex_count()));
    SizedFieldOptions options;
    const auto strong = surface_singularities(sized_field(domain, sizes, options).field);
    EXPECT_EQ(index_sum(strong.points), 4);
    EXPECT_EQ(strong.boundary_deviation, 0);
    EXPECT_TRUE(strong.agree);
    options.boundary_alignment = Alignment::weak;
    double before = 1;
    for (const double shift : {-10.0, -1000.0, -1e5}) {  // the lower, the nearer
        options.shift = shift;
        const auto weak = surface_singularities(sized_field(domain, sizes, options).field);
        EXPECT_EQ(weak.index_sum, 1);
        EXPECT_LT(weak.boundary_deviation, before);
        before = weak.boundary_deviation + 1e-9;
    }
    EXPECT_LT(before, 0.05);
    options.shift = 1e6;
    EXPECT_THROW(sized_field(domain, sizes, options), SolverError);
}

TEST(SizedField, GivenDirectionsAreHeldOrFollowed) {
    const SurfaceDomain domain(jittered_square(10));
    const WantedSizes sizes = wanted_sizes(domain, Eigen::VectorXd::Ones(domain.vertex_count()));
    SizedFieldOptions options = unaligned();
    options.directions = Points::Zero(domain.vertex_count(), 3);
    options.weights = Eigen::VectorXd::Zero(domain.vertex_count());
    options.directions.row(40) << std::cos(0.3), std::sin(0.3), 0.0;
    options.weights[40] = INFINITY;
    EXPECT_LT(largest_error(sized_field(domain, sizes, options), [](const Vector&) { return 0.3; }), 1e-5);
    for (const double given : {0.3, 0.9}) {
        options.weights.setOnes();
        for (Index v = 0; v < domain.vertex_count(); ++v)
            options.directions.row(v) << std::cos(given * domain.mesh().vertices(v, 0)),
                std::sin(given * domain.mesh().vertices(v, 0)), 0.0;
        options.shift = -1e7;
        EXPECT_LT(largest_error(sized_field(domain, sizes, options), [=](const Vector& x) { return given * x.x(); }),
                  1e-2);
    }
}

TEST(SizedField, BadInputIsRefused) {
    const SurfaceDomain domain(square(3));
    const Eigen::VectorXd ones = Eigen::VectorXd::Ones(domain.vertex_count());
    const auto kind = [](const auto& call) {
        try {
            call();
        } catch (const Error& error) {
            return error.kind();
        }
        return std::string("none");
    };
    Eigen::VectorXd bad = ones;
    bad[3] = NAN;
    EXPECT_EQ(kind([&] { wanted_sizes(domain, bad); }), "bad_size");
    bad[3] = 0;
    EXPECT_EQ(kind([&] { wanted_sizes(domain, bad); }), "bad_size");
    EXPECT_EQ(kind([&] { wanted_sizes(domain, ones.head(4)); }), "wrong_size");
    WantedSizes sizes = wanted_sizes(domain, ones);
    SizedFieldOptions options;
    options.s = 1.5;
    EXPECT_EQ(kind([&] { sized_field(domain, sizes, options); }), "bad_option");
    options = {};
    options.directions = Points::Zero(domain.vertex_count(), 3);
    EXPECT_EQ(kind([&] { sized_field(domain, sizes, options); }), "not_tangent");
    options.directions(2, 0) = NAN;
    EXPECT_EQ(kind([&] { sized_field(domain, sizes, options); }), "not_finite");
    sizes.turns[0] = INFINITY;
    EXPECT_EQ(kind([&] { sized_field(domain, sizes); }), "bad_turns");
    EXPECT_EQ(kind([&] { sized_field(SurfaceDomain(), {}); }), "empty");
    EXPECT_EQ(kind([&] { sized_field(sized_domain(domain, ones), wanted_sizes(domain, ones)); }), "own_lengths");
}

}  // namespace
}  // namespace octafield::surface
