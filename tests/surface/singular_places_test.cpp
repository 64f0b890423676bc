// Places of singular points: fields with known zeros, and the points of least logarithmic energy.
#include "direction_field_fixtures.hpp"
#include "octafield/surface/renormalised_energy.hpp"

namespace octafield::surface {
namespace {

// Zeros of the N-th power of the direction; sign -1: poles, points of index -1/N.
struct Zero {
    Complex at;
    int sign = 1;
};

double angle_of(const std::vector<Zero>& zeros, Complex z, int symmetry) {
    double sum = 0.3;
    for (const Zero& zero : zeros) sum += zero.sign * std::arg(z - zero.at);
    return sum / symmetry;
}

// From the north pole.
Complex lowered(const Vector& x) { return Complex(x.x(), x.y()) / (1 - x.z()); }
Vector lifted(Complex w) { return Vector(2 * w.real(), 2 * w.imag(), std::norm(w) - 1) / (1 + std::norm(w)); }

TriangleMesh jittered(TriangleMesh mesh, double by, const std::function<bool(const Vector&)>& moves,
                      const std::function<Vector(const Vector&)>& back) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(-by, by);
    for (Index v = 0; v < mesh.vertices.rows(); ++v) {
        const Vector x = mesh.vertices.row(v), shift(unit(random), unit(random), unit(random));
        if (moves(x)) mesh.vertices.row(v) = back(x + shift).transpose();
    }
    return mesh;
}

TriangleMesh jittered_sphere(int level, double by) {
    return jittered(
        icosphere(level), by, [](auto&) { return true; }, [](const Vector& x) -> Vector { return x.normalized(); });
}

double mean_edge(const TriangleMesh& mesh) {
    const auto edges = edge_topology(mesh).edges;
    double sum = 0;
    for (Index e = 0; e < edges.rows(); ++e)
        sum += (mesh.vertices.row(edges(e, 0)) - mesh.vertices.row(edges(e, 1))).norm();
    return sum / static_cast<double>(edges.rows());
}

// Barycentric coordinates of the point in its triangle, lowest.
double depth(const TriangleMesh& mesh, const SurfaceSingularity& point) {
    const auto corner = [&](int k) -> Vector { return mesh.vertices.row(mesh.triangles(point.triangle, k)); };
    const Vector normal = (corner(1) - corner(0)).cross(corner(2) - corner(0));
    double lowest = 1;
    for (int k = 0; k < 3; ++k) {
        const Vector side = corner((k + 1) % 3) - corner(k);
        lowest = std::min(lowest, side.cross(point.position - corner(k)).dot(normal) / normal.squaredNorm());
    }
    EXPECT_NEAR((point.position - corner(0)).dot(normal) / std::pow(normal.squaredNorm(), 0.75), 0, 1e-12);
    return lowest;
}

// Every known zero is found once, with its index and in its triangle: the largest error.
double largest_error(const TriangleMesh& mesh, const DirectionField& field, const std::vector<Vector>& places,
                     const std::vector<Zero>& zeros) {
    const auto found = surface_singularities(field);
    EXPECT_TRUE(found.agree);
    double largest = 0;
    std::size_t inside = 0;
    for (const auto& point : found.points) {
        if (point.boundary) continue;
        ++inside;
        EXPECT_EQ(point.vertex, -1);
        if (point.triangle >= 0) {
            EXPECT_GT(depth(mesh, point), -1e-9);
        }
        std::size_t nearest = 0;
        for (std::size_t i = 0; i < places.size(); ++i)
            if ((places[i] - point.position).norm() < (places[nearest] - point.position).norm()) nearest = i;
        EXPECT_EQ(point.index_times_symmetry, zeros[nearest].sign);
        largest = std::max(largest, (places[nearest] - point.position).norm());
    }
    EXPECT_EQ(inside, places.size());
    return largest;
}

TEST(SingularPlaces, ZerosInTheDiskAreWithinATenthOfAnEdge) {
    const std::vector<Zero> zeros = {
        {{0.513, 0.204}, 1}, {{-0.371, 0.433}, -1}, {{-0.292, -0.517}, 1}, {{0.07, -0.03}, 1}};
    std::vector<Vector> places;
    for (const Zero& zero : zeros) places.emplace_back(zero.at.real(), zero.at.imag(), 0);
    for (const int symmetry : {1, 2, 4, 6})
        for (const int n : {14, 24, 40})
            for (const double jitter : {0.0, 0.15}) {
                const TriangleMesh mesh = jittered(
                    disk(n), jitter / n, [](const Vector& x) { return x.norm() < 0.95; },
                    [](const Vector& x) -> Vector { return Vector(x.x(), x.y(), 0); });
                const auto direction = [&](const Vector& x) -> Vector {
                    const double angle = angle_of(zeros, flat(x), symmetry);
                    return {std::cos(angle), std::sin(angle), 0};
                };
                const double error = largest_error(mesh, prescribed(mesh, symmetry, direction, up), places, zeros);
                EXPECT_LT(error, 0.1 * mean_edge(mesh)) << symmetry << ' ' << n << ' ' << jitter;
            }
}

TEST(SingularPlaces, ZerosOnTheSphereAreWithinATenthOfAnEdge) {
    // 2N zeros in the stereographic plane: none at infinity.
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    for (const int symmetry : {1, 2, 4, 6}) {
        std::vector<Zero> zeros;
        std::vector<Vector> places;
        while (static_cast<int>(zeros.size()) < 2 * symmetry) {
            const Vector place = Vector(normal(random), normal(random), normal(random)).normalized();
            if (std::any_of(places.begin(), places.end(), [&](auto& p) { return (p - place).norm() < 0.6; })) continue;
            places.push_back(place);
            zeros.push_back({lowered(place)});
        }
        const auto direction = [&](const Vector& x) -> Vector {
            const Complex w = lowered(x.normalized());
            const Complex step = std::polar(1e-5 * (1 + std::norm(w)), angle_of(zeros, w, symmetry));
            return lifted(w + step) - lifted(w - step);
        };
        for (const int level : {3, 4, 5}) {
            const TriangleMesh mesh = jittered_sphere(level, 0.15 / (1 << level));
            const DirectionField field = prescribed(mesh, symmetry, direction, [](const Vector& x) { return x; });
            EXPECT_LT(largest_error(mesh, field, places, zeros), 0.1 * mean_edge(mesh)) << symmetry << ' ' << level;
        }
    }
}

TEST(SingularPlaces, OnAJitteredSphereTheyHaveTheLogarithmicEnergyOfTheAntiprism) {
    const TriangleMesh mesh = jittered_sphere(4, 0.01);
    ASSERT_EQ(mesh.triangles.rows(), 5120);
    const auto found = surface_singularities(direction_field(mesh, {})).points;
    ASSERT_EQ(found.size(), 8u);
    Points points(8, 3);
    for (Index i = 0; i < 8; ++i) points.row(i) = found[i].position.normalized().transpose();
    EXPECT_NEAR(logarithmic_energy(points), -10.428018, 1e-4 * 10.428018);  // a tenth of what half an edge allows
}

TEST(SingularPlaces, OnTheDiskTheyAreAtOneRadius) {
    const TriangleMesh mesh = disk(30);
    for (const auto method : {"gl", "mbo"}) {
        const auto found = surface_singularities(direction_field(mesh, {.method = method})).points;
        ASSERT_EQ(found.size(), 4u);
        for (const auto& point : found) EXPECT_NEAR(point.position.norm(), found[0].position.norm(), 0.2 / 30);
    }
}

TEST(SingularPlaces, CornersOfACubeKeepTheirs) {
    const TriangleMesh cube = cube_surface(6);
    const auto found = surface_singularities(direction_field({cube, detect_features(cube)}, {})).points;
    ASSERT_EQ(found.size(), 8u);
    for (const auto& point : found) {
        ASSERT_GE(point.vertex, 0);
        EXPECT_EQ(point.position, Vector(cube.vertices.row(point.vertex)));
    }
}

TEST(SingularPlaces, PointsNearerThanAnEdgeKeepTheirSumAndMoveNoFurtherThanAnEdge) {
    const int n = 20;
    const TriangleMesh mesh = disk(n);
    for (const double apart : {0.2, 0.6, 1.2, 2.0})
        for (const int sign : {1, -1}) {
            const std::vector<Zero> zeros = {{{0.31, 0.12}, 1},
                                             {Complex(0.31, 0.12) + std::polar(apart / n, 0.7), sign}};
            const auto direction = [&](const Vector& x) -> Vector {
                const double angle = angle_of(zeros, flat(x), 4);
                return {std::cos(angle), std::sin(angle), 0};
            };
            const auto found = surface_singularities(prescribed(mesh, 4, direction, up));
            EXPECT_TRUE(found.agree);
            int inside = 0;
            for (const auto& point : found.points) {
                if (point.boundary) continue;
                inside += point.index_times_symmetry;
                const Vector from(0.31, 0.12, 0);
                EXPECT_LT((point.position - from).norm(), (apart + 2) / n);
            }
            EXPECT_EQ(inside, 1 + sign);
        }
}

}  // namespace
}  // namespace octafield::surface
