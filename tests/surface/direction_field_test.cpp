// N-direction fields: oracles are closed forms, topology and finite differences.
#include "octafield/surface/direction_field.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <filesystem>
#include <functional>
#include <numeric>
#include <random>

#include "../../surface/src/crouzeix_raviart.hpp"
#include "../../surface/src/free_system.hpp"
#include "../../surface/src/ginzburg_landau.hpp"
#include "../../surface/src/line_search.hpp"
#include "mesh_fixtures.hpp"
#include "octafield/error.hpp"
#include "octafield/surface/read_write.hpp"

namespace octafield::surface {
namespace {

using detail::Complex;
using testing::cube_surface;
using testing::disk;
using testing::icosphere;
using testing::make_mesh;
using testing::torus;
using Vector = Eigen::Vector3d;
constexpr double pi = std::numbers::pi;

// The field that follows direction(x) at the edge midpoints x of a surface with normal(x).
DirectionField prescribed(const TriangleMesh& mesh, int symmetry, const std::function<Vector(const Vector&)>& direction,
                          const std::function<Vector(const Vector&)>& normal) {
    DirectionField field;
    field.symmetry = symmetry;
    field.topology = edge_topology(mesh);
    field.values.resize(field.topology.edges.rows());
    for (Index e = 0; e < field.values.size(); ++e) {
        const Vector low = mesh.vertices.row(field.topology.edges(e, 0)),
                     high = mesh.vertices.row(field.topology.edges(e, 1));
        const Vector middle = (low + high) / 2, along = high - low, d = direction(middle);
        field.values[e] =
            std::polar(1.0, symmetry * std::atan2(normal(middle).normalized().cross(along).dot(d), along.dot(d)));
    }
    return field;
}

Vector up(const Vector&) { return Vector::UnitZ(); }

// Round the z axis.
Vector azimuth(const Vector& x) { return Vector(-x.y(), x.x(), 0).normalized(); }

int index_sum(const std::vector<SurfaceSingularity>& singularities) {
    return std::accumulate(singularities.begin(), singularities.end(), 0,
                           [](int sum, const auto& s) { return sum + s.index_times_symmetry; });
}

std::vector<double> sorted_distances(const std::vector<SurfaceSingularity>& points) {
    std::vector<double> distances;
    for (std::size_t i = 0; i < points.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) distances.push_back((points[i].position - points[j].position).norm());
    std::sort(distances.begin(), distances.end());
    return distances;
}

TriangleMesh joined(const std::vector<TriangleMesh>& parts) {
    std::vector<Vector> points;
    std::vector<Eigen::Vector3i> triangles;
    for (const TriangleMesh& part : parts) {
        const int first = static_cast<int>(points.size());
        const Vector shift(3.0 * first, 0, 0);
        for (const auto& row : part.vertices.rowwise()) points.push_back(row.transpose() + shift);
        for (const auto& row : part.triangles.rowwise()) triangles.push_back(row.transpose().array() + first);
    }
    return make_mesh(points, triangles);
}

// n x n squares of two triangles in the unit square, those for which keep(x, y) of the middle is false left out.
TriangleMesh plate(int n, const std::function<bool(double, double)>& keep) {
    std::vector<Vector> points;
    std::vector<Eigen::Vector3i> triangles;
    std::map<std::pair<int, int>, int> ids;
    const auto vertex = [&](int i, int j) {
        const auto [place, fresh] = ids.try_emplace({i, j}, static_cast<int>(points.size()));
        if (fresh) points.emplace_back(static_cast<double>(i) / n, static_cast<double>(j) / n, 0);
        return place->second;
    };
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            if (!keep((i + 0.5) / n, (j + 0.5) / n)) continue;
            const int a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i + 1, j + 1), d = vertex(i, j + 1);
            triangles.insert(triangles.end(), {{a, b, c}, {a, c, d}});
        }
    return make_mesh(points, triangles);
}

FeatureGraph all_edges(const TriangleMesh& mesh) { return {edge_topology(mesh).edges, {}}; }

// ---- the functional ----

