// Diffusion and projection (mbo) beside the other methods, continuation, coherence length as a field.
#include "direction_field_fixtures.hpp"

namespace octafield::surface {
namespace {

constexpr const char* eigenvector = "eigen";

DirectionField computed(const TriangleMesh& mesh, const std::string& method, int symmetry = 4) {
    return direction_field(mesh, {.symmetry = symmetry, .method = method});
}

// ---- diffusion and projection ----

TEST(DiffusedField, HasLengthOneAndLessEnergyThanTheEigenvector) {
    for (const TriangleMesh& mesh : {icosphere(4), disk(24), torus(80, 40, 1, 0.5)}) {
        const DirectionField field = computed(mesh, mbo), start = computed(mesh, eigenvector);
        EXPECT_TRUE(field.converged);
        EXPECT_NEAR((field.values.cwiseAbs().array() - 1).abs().maxCoeff(), 0, 1e-14);
        EXPECT_LT(field.dirichlet_energy, start.dirichlet_energy);
        EXPECT_NEAR(field.energy, field.dirichlet_energy, 1e-9 * field.energy);
        EXPECT_LE(surface_singularities(field).points.size(), surface_singularities(start).points.size());
    }
}

TEST(DiffusedField, OnTheSphereItNeedsNoFixedEdgeAndHasTheFewestPoints) {
    const TriangleMesh mesh = icosphere(4);
    for (const int symmetry : {1, 2, 4, 6}) {
        const auto points = surface_singularities(computed(mesh, mbo, symmetry)).points;
        ASSERT_EQ(points.size(), static_cast<std::size_t>(2 * symmetry));
        for (const auto& point : points) EXPECT_EQ(point.index_times_symmetry, 1);
        // Far apart: at least 3/4 of the nearest distances at the minimum of the logarithmic energy.
        const double optimum[] = {0, 2, 1.633, 0, 1.1672, 0, 1.05146};
        EXPECT_GT(sorted_distances(points).front(), 0.75 * optimum[symmetry]);
    }
}

TEST(DiffusedField, OnTheDiskItsPointsAreNearThePublishedRadius) {
    for (const auto& [symmetry, radius] : {std::pair(4, 0.8501), std::pair(6, 0.9031)}) {
        const auto points = surface_singularities(computed(disk(30), mbo, symmetry)).points;
        ASSERT_EQ(points.size(), static_cast<std::size_t>(symmetry));
        for (const auto& point : points) EXPECT_NEAR(point.position.norm(), radius, 2.0 / 30);  // two edges
    }
}

TEST(DiffusedField, IsALocalMinimumAmongFieldsOfLengthOne) {
    for (const auto boundary : {Alignment::strong, Alignment::weak})
        for (const TriangleMesh& mesh : {icosphere(4), disk(24), torus(80, 40, 1, 0.5)}) {
            const DirectionField field = direction_field(mesh, {.method = mbo, .boundary_alignment = boundary});
            ASSERT_TRUE(field.converged);
            const auto links = detail::corner_links(field.domain, 4);
            const auto is_free = [&](Index e) { return field.domain.topology().edge_triangles.row(e).minCoeff() >= 0; };
            std::mt19937 random(5);
            std::uniform_real_distribution<double> turn(-1, 1);
            const auto energy = [&](const Eigen::VectorXcd& values) { return detail::dirichlet_energy(links, values); };
            for (int i = 0; i < 5; ++i) {
                Eigen::VectorXcd values = field.values;
                for (Index e = 0; e < values.size(); ++e)
                    if (is_free(e)) values[e] *= std::polar(1.0, 0.01 * turn(random));
                EXPECT_GT(energy(values), field.dirichlet_energy);
            }
            // One edge by any angle.
            for (Index e = 0; e < field.values.size(); e += 7)
                for (const double angle : {-1.0, -0.1, 0.1, 1.0, pi}) {
                    Eigen::VectorXcd values = field.values;
                    if (is_free(e)) values[e] *= std::polar(1.0, angle);
                    EXPECT_GE(energy(values), field.dirichlet_energy * (1 - 1e-9));
                }
        }
}

TEST(DiffusedField, EndsBelowItsDiffusedStateAndNeverRisesAfterIt) {
    const TriangleMesh mesh = disk(24);
    const DirectionField field = computed(mesh, mbo);
    const auto& history = field.energy_history;
    // The descent begins where the steps of diffusion, which may raise the energy a little at first, are over.
    EXPECT_TRUE(std::is_sorted(history.rbegin(), history.rbegin() + 5));
    EXPECT_NEAR(history.back(), *std::min_element(history.begin(), history.end()), 1e-12 * history.back());
    EXPECT_LT(field.dirichlet_energy, 0.99 * history[history.size() / 2]);
}

// A prism with `around` sides, open at both ends: its sides unroll into a plane, its rims into straight lines.
TriangleMesh tube(int around, int rings, double height) {
    std::vector<Vector> points;
    std::vector<Eigen::Vector3i> triangles;
    for (int j = 0; j <= rings; ++j)
        for (int i = 0; i < around; ++i)
            points.emplace_back(std::cos(2 * pi * i / around), std::sin(2 * pi * i / around), height * j / rings);
    for (int j = 0; j < rings; ++j)
        for (int i = 0; i < around; ++i) {
            const int a = j * around + i, b = j * around + (i + 1) % around;
            triangles.insert(triangles.end(), {{a, b, b + around}, {a, b + around, a + around}});
        }
    return make_mesh(points, triangles);
}

TEST(DiffusedField, AParallelFieldIsFound) {
    // On a flat square with free boundary, and on a tube whose rims are followed, along and round it.
    const TriangleMesh square = plate(8, [](double, double) { return true; }), open = tube(20, 6, 1.5);
    for (const auto method : {mbo, eigenvector}) {
        EXPECT_NEAR(direction_field(square, {.method = method, .boundary_alignment = Alignment::none}).dirichlet_energy,
                    0, 1e-9);
        const DirectionField field = direction_field(open, {.method = method});
        EXPECT_NEAR(field.dirichlet_energy, 0, 1e-9);
        EXPECT_TRUE(surface_singularities(field).points.empty());
        const auto along = prescribed(
            open, 4, [](auto&) -> Vector { return Vector::UnitZ(); },
            [](const Vector& x) -> Vector {  // of the side on which the midpoint lies, or of both where they meet
                return {x.x(), x.y(), 0};
            });
        for (Index e = 0; e < field.values.size(); ++e)
            EXPECT_NEAR(std::abs(field.values[e] - along.values[e]), 0, 1e-5) << e;
    }
}

// Beaufort, thesis section 3.9: no singular point once epsilon is small. The energy is that of the curvature lines.
TEST(EveryMethod, FindsTheFieldWithoutPointsOnATorusWhereItCostsLess) {
    const TriangleMesh mesh = torus(96, 48, 1, 0.5);
    const double exact = 32 * std::pow(std::numbers::pi, 2) * (2 - std::sqrt(3.0));
    const DirectionField diffused = computed(mesh, mbo);
    EXPECT_TRUE(surface_singularities(diffused).points.empty());
    EXPECT_LT(diffused.energy, 1.001 * exact);
    EXPECT_GT(diffused.energy, 0.98 * exact);
    const DirectionField fine = direction_field(mesh, {.epsilon = 0.03}),
                         wide = direction_field(mesh, {.epsilon = 0.12});
    EXPECT_TRUE(surface_singularities(fine).points.empty());
    EXPECT_EQ(surface_singularities(wide).points.size(), 12u);
}

TEST(DiffusedField, HistoryIterationsAndProgressBelongTogether) {
    const TriangleMesh mesh = icosphere(3);
    std::vector<double> told;
    double last = 0;
    const DirectionField field =
        direction_field(mesh, {.method = mbo}, [&](std::string_view, double fraction, double energy) {
            if (std::isnan(energy)) return true;
            EXPECT_GE(fraction, last);
            EXPECT_LE(last = fraction, 1);
            told.push_back(energy);
            return true;
        });
    EXPECT_EQ(field.energy_history.size(), static_cast<std::size_t>(field.iterations) + 1);
    EXPECT_EQ(std::vector<double>(field.energy_history.begin() + 1, field.energy_history.end()), told);
    EXPECT_NEAR(field.energy, told.back(), 1e-9 * field.energy);
    const DirectionField cut = direction_field(mesh, {.method = mbo, .max_iterations = 2});
    EXPECT_EQ(cut.iterations, 2);
    EXPECT_FALSE(cut.converged);
}

TEST(DiffusedField, CancellingKeepsAField) {
    int calls = 0;
    const DirectionField field =
        direction_field(icosphere(3), {.method = mbo}, [&](auto, double, double) { return ++calls < 12; });
    EXPECT_FALSE(field.converged);
    EXPECT_EQ(calls, 12);
    EXPECT_NEAR((field.values.cwiseAbs().array() - 1).abs().maxCoeff(), 0, 1e-14);
}

// ---- all methods ----

TEST(EveryMethod, GivesTheSameBitsForTheSameInput) {
    const TriangleMesh mesh = icosphere(3);
    for (const auto method : {mbo, eigenvector, "gl"})
        EXPECT_TRUE(computed(mesh, method).values == computed(mesh, method).values);
}

TEST(EveryMethod, DoesNotDependOnTheLengthUnit) {
    const TriangleMesh unit = disk(12);
    for (const auto method : {mbo, eigenvector, "gl"})
        for (const auto boundary : {Alignment::strong, Alignment::weak}) {
            const DirectionFieldOptions options{.method = method, .boundary_alignment = boundary};
            const double energy = direction_field(unit, options).energy;
            for (const double scale : {1e-6, 1e6}) {
                TriangleMesh mesh = unit;
                mesh.vertices *= scale;
                EXPECT_NEAR(direction_field(mesh, options).energy, energy, 1e-4 * energy);
            }
        }
}

TEST(EveryMethod, TakesStripsOneTriangleWideAndNeedles) {
    std::vector<Vector> points;
    std::vector<Eigen::Vector3i> triangles;
    for (int i = 0; i <= 40; ++i) {
        const double angle = 2 * pi * i / 60;
        points.insert(points.end(), {Vector(std::cos(angle), std::sin(angle), 0),
                                     Vector(1.02 * std::cos(angle), 1.02 * std::sin(angle), 0)});
        if (i > 0) triangles.insert(triangles.end(), {{2 * i - 2, 2 * i - 1, 2 * i}, {2 * i - 1, 2 * i + 1, 2 * i}});
    }
    const TriangleMesh strip = make_mesh(points, triangles);
    TriangleMesh needles = disk(10);
    needles.vertices.col(1) *= 1e-4;
    TriangleMesh squashed = icosphere(3);
    squashed.vertices.col(2) *= 1e-3;
    for (const auto method : {mbo, eigenvector, "gl"})
        for (const TriangleMesh& mesh : {strip, needles, squashed}) {
            const DirectionField field = computed(mesh, method);
            EXPECT_TRUE(field.values.array().isFinite().all());
            EXPECT_EQ(index_sum(surface_singularities(field).points), 4 * euler_characteristic(mesh));
        }
}

TEST(EveryMethod, TakesComponentsOfVeryDifferentSizeWithTheirOwnTimeSteps) {
    TriangleMesh small = icosphere(3);
    small.vertices *= 1e-3;
    const TriangleMesh mesh = joined({icosphere(3), small});
    const auto points = surface_singularities(computed(mesh, mbo)).points;
    EXPECT_EQ(points.size(), 16u);
}

// ---- Ginzburg-Landau: continuation and coherence length ----

TEST(Continuation, EndsNoHigherThanADescentFromTheEigenvector) {
    for (const TriangleMesh& mesh : {icosphere(4), torus(60, 30, 1, 0.5), disk(20)}) {
        const double epsilon = 2 * mean_edge_length(mesh);
        const double with = direction_field(mesh, {.epsilon = epsilon}).energy;
        const double without = direction_field(mesh, {.epsilon = epsilon, .first_epsilon = epsilon}).energy;
        EXPECT_LE(with, without * (1 + 1e-4));
    }
}

TEST(CoherenceLength, AConstantFieldIsTheSameAsOneNumber) {
    const TriangleMesh mesh = disk(12);
    const Eigen::VectorXd constant = Eigen::VectorXd::Constant(edge_topology(mesh).edges.rows(), 0.1);
    const DirectionField one = direction_field(mesh, {.epsilon = 0.1}),
                         each = direction_field(mesh, {.edge_epsilon = constant});
    EXPECT_TRUE(one.values == each.values);
    EXPECT_EQ(each.epsilon, 0.1);
}

TEST(CoherenceLength, CoresAreWideWhereItIsLong) {
    // 0.2 on the left half, 0.06 on the right: area where |f| < 0.7 round the two points of either half.
    const TriangleMesh mesh = disk(30);
    const EdgeTopology topology = edge_topology(mesh);
    const auto x = [&](Index e) {
        return (mesh.vertices(topology.edges(e, 0), 0) + mesh.vertices(topology.edges(e, 1), 0)) / 2;
    };
    Eigen::VectorXd epsilon(topology.edges.rows());
    for (Index e = 0; e < epsilon.size(); ++e) epsilon[e] = x(e) < 0 ? 0.2 : 0.06;
    const DirectionField field = direction_field(mesh, {.edge_epsilon = epsilon});
    const Eigen::VectorXd masses = detail::edge_masses(mesh);
    double left = 0, right = 0;
    for (Index e = 0; e < epsilon.size(); ++e)
        if (std::abs(field.values[e]) < 0.7) (x(e) < 0 ? left : right) += masses[e];
    EXPECT_GT(left, 2 * right);
    EXPECT_EQ(field.epsilon, 0.06);
}

TEST(CoherenceLength, RefusesFieldsThatDoNotFit) {
    const TriangleMesh mesh = disk(4);
    const Eigen::Index edges = edge_topology(mesh).edges.rows();
    Eigen::VectorXd bad = Eigen::VectorXd::Constant(edges, 0.3);
    bad[5] = 0;
    for (const Eigen::VectorXd& epsilon : {Eigen::VectorXd(Eigen::VectorXd::Constant(edges - 1, 0.3)), bad})
        EXPECT_THROW(direction_field(mesh, {.edge_epsilon = epsilon}), InvalidInput);
}

}  // namespace
}  // namespace octafield::surface
