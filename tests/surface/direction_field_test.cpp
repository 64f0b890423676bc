// N-direction fields: oracles are closed forms, topology and finite differences.
#include "direction_field_fixtures.hpp"

namespace octafield::surface {
namespace {

// ---- the functional ----

TEST(DirectionField, DirichletEnergyOfCurvatureLinesOnATorus) {
    // 32 pi^2 (q - sqrt(q^2 - 1)) for q = R / r = 2.
    const double exact = 32 * pi * pi * (2 - std::sqrt(3.0));
    double errors[2];
    for (const int level : {0, 1}) {
        const TriangleMesh mesh = torus(80 << level, 40 << level, 1, 0.5);
        const auto normal = [](const Vector& x) -> Vector { return x - Vector(x.x(), x.y(), 0).normalized(); };
        const DirectionField field = prescribed(mesh, 4, azimuth, normal);
        errors[level] = detail::dirichlet_energy(detail::corner_links(field.domain, 4), field.values) / exact - 1;
    }
    EXPECT_NEAR(errors[0], 0, 0.01);
    EXPECT_NEAR(errors[0] / errors[1], 4, 0.5);
}

TEST(DirectionField, ParallelFieldInThePlaneHasNoEnergy) {
    for (const int symmetry : {1, 2, 3, 4, 6}) {
        const TriangleMesh mesh = disk(4);
        const DirectionField field = prescribed(
            mesh, symmetry, [](auto&) { return Vector(std::cos(0.3), std::sin(0.3), 0); }, up);
        EXPECT_NEAR(detail::dirichlet_energy(detail::corner_links(field.domain, symmetry), field.values), 0, 1e-24);
    }
}

TEST(DirectionField, GradientAndHessianAgreeWithFiniteDifferences) {
    const TriangleMesh mesh = torus(7, 5, 1, 0.4);
    for (const int symmetry : {3, 4}) {
        const EdgeTopology topology = edge_topology(mesh);
        const auto links = detail::corner_links(mesh, symmetry);
        std::vector<bool> held(topology.edges.rows(), false);
        held[3] = held[10] = true;
        const detail::FreeSystem system(links, held);
        std::srand(1);
        detail::Pull pull(topology.edges.rows());
        for (Index e = 0; e < pull.weights.size(); e += 2) pull.add(e, 0.1 * (1 + e % 7), std::polar(1.0, 0.3 * e));
        const Eigen::VectorXd epsilon = 0.3 + 0.1 * Eigen::VectorXd::Random(topology.edges.rows()).array();
        const detail::GinzburgLandau functional(links, detail::edge_masses(mesh), system, pull, epsilon);
        const Eigen::VectorXcd values = Eigen::VectorXcd::Random(topology.edges.rows());
        const Eigen::VectorXd direction = Eigen::VectorXd::Random(2 * system.size());
        const Eigen::VectorXcd step = system.scatter(detail::as_complex(direction), values.size());
        constexpr double h = 1e-5;
        const auto ahead = functional.slope(values + h * step), behind = functional.slope(values - h * step);
        EXPECT_NEAR(functional.slope(values).gradient.dot(direction), (ahead.energy - behind.energy) / (2 * h), 1e-5);
        detail::FreeSystem::RealMatrix hessian = system.real_stiffness();
        functional.hessian(values, 0, hessian);
        const Eigen::VectorXd numeric = (ahead.gradient - behind.gradient) / (2 * h);
        const Eigen::VectorXd analytic = hessian.selfadjointView<Eigen::Lower>() * direction;
        EXPECT_LT((analytic - numeric).norm(), 1e-8 * numeric.norm());
        const auto c = functional.along(values, step);
        EXPECT_NEAR(c[0] + c[1] + c[2] + c[3], functional.slope(values + step).energy - functional.slope(values).energy,
                    1e-9);
    }
}

TEST(LineSearch, FindsTheFirstMinimumOfAQuartic) {
    // Slope s (t - a) (t - b) (t - c): minima at a and c.
    const auto quartic = [](double s, double a, double b, double c) {
        return std::array{-s * a * b * c, s * (a * b + b * c + c * a) / 2, -s * (a + b + c) / 3, s / 4};
    };
    for (const double s : {1e-9, 1.0, 1e9})
        for (const double size : {1e-6, 0.01, 1.0, 300.0}) {
            EXPECT_NEAR(detail::lowest_along(quartic(s, 0.3 * size, 0.4 * size, 0.9 * size)), 0.3 * size, 1e-9 * size);
            EXPECT_NEAR(detail::lowest_along(quartic(s, 0.01 * size, 0.02 * size, 5 * size)), 0.01 * size, 1e-9 * size);
            EXPECT_NEAR(detail::lowest_along(quartic(s, -2 * size, -size, 0.7 * size)), 0.7 * size, 1e-9 * size);
            EXPECT_NEAR(detail::lowest_along(quartic(s, -2 * size, 0, 0.7 * size)), 0.7 * size, 1e-9 * size);
            // Slope s (t - a) (t^2 + a^2): one minimum.
            EXPECT_NEAR(detail::lowest_along({-s * size * size * size, s * size * size / 2, -s * size / 3, s / 4}),
                        size, 1e-9 * size);
        }
    EXPECT_NEAR(detail::lowest_along({-1, 0, 0, 0.25}), 1, 1e-12);
    EXPECT_NEAR(detail::lowest_along({-2, 1, 0, 1e-300}), 1, 1e-12);  // as good as quadratic
}

TEST(DirectionField, DescentLeavesASaddlePoint) {
    // f = 0 solves the Euler-Lagrange equations and is the highest of all saddle points.
    const TriangleMesh mesh = icosphere(2);
    const DirectionField field = direction_field(mesh);
    const auto links = detail::corner_links(field.domain, 4);
    const detail::FreeSystem system(links, std::vector<bool>(field.values.size(), false));
    const detail::Pull pull(field.values.size());
    const detail::GinzburgLandau functional(links, detail::edge_masses(field.domain), system, pull,
                                            Eigen::VectorXd::Constant(field.values.size(), field.epsilon));
    Eigen::VectorXcd values = Eigen::VectorXcd::Zero(field.values.size());
    const auto result = detail::minimise(functional, system.elimination_order(), values, {}, {});
    EXPECT_TRUE(result.converged);
    EXPECT_NEAR(result.energy_history.back(), field.energy, 1e-4 * field.energy);
}

// ---- known minimisers ----

TEST(DirectionField, CrossFieldOnTheSphereHasEightPointsOnASquareAntiprism) {
    const TriangleMesh mesh = icosphere(4);
    const DirectionField field = direction_field(mesh, {.epsilon = 0.1});
    EXPECT_TRUE(field.converged);
    EXPECT_NEAR(field.energy, 42.85, 0.15);
    const auto points = surface_singularities(field).points;
    ASSERT_EQ(points.size(), 8u);
    for (const auto& point : points) {
        EXPECT_EQ(point.index, 0.25);
        EXPECT_FALSE(point.boundary);
    }
    const auto distances = sorted_distances(points);
    // Minimiser of -sum log |xi - xj|: 1.1672 and 1.2939 (8 each), 1.6507 (4), 1.8976 (8). Positions scatter by part of
    // a mesh width.
    const auto mean = [&](int first, int count) {
        return std::accumulate(distances.begin() + first, distances.begin() + first + count, 0.0) / count;
    };
    EXPECT_NEAR(mean(0, 8), 1.1672, 0.02);
    EXPECT_NEAR(mean(8, 8), 1.2939, 0.02);
    EXPECT_NEAR(mean(16, 4), 1.6507, 0.02);
    EXPECT_NEAR(mean(20, 8), 1.8976, 0.02);
}

TEST(DirectionField, SixFoldFieldOnTheSphereHasTwelvePointsOnAnIcosahedron) {
    const TriangleMesh mesh = icosphere(3);
    const DirectionField field = direction_field(mesh, {.symmetry = 6});
    const auto points = surface_singularities(field).points;
    ASSERT_EQ(points.size(), 12u);
    const auto distances = sorted_distances(points);
    for (int i = 0; i < 30; ++i) EXPECT_NEAR(distances[i], 1.05146, 0.06);
    EXPECT_NEAR(distances.back(), 2, 0.03);
}

TEST(DirectionField, AlignedFieldOnTheDiskHasItsPointsAtThePublishedRadius) {
    const TriangleMesh mesh = disk(30);
    const DirectionField field = direction_field(mesh, {.epsilon = 0.05});
    EXPECT_TRUE(field.converged);
    EXPECT_NEAR(field.energy, 35.0, 0.25);
    const auto points = surface_singularities(field).points;
    ASSERT_EQ(points.size(), 4u);
    for (const auto& point : points) EXPECT_NEAR(point.position.norm(), std::pow(3.0 / 11, 1.0 / 8), 0.025);
    const auto distances = sorted_distances(points);
    EXPECT_NEAR(distances[0] / distances[4], std::sqrt(0.5), 0.03);  // a square
}

TEST(DirectionField, SymmetricStartWithOneMultiplePointSplitsIntoSimplePoints) {
    // The harmonic start on this six-fold mesh is z^6: one point of N * index 6, a saddle point of the functional.
    const TriangleMesh mesh = disk(16);
    const auto points = surface_singularities(direction_field(mesh, {.symmetry = 6, .epsilon = 0.06})).points;
    EXPECT_EQ(points.size(), 6u);
    for (const auto& point : points) EXPECT_EQ(point.index_times_symmetry, 1);
}

TEST(DirectionField, FieldBetweenTwoCirclesHasNoSingularities) {
    const TriangleMesh full = disk(12);
    std::vector<Eigen::Vector3i> kept;
    for (const auto& t : full.triangles.rowwise())
        if ((full.vertices.row(t[0]) + full.vertices.row(t[1]) + full.vertices.row(t[2])).norm() / 3 > 0.4)
            kept.push_back(t.transpose());
    std::vector<Vector> points;
    for (const auto& row : full.vertices.rowwise()) points.push_back(row.transpose());
    const TriangleMesh mesh = make_mesh(points, kept);
    const DirectionField field = direction_field(mesh);
    EXPECT_TRUE(surface_singularities(field).points.empty());
    const Points directions = vertex_directions(field);
    for (Index v = 0; v < directions.rows(); ++v) {
        if (mesh.vertices.row(v).norm() < 0.39) continue;
        const Vector x = mesh.vertices.row(v);
        const double angle = std::asin(std::min(1.0, directions.row(v).transpose().cross(azimuth(x)).norm()));
        EXPECT_NEAR(std::min(angle, pi / 2 - angle), 0, 0.1);
    }
}

// ---- indices ----

TEST(DirectionField, SingularitiesOfPrescribedFieldsHaveTheirSignAndPlace) {
    const TriangleMesh mesh = disk(7);
    const Vector zero(0.171, 0.092, 0);
    for (const int symmetry : {1, 2, 3, 4, 6})
        for (const int turns : {-1, 1}) {
            const auto direction = [&](const Vector& x) {
                const double angle = turns * std::atan2(x.y() - zero.y(), x.x() - zero.x()) / symmetry;
                return Vector(std::cos(angle), std::sin(angle), 0);
            };
            int inside = 0;
            for (const auto& point : surface_singularities(prescribed(mesh, symmetry, direction, up)).points) {
                if (point.boundary) continue;
                ++inside;
                EXPECT_EQ(point.index_times_symmetry, turns);
                EXPECT_EQ(point.index, static_cast<double>(turns) / symmetry);
                EXPECT_LT((point.position - zero).norm(), 1.0 / 7);
            }
            EXPECT_EQ(inside, 1);
        }
}

TEST(DirectionField, CornersOfACubeCarryAQuarterEach) {
    const TriangleMesh mesh = cube_surface(5);
    std::vector<std::pair<Index, Index>> sharp;
    const EdgeTopology topology = edge_topology(mesh);
    const Points normals = triangle_normals(mesh);
    for (Index e = 0; e < topology.edges.rows(); ++e)
        if (normals.row(topology.edge_triangles(e, 0)).dot(normals.row(topology.edge_triangles(e, 1))) < 0.5)
            sharp.emplace_back(topology.edges(e, 0), topology.edges(e, 1));
    FeatureGraph features;
    features.edges.resize(static_cast<Eigen::Index>(sharp.size()), 2);
    for (std::size_t i = 0; i < sharp.size(); ++i) features.edges.row(i) << sharp[i].first, sharp[i].second;
    const DirectionField field = direction_field({mesh, features});
    EXPECT_NEAR(field.energy, 0, 1e-20);
    const auto points = surface_singularities(field).points;
    ASSERT_EQ(points.size(), 8u);
    for (const auto& point : points) {
        EXPECT_EQ(point.index, 0.25);
        ASSERT_GE(point.vertex, 0);
        EXPECT_NEAR((point.position - Vector::Constant(0.5)).norm(), std::sqrt(0.75), 1e-15);
    }
    // Every triangle's cross is aligned with the axes.
    const Points directions = triangle_directions(field);
    EXPECT_NEAR(directions.cwiseAbs().rowwise().maxCoeff().minCoeff(), 1, 1e-9);
}

TEST(DirectionField, ReentrantBoundaryCornerCarriesMinusAQuarter) {
    const TriangleMesh mesh = plate(8, [](double x, double y) { return x < 0.5 || y < 0.5; });
    const auto points = surface_singularities(direction_field(mesh)).points;
    ASSERT_EQ(points.size(), 6u);
    for (const auto& point : points) {
        EXPECT_TRUE(point.boundary);
        const bool reentrant = (point.position - Vector(0.5, 0.5, 0)).norm() < 1e-12;
        EXPECT_EQ(point.index, reentrant ? -0.25 : 0.25);
    }
}

TEST(DirectionField, IndicesSumToTheEulerCharacteristicForAnySymmetry) {
    const TriangleMesh meshes[] = {icosphere(2), torus(20, 12, 1, 0.4), disk(6),
                                   plate(9, [](double x, double y) { return std::hypot(x - 0.5, y - 0.5) > 0.3; })};
    for (const int symmetry : {1, 2, 3, 4, 5, 6})
        for (const TriangleMesh& mesh : meshes)
            for (const auto method : {"gl", "eigen", "mbo"}) {
                const DirectionField field = direction_field(mesh, {.symmetry = symmetry, .method = method});
                EXPECT_EQ(index_sum(surface_singularities(field).points), symmetry * euler_characteristic(mesh));
            }
}

TEST(DirectionField, IndicesSumToTheEulerCharacteristicOnRealSurfaces) {
    const std::filesystem::path folder = std::filesystem::path(OCTAFIELD_SHARED_DATA) / "surfaces";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no surfaces at " << folder;
    for (const char* name : {"s01", "s04", "s15", "s16", "s17", "i10"}) {
        const TriangleMesh mesh = read_surface(folder / (std::string(name) + "_surface.obj"));
        for (const FeatureGraph& features : {FeatureGraph{}, detect_features(mesh), all_edges(mesh)}) {
            const DirectionField diffused = direction_field({mesh, features}, {.method = "mbo"});
            EXPECT_TRUE(surface_singularities(diffused).agree) << name;
            const DirectionField field = direction_field({mesh, features});
            EXPECT_TRUE(field.converged) << name;
            EXPECT_EQ(index_sum(surface_singularities(field).points), 4 * euler_characteristic(mesh)) << name;
            const Points directions = vertex_directions(field), normals = vertex_normals(mesh);
            EXPECT_NEAR((directions.rowwise().norm().array() - 1).abs().maxCoeff(), 0, 1e-12) << name;
            EXPECT_NEAR((directions.array() * normals.array()).rowwise().sum().abs().maxCoeff(), 0, 1e-12) << name;
        }
    }
}

// ---- directions ----

TEST(DirectionField, DirectionsReproduceAConstantPlaneField) {
    const TriangleMesh mesh = disk(5);
    const Vector constant(std::cos(0.3), std::sin(0.3), 0), across(-constant.y(), constant.x(), 0);
    const DirectionField field = prescribed(
        mesh, 4, [&](auto&) { return constant; }, up);
    const auto off = [&](const Vector& d) { return std::min(std::abs(d.dot(constant)), std::abs(d.dot(across))); };
    const Points at_vertices = vertex_directions(field), in_triangles = triangle_directions(field);
    for (Index t = 0; t < in_triangles.rows(); ++t) EXPECT_NEAR(off(in_triangles.row(t)), 0, 1e-13);
    // At the boundary too, which the field does not follow.
    for (Index v = 0; v < at_vertices.rows(); ++v) EXPECT_NEAR(off(at_vertices.row(v)), 0, 1e-13);
}

TEST(DirectionField, VertexDirectionsFollowCurvatureLinesToSecondOrder) {
    double worst[2];
    for (const int level : {0, 1}) {
        const TriangleMesh mesh = torus(60 << level, 30 << level, 1, 0.5);
        const auto normal = [](const Vector& x) -> Vector { return x - Vector(x.x(), x.y(), 0).normalized(); };
        const Points directions = vertex_directions(prescribed(mesh, 4, azimuth, normal));
        const Points normals = vertex_normals(mesh);
        worst[level] = 0;
        for (Index v = 0; v < directions.rows(); ++v) {
            const Vector d = directions.row(v), n = normals.row(v), u = azimuth(mesh.vertices.row(v));
            EXPECT_NEAR(d.dot(n), 0, 1e-14);
            worst[level] = std::max(worst[level], std::min(std::abs(d.dot(u)), std::abs(d.dot(n.cross(u)))));
        }
    }
    EXPECT_LT(worst[1], 0.005);
    EXPECT_GT(worst[0] / worst[1], 3);
}

TEST(DirectionField, FeatureVerticesFollowTheirCurve) {
    const TriangleMesh mesh = torus(40, 20, 1, 0.5);
    const auto normal = [](const Vector& x) -> Vector { return x - Vector(x.x(), x.y(), 0).normalized(); };
    std::vector<Index> ring;  // the vertices j = 3 of all i: a circle round the axis
    for (Index i = 0; i < 40; ++i) ring.push_back(20 * i + 3);
    FeatureGraph features;
    features.edges.resize(39, 2);  // open at both ends
    for (Index i = 0; i < 39; ++i) features.edges.row(i) << ring[i], ring[i + 1];
    const DirectionField field = prescribed(
        {mesh, features}, 4, [](auto&) { return Vector::UnitZ(); }, normal);
    const Points directions = vertex_directions(field);
    for (Index i = 1; i < 39; ++i)
        EXPECT_NEAR(std::abs(directions.row(ring[i]).dot(azimuth(mesh.vertices.row(ring[i])))), 1, 1e-4);
    const Vector chord = mesh.vertices.row(ring[1]) - mesh.vertices.row(ring[0]);
    EXPECT_GT(std::abs(directions.row(ring[0]).dot(chord.normalized())), 0.99);
}

}  // namespace
}  // namespace octafield::surface