TEST(DirectionField, DirichletEnergyOfCurvatureLinesOnATorus) {
    // 32 pi^2 (q - sqrt(q^2 - 1)) for q = R / r = 2.
    const double exact = 32 * pi * pi * (2 - std::sqrt(3.0));
    double errors[2];
    for (const int level : {0, 1}) {
        const TriangleMesh mesh = torus(80 << level, 40 << level, 1, 0.5);
        const auto normal = [](const Vector& x) -> Vector { return x - Vector(x.x(), x.y(), 0).normalized(); };
        const DirectionField field = prescribed(mesh, 4, azimuth, normal);
        errors[level] =
            detail::dirichlet_energy(detail::corner_links(mesh, field.topology, 4), field.values) / exact - 1;
    }
    EXPECT_NEAR(errors[0], 0, 0.01);
    EXPECT_NEAR(errors[0] / errors[1], 4, 0.5);
}

TEST(DirectionField, ParallelFieldInThePlaneHasNoEnergy) {
    for (const int symmetry : {1, 2, 3, 4, 6}) {
        const TriangleMesh mesh = disk(4);
        const DirectionField field = prescribed(
            mesh, symmetry, [](auto&) { return Vector(std::cos(0.3), std::sin(0.3), 0); }, up);
        EXPECT_NEAR(detail::dirichlet_energy(detail::corner_links(mesh, field.topology, symmetry), field.values), 0,
                    1e-24);
    }
}

