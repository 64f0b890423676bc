// Power sums of two lines, against numbers derived from the definition and quadrature on the circle.
#include "octafield/surface/two_lines.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace octafield::surface {
namespace {

using std::numbers::pi;
constexpr double degree = pi / 180;

void expect_same_lines(const TwoLines& a, const TwoLines& b, double tolerance) {
    const auto apart = [](double x, double y) { return std::abs(std::remainder(x - y, pi)); };
    const double straight = std::max(apart(a.first, b.first), apart(a.second, b.second));
    const double crossed = std::max(apart(a.first, b.second), apart(a.second, b.first));
    EXPECT_LT(std::min(straight, crossed), tolerance);
}

TEST(TwoLines, FourierCoefficientsAreThoseOfTheDefinition) {
    const PowerSums right = power_sums({0, 90 * degree}), oblique = power_sums({0, 60 * degree});
    EXPECT_NEAR(std::abs(right.p1), 0, 1e-15);
    EXPECT_NEAR(std::abs(right.p2 - 2.0), 0, 1e-15);
    EXPECT_NEAR(std::abs(4.0 * oblique.p1 - std::complex<double>(2, 3.464101615137755)), 0, 1e-14);
    EXPECT_NEAR(std::abs(oblique.p2 - std::complex<double>(0.5, -0.8660254037844386)), 0, 1e-14);
    EXPECT_NEAR(squared_distance(right, oblique, 1.5), 27, 1e-13);  // 16 lambda + 3
    EXPECT_NEAR(squared_distance(right, power_sums({10 * degree, 100 * degree}), 1.5),
                16 * std::pow(std::sin(20 * degree), 2), 1e-13);
}

// <a, s>^4 + <b, s>^4 on the circle, without its mean, which is the same for all.
TEST(TwoLines, DistanceIsTheL2DistanceOfTheQuarticForms) {
    const TwoLines p{0.3, 1.1}, q{-0.4, 2.0};
    const auto form = [](const TwoLines& l, double s) {
        return std::pow(std::cos(l.first - s), 4) + std::pow(std::cos(l.second - s), 4);
    };
    double integral = 0;
    for (int i = 0; i < 64; ++i) {
        const double s = 2 * pi * i / 64, difference = form(p, s) - form(q, s);
        integral += difference * difference * 2 * pi / 64;
    }
    EXPECT_NEAR(squared_distance(power_sums(p), power_sums(q), 1) * pi / 64, integral, 1e-12);
}

TEST(TwoLines, AllEightWaysToWriteACrossShareTheSums) {
    const PowerSums sums = power_sums({0.2, 1.5});
    for (const TwoLines lines : {TwoLines{0.2, 1.5}, TwoLines{1.5, 0.2}})
        for (const double a : {0.0, pi})
            for (const double b : {0.0, -pi}) {
                const PowerSums same = power_sums({lines.first + a, lines.second + b});
                EXPECT_NEAR(std::abs(same.p1 - sums.p1) + std::abs(same.p2 - sums.p2), 0, 1e-14);
            }
}

TEST(TwoLines, SumsDetermineTheLines) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> angle(-5, 5);
    for (int i = 0; i < 1000; ++i) {
        const TwoLines lines{angle(random), angle(random)};
        const auto found = lines_of(power_sums(lines));
        ASSERT_TRUE(found);
        // Where the lines nearly coincide, the difference is the root of a rounding error.
        expect_same_lines(*found, lines, angle_between(lines) > 1e-3 ? 1e-11 : 1e-7);
        EXPECT_GE(found->first, 0);
        EXPECT_LT(found->first, pi);
        EXPECT_GE(found->second, found->first);
        EXPECT_LT(found->second, found->first + pi);
    }
}

TEST(TwoLines, SumsOfScaledVectorsGiveTheLinesOfTheVectors) {
    const std::complex<double> u = std::polar(0.7, 0.5), v = std::polar(0.2, 2.2);
    const auto found = lines_of({u + v, u * u + v * v});
    ASSERT_TRUE(found);
    expect_same_lines(*found, {0.25, 1.1}, 1e-14);
}

TEST(TwoLines, OneVanishingRootGetsTheDirectionAcross) {
    const std::complex<double> u = std::polar(1.0, 0.6);
    const auto found = lines_of({u, u * u});
    ASSERT_TRUE(found);
    expect_same_lines(*found, {0.3, 0.3 + pi / 2}, 1e-14);
}

TEST(TwoLines, NothingHasNoLines) {
    EXPECT_FALSE(lines_of({0, 0}));
    EXPECT_FALSE(lines_of({NAN, 1}));
    EXPECT_FALSE(lines_of({INFINITY, 0}));
}

TEST(TwoLines, AngleBetweenIsThatOfLines) {
    EXPECT_NEAR(angle_between({0.1, 0.4}), 0.3, 1e-15);
    EXPECT_NEAR(angle_between({3.1, 0.1}), pi - 3, 1e-15);
    EXPECT_NEAR(angle_between({0, pi / 2}), pi / 2, 1e-15);
    EXPECT_NEAR(angle_between({0.1, 0.1 + 3 * pi}), 0, 1e-14);
}

}  // namespace
}  // namespace octafield::surface
