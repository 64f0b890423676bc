// Closed surfaces: spheres and tori.
#include "imposed_fixtures.hpp"
#include "octafield/error.hpp"

namespace octafield::surface {
namespace {

SingularPattern valence_3(const SurfaceDomain& domain, const std::vector<Vector>& points) {
    SingularPattern pattern;
    for (const Vector& x : points) pattern.points.push_back(imposed_point(domain, x, 1));
    return pattern;
}

std::vector<Vector> antiprism() {
    std::vector<Vector> points;
    const double z = 0.56462, r = std::sqrt(1 - z * z);
    for (int i = 0; i < 8; ++i) points.emplace_back(r * std::cos(i * pi / 4), r * std::sin(i * pi / 4), i % 2 ? z : -z);
    return points;
}

TEST(ImposedOnSphere, SizeIsTheSumOfLogarithmsOfChords) {
    const double largest[] = {1.6e-2, 3e-3, 7e-4};
    int level = 0;
    for (const int subdivisions : {3, 4, 5}) {
        const SurfaceDomain domain(icosphere(subdivisions));
        // Turned, so that nothing falls on vertices by symmetry.
        std::vector<Vector> points = antiprism();
        for (Vector& x : points) x = Eigen::AngleAxisd(0.3, Vector(1, 2, 3).normalized()) * x;
        const ImposedField field = impose_singular_points(domain, valence_3(domain, points));
        const Errors errors = potential_errors(
            field,
            [&](const Vector& x) {
                double sum = 0;
                for (const Vector& p : points) sum += std::log((x - p).norm()) / 4;
                return sum;
            },
            [&](const Vector& x) {
                return std::all_of(points.begin(), points.end(),
                                   [&](const Vector& p) { return (x - p).norm() > 0.15; });
            });
        EXPECT_LT(errors.largest, largest[level++]);
        EXPECT_LT(field.closure, 1e-9);
        EXPECT_TRUE(field.conditions.empty());
    }
}

TEST(ImposedOnSphere, AnyEightPointsOfValenceThreeWillDo) {
    const SurfaceDomain domain(icosphere(4));
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    for (int trial = 0; trial < 3; ++trial) {
        std::vector<Vector> points;
        for (int i = 0; i < 8; ++i)
            points.push_back(Vector(normal(random), normal(random), normal(random)).normalized());
        const ImposedField field = impose_singular_points(domain, valence_3(domain, points));
        EXPECT_LT(field.closure, 1e-9);
        const auto found = found_indices(field.field);
        EXPECT_EQ(found.size(), 8u);
        for (const Index v : field.point_vertices) EXPECT_EQ(found.count(v) ? found.at(v) : 0, 1);
    }
}

TEST(ImposedOnTorus, WithoutPointsSizeIsTheDistanceFromTheAxis) {
    const double largest[] = {1.2e-3, 3e-4};
    int level = 0;
    for (const int n : {60, 120}) {
        const SurfaceDomain domain(torus(n, n / 2, 1, 0.5));
        const ImposedField field = impose_singular_points(domain, {});
        const Errors errors = potential_errors(
            field, [](const Vector& x) { return std::log(std::hypot(x[0], x[1])); },
            [](const Vector&) { return true; });
        EXPECT_LT(errors.largest, largest[level++]);
        ASSERT_EQ(field.conditions.size(), 2u);
        for (const auto& c : field.conditions) {
            EXPECT_FALSE(c.boundary);
            EXPECT_LT(std::abs(c.angle), 1e-9);
        }
        EXPECT_TRUE(surface_singularities(field.field).points.empty());
    }
}

// Angle of the misfit over both generators, whichever loops they are: t (a - b) in the lattice of a flat torus.
double largest_angle(const ImposedField& field) {
    double largest = 0;
    for (const auto& c : field.conditions) largest = std::max(largest, std::abs(c.angle));
    return largest;
}

ImposedField one_pair(const SurfaceDomain& domain, const Vector& a, const Vector& b) {
    SingularPattern pattern;
    pattern = add_singular_pair(domain, {}, a, b);
    return impose_singular_points(domain, pattern, rotate);
}

TEST(ImposedOnTorus, OnePairIsInadmissibleByItsDistanceRound) {
    const SurfaceDomain domain(torus(120, 60, 1, 0.5));
    const auto at = [](double u, double v) {
        return Vector((1 + 0.5 * std::cos(v)) * std::cos(u), (1 + 0.5 * std::cos(v)) * std::sin(u), 0.5 * std::sin(v));
    };
    const double u = 2 * pi * 6 / 120, v = 2 * pi * 9 / 60;
    const ImposedField round = one_pair(domain, at(u, v), at(u + 0.3 * 2 * pi, v));
    EXPECT_NEAR(largest_angle(round), 27 * degree, 0.05 * degree);
    EXPECT_LT(round.closure, 1e-9);
    EXPECT_EQ(surface_singularities(round.field).points.size(), 2u);
    // Along the meridian from v = 0 to 90 degrees: 90 times the part of int r dv / (R + r cos v).
    const ImposedField meridian = one_pair(domain, at(u, 0), at(u, pi / 2));
    double part = 0, all = 0;
    for (int i = 0; i < 4000; ++i) {
        const double step = 1 / (1 + 0.5 * std::cos(2 * pi * (i + 0.5) / 4000));
        all += step;
        if (i < 1000) part += step;
    }
    EXPECT_NEAR(largest_angle(meridian), 90 * degree * part / all, 0.05 * degree);
    SingularPattern pattern;
    pattern = add_singular_pair(domain, {}, at(u, 0), at(u, pi / 2));
    try {
        impose_singular_points(domain, pattern);
        FAIL() << "no error";
    } catch (const InvalidInput& error) {
        EXPECT_EQ(error.kind(), "inadmissible_pattern");
        EXPECT_NE(std::string(error.what()).find("generator"), std::string::npos);
    }
}

TEST(ImposedOnTorus, PointsMoveUntilTheFieldClosesRoundBothGenerators) {
    const SurfaceDomain domain(torus(60, 30, 1, 0.5));
    std::vector<Vector> places;
    SingularPattern pattern;
    for (int i = 0; i < 4; ++i) {
        const double u = 2 * pi * (0.05 + 0.13 * i), v = 1.3 * i + 0.4;
        const double r = 1 + 0.5 * std::cos(v);
        pattern.points.push_back(
            imposed_point(domain, Vector(r * std::cos(u), r * std::sin(u), 0.5 * std::sin(v)) * 0.999, i % 2 ? 1 : -1));
    }
    const ImposedField before = impose_singular_points(domain, pattern, rotate);
    const ImposedField field = impose_singular_points(domain, pattern, {.inadmissible = Inadmissible::move});
    EXPECT_GT(largest_angle(before), degree);
    EXPECT_LT(largest_angle(field), 1e-6);
    EXPECT_LT(field.closure, 1e-9);
    EXPECT_EQ(surface_singularities(field.field).points.size(), 4u);
}

}  // namespace
}  // namespace octafield::surface