TEST(DirectionField, GradientAndHessianAgreeWithFiniteDifferences) {
    const TriangleMesh mesh = torus(7, 5, 1, 0.4);
    for (const int symmetry : {3, 4}) {
        const EdgeTopology topology = edge_topology(mesh);
        const auto links = detail::corner_links(mesh, topology, symmetry);
        std::vector<bool> held(topology.edges.rows(), false);
        held[3] = held[10] = true;
        const detail::FreeSystem system(links, held);
        const detail::GinzburgLandau functional(links, detail::edge_masses(mesh, topology), system, 0.3);
        std::srand(1);
        const Eigen::VectorXcd values = Eigen::VectorXcd::Random(topology.edges.rows());
        const Eigen::VectorXd direction = Eigen::VectorXd::Random(2 * system.size());
        const Eigen::VectorXcd step = system.scatter(direction, values.size());
        constexpr double h = 1e-5;
        const auto ahead = functional.slope(values + h * step), behind = functional.slope(values - h * step);
        EXPECT_NEAR(functional.slope(values).gradient.dot(direction), (ahead.energy - behind.energy) / (2 * h), 1e-5);
        detail::FreeSystem::Matrix hessian;
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
    const DirectionField field = direction_field(mesh, {});
    const auto links = detail::corner_links(mesh, field.topology, 4);
    const detail::FreeSystem system(links, std::vector<bool>(field.values.size(), false));
    const detail::GinzburgLandau functional(links, detail::edge_masses(mesh, field.topology), system, field.epsilon);
    Eigen::VectorXcd values = Eigen::VectorXcd::Zero(field.values.size());
    const detail::DescentResult result = detail::minimise(functional, values, {}, {});
    EXPECT_TRUE(result.converged);
    EXPECT_NEAR(result.energy_history.back(), field.energy, 1e-4 * field.energy);
}

// ---- known minimisers ----

TEST(DirectionField, CrossFieldOnTheSphereHasEightPointsOnASquareAntiprism) {
    const TriangleMesh mesh = icosphere(4);
    const DirectionField field = direction_field(mesh, {}, {.epsilon = 0.1});
    EXPECT_TRUE(field.converged);
    EXPECT_NEAR(field.energy, 42.85, 0.15);
    const auto points = surface_singularities(mesh, field);
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
    const DirectionField field = direction_field(mesh, {}, {.symmetry = 6});
    const auto points = surface_singularities(mesh, field);
    ASSERT_EQ(points.size(), 12u);
    const auto distances = sorted_distances(points);
    for (int i = 0; i < 30; ++i) EXPECT_NEAR(distances[i], 1.05146, 0.06);
    EXPECT_NEAR(distances.back(), 2, 0.03);
}

TEST(DirectionField, AlignedFieldOnTheDiskHasItsPointsAtThePublishedRadius) {
    const TriangleMesh mesh = disk(30);
    const DirectionField field = direction_field(mesh, {}, {.epsilon = 0.05});
    EXPECT_TRUE(field.converged);
    EXPECT_NEAR(field.energy, 35.0, 0.25);
    const auto points = surface_singularities(mesh, field);
    ASSERT_EQ(points.size(), 4u);
    for (const auto& point : points) EXPECT_NEAR(point.position.norm(), std::pow(3.0 / 11, 1.0 / 8), 0.025);
    const auto distances = sorted_distances(points);
    EXPECT_NEAR(distances[0] / distances[4], std::sqrt(0.5), 0.03);  // a square
}

TEST(DirectionField, SymmetricStartWithOneMultiplePointSplitsIntoSimplePoints) {
    // The harmonic start on this six-fold mesh is z^6: one point of N * index 6, a saddle point of the functional.
    const TriangleMesh mesh = disk(16);
    const auto points = surface_singularities(mesh, direction_field(mesh, {}, {.symmetry = 6, .epsilon = 0.06}));
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
    const DirectionField field = direction_field(mesh, {});
    EXPECT_TRUE(surface_singularities(mesh, field).empty());
    const Points directions = vertex_directions(mesh, {}, field);
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
            for (const auto& point : surface_singularities(mesh, prescribed(mesh, symmetry, direction, up))) {
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
    const DirectionField field = direction_field(mesh, features);
    EXPECT_NEAR(field.energy, 0, 1e-20);
    const auto points = surface_singularities(mesh, field);
    ASSERT_EQ(points.size(), 8u);
    for (const auto& point : points) {
        EXPECT_EQ(point.index, 0.25);
        ASSERT_GE(point.vertex, 0);
        EXPECT_NEAR((point.position - Vector::Constant(0.5)).norm(), std::sqrt(0.75), 1e-15);
    }
    // Every triangle's cross is aligned with the axes.
    const Points directions = triangle_directions(mesh, field);
    EXPECT_NEAR(directions.cwiseAbs().rowwise().maxCoeff().minCoeff(), 1, 1e-9);
}

TEST(DirectionField, ReentrantBoundaryCornerCarriesMinusAQuarter) {
    const TriangleMesh mesh = plate(8, [](double x, double y) { return x < 0.5 || y < 0.5; });
    const auto points = surface_singularities(mesh, direction_field(mesh, {}));
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
            for (const auto method : {DirectionFieldMethod::ginzburg_landau, DirectionFieldMethod::eigenvector}) {
                const DirectionField field = direction_field(mesh, {}, {.symmetry = symmetry, .method = method});
                EXPECT_EQ(index_sum(surface_singularities(mesh, field)), symmetry * euler_characteristic(mesh));
            }
}

TEST(DirectionField, IndicesSumToTheEulerCharacteristicOnRealSurfaces) {
    const std::filesystem::path folder = std::filesystem::path(OCTAFIELD_SHARED_DATA) / "surfaces";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no surfaces at " << folder;
    for (const char* name : {"s01", "s04", "s15", "s16", "s17", "i10"}) {
        const TriangleMesh mesh = read_surface(folder / (std::string(name) + "_surface.obj"));
        for (const FeatureGraph& features : {FeatureGraph{}, detect_features(mesh), all_edges(mesh)}) {
            const DirectionField field = direction_field(mesh, features);
            EXPECT_TRUE(field.converged) << name;
            EXPECT_EQ(index_sum(surface_singularities(mesh, field)), 4 * euler_characteristic(mesh)) << name;
            const Points directions = vertex_directions(mesh, features, field), normals = vertex_normals(mesh);
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
    const Points at_vertices = vertex_directions(mesh, {}, field), in_triangles = triangle_directions(mesh, field);
    for (Index t = 0; t < in_triangles.rows(); ++t) EXPECT_NEAR(off(in_triangles.row(t)), 0, 1e-13);
    for (Index v = 0; v < at_vertices.rows(); ++v) {
        const Vector x = mesh.vertices.row(v);
        if (x.norm() < 0.99) {
            EXPECT_NEAR(off(at_vertices.row(v)), 0, 1e-13);
        } else {  // the boundary is a feature: its tangent
            EXPECT_NEAR(std::abs(at_vertices.row(v).dot(azimuth(x))), 1, 1e-12);
        }
    }
}

TEST(DirectionField, VertexDirectionsFollowCurvatureLinesToSecondOrder) {
    double worst[2];
    for (const int level : {0, 1}) {
        const TriangleMesh mesh = torus(60 << level, 30 << level, 1, 0.5);
        const auto normal = [](const Vector& x) -> Vector { return x - Vector(x.x(), x.y(), 0).normalized(); };
        const Points directions = vertex_directions(mesh, {}, prescribed(mesh, 4, azimuth, normal));
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
        mesh, 4, [](auto&) { return Vector::UnitZ(); }, normal);
    const Points directions = vertex_directions(mesh, features, field);
    for (Index i = 1; i < 39; ++i)
        EXPECT_NEAR(std::abs(directions.row(ring[i]).dot(azimuth(mesh.vertices.row(ring[i])))), 1, 1e-4);
    const Vector chord = mesh.vertices.row(ring[1]) - mesh.vertices.row(ring[0]);
    EXPECT_GT(std::abs(directions.row(ring[0]).dot(chord.normalized())), 0.99);
}

// ---- invariances ----

TEST(DirectionField, EnergyDoesNotDependOnTheLengthUnit) {
    TriangleMesh mesh = icosphere(2);
    const DirectionField unit = direction_field(mesh, {}, {.tolerance = 1e-12, .energy_tolerance = 0});
    for (const double scale : {1e-6, 1e6}) {
        mesh.vertices = icosphere(2).vertices * scale;
        const DirectionField scaled = direction_field(mesh, {}, {.tolerance = 1e-12, .energy_tolerance = 0});
        EXPECT_TRUE(scaled.converged);
        EXPECT_NEAR(scaled.epsilon, unit.epsilon * scale, 1e-12 * scale);
        EXPECT_NEAR(scaled.energy, unit.energy, 1e-8 * unit.energy);
    }
}

TEST(DirectionField, FarFromTheOriginTheFieldIsTheSame) {
    for (const double sizes_away : {1e3, 1e5}) {
        TriangleMesh sphere = icosphere(2), round = disk(8);
        const double there = direction_field(round, {}).energy;
        sphere.vertices.rowwise() += Eigen::RowVector3d(2, -1, 0.5) * sizes_away;
        round.vertices.rowwise() += Eigen::RowVector3d(2, -1, 0.5) * sizes_away;
        const DirectionField field = direction_field(sphere, {});
        EXPECT_TRUE(field.converged);
        EXPECT_NEAR(field.energy, direction_field(icosphere(2), {}).energy, 1e-3 * field.energy);
        EXPECT_EQ(surface_singularities(sphere, field).size(), 8u);
        EXPECT_NEAR(direction_field(round, {}).energy, there, 1e-5 * there);
    }
}

TEST(DirectionField, TheEigenvectorDoesNotDependOnEpsilon) {
    // A small component beside a large one: each has its own eigenvector.
    TriangleMesh small = icosphere(2);
    small.vertices *= 1e-5;
    const TriangleMesh mesh = joined({torus(20, 12, 1, 0.4), small});
    const auto at = [&](double epsilon) {
        return direction_field(mesh, {}, {.method = DirectionFieldMethod::eigenvector, .epsilon = epsilon});
    };
    const DirectionField usual = at(0);
    for (const double epsilon : {1e-12, 1e-6, 1e6}) EXPECT_TRUE(at(epsilon).values == usual.values);
    // 8 singular points each turn by 1/4 on the sphere; a random field has hundreds.
    EXPECT_LE(surface_singularities(mesh, usual).size(), 24u);
}

TEST(DirectionField, SmallEpsilonKeepsTheSmoothestFieldsPoints) {
    const TriangleMesh mesh = icosphere(3);
    const DirectionField smoothest = direction_field(mesh, {}, {.method = DirectionFieldMethod::eigenvector});
    const DirectionField field = direction_field(mesh, {}, {.epsilon = mean_edge_length(mesh) / 50});
    EXPECT_LE(surface_singularities(mesh, field).size(), 10u);
    EXPECT_LE(field.dirichlet_energy, smoothest.dirichlet_energy);
}

TEST(DirectionField, OrderOfTrianglesDoesNotMatter) {
    TriangleMesh mesh = disk(8);
    const DirectionField field = direction_field(mesh, {}, {.energy_tolerance = 0});
    std::vector<int> order(mesh.triangles.rows());
    std::iota(order.begin(), order.end(), 0);
    std::shuffle(order.begin(), order.end(), std::mt19937(7));
    const Triangles before = mesh.triangles;
    for (std::size_t t = 0; t < order.size(); ++t)
        mesh.triangles.row(t) << before(order[t], t % 3), before(order[t], (t + 1) % 3), before(order[t], (t + 2) % 3);
    const DirectionField shuffled = direction_field(mesh, {}, {.energy_tolerance = 0});
    EXPECT_NEAR(shuffled.energy, field.energy, 1e-9 * field.energy);
    EXPECT_EQ(surface_singularities(mesh, shuffled).size(), 4u);
}

TEST(DirectionField, SameInputGivesSameBits) {
    const TriangleMesh mesh = icosphere(2);
    const DirectionField first = direction_field(mesh, {}, {.seed = 5}),
                         second = direction_field(mesh, {}, {.seed = 5});
    EXPECT_TRUE(first.values == second.values);
    EXPECT_FALSE(first.values == direction_field(mesh, {}, {.seed = 6}).values);
}

TEST(DirectionField, ComponentsWithAndWithoutHeldEdgesAreSolvedTogether) {
    const TriangleMesh mesh = joined({icosphere(2), disk(6), torus(20, 12, 1, 0.4), icosphere(1)});
    const DirectionField field = direction_field(mesh, {});
    EXPECT_TRUE(field.converged);
    EXPECT_EQ(index_sum(surface_singularities(mesh, field)), 4 * (2 + 1 + 0 + 2));
}

TEST(DirectionField, EnergyFallsAndProgressTellsIt) {
    const TriangleMesh mesh = icosphere(2);
    std::vector<double> told;
    const DirectionField field =
        direction_field(mesh, {}, {}, [&](std::string_view phase, double fraction, double energy) {
            EXPECT_EQ(phase, "cross field");
            EXPECT_LE(fraction, 1);
            if (!std::isnan(energy)) told.push_back(energy);
            return true;
        });
    EXPECT_EQ(told, field.energy_history);
    EXPECT_EQ(field.energy_history.size(), static_cast<std::size_t>(field.iterations) + 1);
    for (std::size_t i = 1; i < told.size(); ++i) EXPECT_LE(told[i], told[i - 1] * (1 + 1e-12));
    EXPECT_NEAR(field.energy, told.back(), 1e-9);
}

TEST(DirectionField, CancellingKeepsTheBestState) {
    const TriangleMesh mesh = icosphere(3);
    int energies = 0;
    const DirectionField field = direction_field(
        mesh, {}, {}, [&](std::string_view, double, double energy) { return std::isnan(energy) || ++energies < 4; });
    EXPECT_FALSE(field.converged);
    EXPECT_EQ(field.iterations, 3);
    EXPECT_LT(field.energy, field.energy_history.front());
    const DirectionField start = direction_field(mesh, {}, {}, [](auto, double, double) { return false; });
    EXPECT_FALSE(start.converged);
    EXPECT_TRUE(start.values.array().isFinite().all());
}

// ---- bad input ----

TEST(DirectionField, RejectsUnusableOptions) {
    const TriangleMesh mesh = icosphere(0);
    EXPECT_THROW(direction_field(mesh, {}, {.symmetry = 0}), InvalidInput);
    EXPECT_THROW(direction_field(mesh, {}, {.epsilon = -1}), InvalidInput);
    EXPECT_THROW(direction_field(mesh, {}, {.epsilon = std::nan("")}), InvalidInput);
    EXPECT_THROW(direction_field(mesh, {}, {.max_iterations = -1}), InvalidInput);
    EXPECT_THROW(direction_field(mesh, {}, {.tolerance = -1}), InvalidInput);
}

TEST(DirectionField, RefusesAnEpsilonAtWhichTheFieldVanishes) {
    // On the unit sphere f = 0 is the minimum from epsilon 1/2 on: the lowest eigenvalue is 4 for 4-fold fields.
    const TriangleMesh sphere = icosphere(3);
    for (const double epsilon : {0.52, 1.0, 100.0}) {
        try {
            direction_field(sphere, {}, {.epsilon = epsilon});
            FAIL() << "a field without directions was returned, epsilon " << epsilon;
        } catch (const SolverError& error) {
            EXPECT_EQ(error.kind(), "epsilon_too_large");
            EXPECT_EQ(static_cast<Index>(error.elements().size()), sphere.triangles.rows());
            EXPECT_NE(std::string(error.what()).find("smaller epsilon"), std::string::npos);
        }
    }
    EXPECT_TRUE(direction_field(sphere, {}, {.epsilon = 0.4}).converged);
    EXPECT_TRUE(direction_field(disk(8), {}, {.epsilon = 100}).converged);  // its boundary keeps it from vanishing
    TriangleMesh small = icosphere(2);
    small.vertices /= 1000;
    const TriangleMesh both = joined({small, icosphere(3)});
    try {
        direction_field(both, {});
        FAIL() << "the small sphere has no directions at this epsilon";
    } catch (const SolverError& error) {
        EXPECT_EQ(static_cast<Index>(error.elements().size()), small.triangles.rows());
    }
}

TEST(DirectionField, RefusesAnEpsilonFarBelowTheEdgeLength) {
    const TriangleMesh mesh = icosphere(2);
    try {
        direction_field(mesh, {}, {.epsilon = mean_edge_length(mesh) / 101});
        FAIL() << "the field would stay as it starts";
    } catch (const InvalidInput& error) {
        EXPECT_EQ(error.kind(), "epsilon_too_small");
    }
    EXPECT_NO_THROW(direction_field(mesh, {}, {.epsilon = mean_edge_length(mesh) / 99}));
}

TEST(DirectionField, RejectsCornersThatAreNoVertices) {
    const TriangleMesh mesh = disk(3);
    const DirectionField field = direction_field(mesh, {});
    for (const Index corner : {-1, 9999})
        EXPECT_THROW(vertex_directions(mesh, {Edges(0, 2), {corner}}, field), InvalidInput);
}

TEST(DirectionField, RejectsFeaturesItCannotFollow) {
    const TriangleMesh mesh = icosphere(1);
    FeatureGraph absent{Edges(1, 2), {}};
    absent.edges << 0, 1;  // joined before the split
    try {
        direction_field(mesh, absent);
        FAIL() << "an edge that is not in the mesh was accepted";
    } catch (const InvalidInput& error) {
        EXPECT_EQ(error.kind(), "unknown_edge");
        EXPECT_EQ(error.elements(), (std::vector<Index>{0, 1}));
    }
    EXPECT_THROW(direction_field(mesh, all_edges(mesh), {.symmetry = 3}), InvalidInput);
}

TEST(DirectionField, RejectsUnsoundMeshes) {
    EXPECT_THROW(direction_field(TriangleMesh{}, {}), GeometryError);
    TriangleMesh flat = plate(2, [](double, double) { return true; });
    flat.vertices.col(1).setZero();
    try {
        direction_field(flat, {});
        FAIL() << "triangles without area were accepted";
    } catch (const GeometryError& error) {
        EXPECT_EQ(error.kind(), "degenerate_triangle");
        EXPECT_EQ(error.elements().size(), 8u);
    }
    TriangleMesh fin =
        make_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}}, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}});
    EXPECT_THROW(direction_field(fin, {}), GeometryError);
    TriangleMesh dangling = icosphere(0);
    dangling.triangles(3, 1) = 99;
    EXPECT_THROW(direction_field(dangling, {}), GeometryError);
    TriangleMesh infinite = icosphere(0);
    infinite.vertices(2, 1) = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(direction_field(infinite, {}), GeometryError);
}

}  // namespace
}  // namespace octafield::surface
