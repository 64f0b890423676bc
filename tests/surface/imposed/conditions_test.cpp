// What patterns miss on domains with holes, and how it is mended.
#include "imposed_fixtures.hpp"
#include "octafield/error.hpp"

namespace octafield::surface {
namespace {

const ImposedFieldOptions move{.inadmissible = Inadmissible::move};

// Four of valence 5 on a circle, four of valence 3 on a wider one, turned by delta.
std::vector<Source> two_rings(double delta) {
    std::vector<Source> sources;
    for (int i = 0; i < 4; ++i) {
        sources.push_back({std::polar(0.5, 0.2 + i * pi / 2), -1});
        sources.push_back({std::polar(0.75, 0.2 + delta + i * pi / 2), 1});
    }
    return sources;
}

// The misfit of a round annulus: sum k_j phi_j.
double annulus_formula(const std::vector<Source>& sources) {
    double sum = 0;
    for (const Source& s : sources) sum += s.index_times_four / 4.0 * std::arg(s.at);
    return modulo_quarter(sum);
}

double difference(double a, double b) { return std::abs(modulo_quarter(a - b)); }

TEST(ImposedConditions, AnnulusIsMissedByTheTurnOfItsRings) {
    const SurfaceDomain domain(annulus(0.3, 120, 24));
    for (const double delta : {0.0, 10.0, 22.5, 45.0, 60.0}) {
        const ImposedField field =
            impose_singular_points(domain, pattern_of(domain, two_rings(delta * degree)), rotate);
        ASSERT_EQ(field.conditions.size(), 1u);
        EXPECT_LT(difference(std::abs(field.conditions[0].angle), std::abs(modulo_quarter(delta * degree))),
                  0.02 * degree);
    }
}

TEST(ImposedConditions, RandomPatternsAreMissedByTheirFormula) {
    const SurfaceDomain domain(annulus(0.3, 120, 24));
    std::mt19937 random(7);
    std::uniform_real_distribution<double> radius(0.4, 0.9), angle(0, 2 * pi);
    for (int trial = 0; trial < 4; ++trial) {
        std::vector<Source> sources;
        for (const int t : {1, 1, -1, -1, 2, -2}) sources.push_back({std::polar(radius(random), angle(random)), t});
        const ImposedField field = impose_singular_points(domain, pattern_of(domain, sources), rotate);
        const double formula = annulus_formula(sources), angle_found = field.conditions[0].angle;
        EXPECT_LT(std::min(difference(angle_found, formula), difference(-angle_found, formula)), 0.02 * degree);
    }
}

TEST(ImposedConditions, RotationMakesBothCirclesFollowed) {
    const SurfaceDomain domain(annulus(0.3, 160, 32));
    const ImposedField field = impose_singular_points(domain, pattern_of(domain, two_rings(10 * degree)), rotate);
    EXPECT_LT(field.closure, 1e-9);
    EXPECT_NEAR(std::abs(field.conditions[0].rotation), 10 * degree, 0.02 * degree);
    // exp(10 degrees * 2 pi / |log 0.3|)
    EXPECT_NEAR(field.conditions[0].size_factor, 2.487, 3e-3);
    const auto singularities = surface_singularities(field.field);
    EXPECT_LT(singularities.boundary_deviation, 1e-9);
    EXPECT_EQ(singularities.points.size(), 8u);
    EXPECT_TRUE(singularities.agree);
    std::map<Index, int> expected;
    for (std::size_t i = 0; i < 8; ++i) expected[field.point_vertices[i]] = field.pattern.points[i].index_times_four;
    EXPECT_EQ(found_indices(field.field), expected);
}

TEST(ImposedConditions, ErrorNamesTheCurveTheAngleAndTheRemedy) {
    const TriangleMesh mesh = annulus(0.3, 120, 24);
    const SurfaceDomain domain(mesh);
    try {
        impose_singular_points(domain, pattern_of(domain, two_rings(10 * degree)));
        FAIL() << "no error";
    } catch (const InvalidInput& error) {
        EXPECT_EQ(error.kind(), "inadmissible_pattern");
        EXPECT_EQ(error.elements(), std::vector<Index>{0});  // lowest vertex of the inner circle
        const std::string text = error.what();
        EXPECT_TRUE(text.find("10 degrees") != std::string::npos || text.find("10.0 degrees") != std::string::npos ||
                    text.find("9.99 degrees") != std::string::npos || text.find("-10 degrees") != std::string::npos)
            << text;
        EXPECT_NE(text.find("move"), std::string::npos) << text;
    }
    EXPECT_NO_THROW(impose_singular_points(domain, pattern_of(domain, two_rings(0.5 * degree))));
}

TEST(ImposedConditions, MovingPointsOnAnAnnulusIsAsShortAsItCanBe) {
    const SurfaceDomain domain(annulus(0.3, 120, 24));
    const auto sources = two_rings(10 * degree);
    const ImposedField field = impose_singular_points(domain, pattern_of(domain, sources), move);
    EXPECT_LT(std::abs(field.conditions[0].angle), 1e-6);
    EXPECT_LT(field.closure, 1e-9);
    // Independently: the moved places satisfy the closed form; the first-order step of least norm is along the circles
    // and proportional to 1 / radius: angle_j = c / r_j^2 with sum |k_j| c / r_j^2 = 10 degrees.
    std::vector<Source> now;
    for (const ImposedPoint& p : field.pattern.points) {
        const Vector x = imposed_position(domain, p);
        now.push_back({{x[0], x[1]}, p.index_times_four});
    }
    EXPECT_LT(std::abs(annulus_formula(now)), 0.02 * degree);
    const double c = 10 * degree / (1 / (0.5 * 0.5) + 1 / (0.75 * 0.75));
    EXPECT_NEAR(field.largest_move, c / 0.5, 0.05 * c / 0.5);
    for (std::size_t j = 0; j < now.size(); ++j)
        EXPECT_NEAR(std::abs(now[j].at - sources[j].at), c / std::abs(sources[j].at), 0.1 * c);
}

TEST(ImposedConditions, EightPointsRoundTwoHolesAreMoved) {
    const SurfaceDomain domain(two_holes(16, 0.2));
    std::vector<Source> sources;
    for (int i = 0; i < 4; ++i) {
        sources.push_back({Complex(-0.5, 0) + std::polar(0.36, 0.85 + i * pi / 2), -1});
        sources.push_back({Complex(0.5, 0) + std::polar(0.33, 0.7 + i * pi / 2 + 0.05 * i), -1});
    }
    const SingularPattern pattern = pattern_of(domain, sources);
    const ImposedField before = impose_singular_points(domain, pattern, rotate);
    ASSERT_EQ(before.conditions.size(), 2u);
    EXPECT_GT(std::abs(before.conditions[0].angle), degree);
    const ImposedField field = impose_singular_points(domain, pattern, move);
    for (const HolonomyCondition& c : field.conditions) {
        EXPECT_TRUE(c.boundary);
        EXPECT_LT(std::abs(c.angle), 1e-6);
        EXPECT_NEAR(c.size_factor, 1, 1e-4);
    }
    EXPECT_LT(field.largest_move, 0.15);
    EXPECT_LT(surface_singularities(field.field).boundary_deviation, 1e-9);
}

}  // namespace
}  // namespace octafield::surface
