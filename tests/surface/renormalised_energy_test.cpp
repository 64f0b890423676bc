// Closed forms against each other, published values, and the core constant from the radial equation.
#include "octafield/surface/renormalised_energy.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "octafield/error.hpp"

namespace octafield::surface {
namespace {

using Complex = std::complex<double>;
using std::numbers::pi;

std::vector<Complex> polygon(int d, double r, double turn = 0.3) {
    std::vector<Complex> points;
    for (int i = 0; i < d; ++i) points.push_back(std::polar(r, turn + 2 * pi * i / d));
    return points;
}

TEST(RenormalisedEnergy, PolygonsAgreeWithTheSumOverPairs) {
    for (int d = 1; d <= 12; ++d)
        for (const double r : {0.1, 0.5, 0.9, 0.99})
            EXPECT_NEAR(disk_renormalised_energy(polygon(d, r)), disk_polygon_energy(d, r), 1e-10 * d * d);
}

TEST(RenormalisedEnergy, PolygonsHaveThePublishedRadiiAndEnergies) {
    const struct {
        int d;
        double radius, energy;
    } table[] = {{2, 0.66874, -0.42502},  {3, 0.79370, -3.28767},  {4, 0.85009, -7.29615},  {5, 0.88225, -12.12436},
                 {6, 0.90305, -17.59693}, {8, 0.92835, -30.06110}, {12, 0.95292, -59.45577}};
    for (const auto& row : table) {
        const double r = disk_polygon_radius(row.d);
        EXPECT_NEAR(r, row.radius, 5e-6);
        EXPECT_NEAR(disk_polygon_energy(row.d, r), row.energy, 5e-6);
        for (const double step : {-1e-3, 1e-3})
            EXPECT_GT(disk_polygon_energy(row.d, r + step), disk_polygon_energy(row.d, r));
    }
}

TEST(RenormalisedEnergy, BestPolygonIsALocalMinimumOverFreePositions) {
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    for (const int d : {2, 3, 4, 5, 6, 8}) {
        const auto best = polygon(d, disk_polygon_radius(d));
        for (int trial = 0; trial < 50; ++trial) {
            auto points = best;
            for (Complex& point : points) point += 1e-3 * Complex(normal(random), normal(random));
            EXPECT_GT(disk_renormalised_energy(points), disk_renormalised_energy(best) - 1e-12);
        }
    }
}

TEST(RenormalisedEnergy, IsTheFluxIntegralOfTheDefinition) {
    // W = -pi sum_{i != j} log|x_i - x_j| - pi sum R(x_i), R the harmonic part of the solution of the Neumann problem,
    // here found by Fourier series from the flux sum_i Re((1 - x_i conj z) ...) on 256 points of the circle.
    const std::vector<Complex> points = {{0.3, 0.2}, {-0.5, 0.1}, {0.1, -0.6}};
    constexpr int n = 256;
    const double d = static_cast<double>(points.size());
    std::vector<double> flux(n), trace(n);
    for (int k = 0; k < n; ++k) {
        const Complex z = std::polar(1.0, 2 * pi * k / n);
        for (const Complex& x : points) {
            flux[k] += (std::conj(z) * (z - x)).real() / std::norm(z - x);
            trace[k] += std::log(std::abs(z - x));
        }
    }
    const auto harmonic = [&](const Complex& x) {  // normal derivative d - flux, mean of trace + harmonic 0
        double value = 0;
        for (int k = 0; k < n; ++k) value -= trace[k] / n;
        for (int m = 1; m < n / 2; ++m) {
            Complex coefficient = 0;
            for (int k = 0; k < n; ++k) coefficient += (d - flux[k]) * std::polar(1.0, -2 * pi * m * k / n);
            value += (2.0 / n * coefficient * std::pow(x, m)).real() / m;
        }
        return value;
    };
    double energy = 0;
    for (const Complex& a : points) {
        energy -= pi * harmonic(a);
        for (const Complex& b : points)
            if (a != b) energy -= pi * std::log(std::abs(a - b));
    }
    EXPECT_NEAR(disk_renormalised_energy(points), energy, 1e-9);
}

// Least energy of a vortex on the disk of `radius` coherence lengths: Newton's method for the radial profile, values at
// (i + 1/2) h, second order.
double vortex_energy(double radius, int cells) {
    const double h = radius / cells;
    std::vector<double> rho(cells), lower(cells), diagonal(cells), upper(cells), rest(cells);
    for (int i = 0; i < cells; ++i) rho[i] = std::tanh((i + 0.5) * h / 1.7);
    const auto weight = [&](int face) { return face == cells ? 2 * radius / h : face * h / h; };  // r / h at face r
    for (int iteration = 0; iteration < 30; ++iteration) {
        double largest = 0;
        for (int i = 0; i < cells; ++i) {
            const double r = (i + 0.5) * h, next = i + 1 < cells ? rho[i + 1] : 1, before = i > 0 ? rho[i - 1] : 0;
            rest[i] = weight(i + 1) * (rho[i] - next) + weight(i) * (rho[i] - before) +
                      h * (rho[i] / r - r * rho[i] * (1 - rho[i] * rho[i]));
            lower[i] = -weight(i);
            upper[i] = i + 1 < cells ? -weight(i + 1) : 0;
            diagonal[i] = weight(i + 1) + weight(i) + h * (1 / r - r * (1 - 3 * rho[i] * rho[i]));
        }
        for (int i = 1; i < cells; ++i) {
            const double factor = lower[i] / diagonal[i - 1];
            diagonal[i] -= factor * upper[i - 1];
            rest[i] -= factor * rest[i - 1];
        }
        for (int i = cells - 1; i >= 0; --i) {
            rest[i] = (rest[i] - (i + 1 < cells ? upper[i] * rest[i + 1] : 0)) / diagonal[i];
            rho[i] -= rest[i];
            largest = std::max(largest, std::abs(rest[i]));
        }
        if (largest < 1e-13) break;
    }
    double energy = 0;
    for (int i = 0; i < cells; ++i) {
        const double r = (i + 0.5) * h, next = i + 1 < cells ? rho[i + 1] : 1, gap = 1 - rho[i] * rho[i];
        energy +=
            pi * (weight(i + 1) * (rho[i] - next) * (rho[i] - next) + h * (rho[i] * rho[i] / r + r * gap * gap / 2));
    }
    return energy;
}

TEST(RenormalisedEnergy, CoreConstantSolvesTheRadialProblem) {
    // On the circle of radius R the energy differs from its limit by pi / (4 R^2) and the boundary layer there.
    double constants[2];
    for (const int i : {0, 1}) {
        const double radius = 20 << i;
        const double coarse = vortex_energy(radius, 4000), fine = vortex_energy(radius, 8000);
        constants[i] = fine + (fine - coarse) / 3 - pi * std::log(radius);
    }
    EXPECT_NEAR(constants[1], core_energy, 3e-3);
    EXPECT_NEAR(constants[1] + (constants[1] - constants[0]) / 3, core_energy, 3e-4);
}

TEST(RenormalisedEnergy, SphereConfigurationsHaveTheKnownLogarithmicEnergies) {
    const auto prism = [](double z, double turn) {
        Points points(8, 3);
        for (int i = 0; i < 8; ++i) {
            const double angle = pi / 2 * (i % 4) + (i < 4 ? 0 : turn), r = std::sqrt(1 - z * z);
            points.row(i) << r * std::cos(angle), r * std::sin(angle), i < 4 ? z : -z;
        }
        return points;
    };
    EXPECT_NEAR(logarithmic_energy(prism(1 / std::sqrt(3.0), 0)), -10.383657, 1e-6);
    EXPECT_NEAR(logarithmic_energy(prism(0.56462, pi / 4)), -10.428018, 1e-6);
    const double g = std::numbers::phi, s = 1 / std::sqrt(1 + g * g);
    Points ico(12, 3);
    ico << -1, g, 0, 1, g, 0, -1, -g, 0, 1, -g, 0, 0, -1, g, 0, 1, g, 0, -1, -g, 0, 1, -g, g, 0, -1, g, 0, 1, -g, 0, -1,
        -g, 0, 1;
    ico *= s;
    EXPECT_NEAR(logarithmic_energy(ico), -21.606145, 1e-6);
}

TEST(RenormalisedEnergy, OnTheSphereItIsTheEnergyOfTheFieldBetweenItsPoints) {
    // N = 1, points at the poles, direction along the meridians: 1/2 int |grad|^2 = 1/2 int cot^2 over the sphere
    // without caps of radius rho = 2 pi (log cot(rho / 2) - cos rho), whose limit beside 2 pi log(1 / rho) is W.
    Points poles(2, 3);
    poles << 0, 0, 1, 0, 0, -1;
    const double rho = 1e-5;
    EXPECT_NEAR(sphere_renormalised_energy(poles),
                2 * pi * (-std::log(std::tan(rho / 2)) - std::cos(rho)) + 2 * pi * std::log(rho), 1e-8);
}

TEST(RenormalisedEnergy, AsymptoticEnergyOfTheDiskIsNearTheComputedOnes) {
    // Energies of another solver at epsilon 0.05 and 0.03 on 21600 and 48600 triangles: 35.00, 41.46.
    const double w = disk_polygon_energy(4, disk_polygon_radius(4));
    EXPECT_NEAR(asymptotic_energy(4, w, 0.05), 35.00, 0.2);
    EXPECT_NEAR(asymptotic_energy(4, w, 0.03), 41.46, 0.2);
}

TEST(RenormalisedEnergy, RefusesPointsThatHaveNone) {
    EXPECT_THROW(disk_renormalised_energy(std::vector<Complex>{{0.1, 0}, {0.1, 0}}), InvalidInput);
    EXPECT_THROW(disk_renormalised_energy(std::vector<Complex>{{1, 0}}), InvalidInput);
    EXPECT_THROW(disk_renormalised_energy(std::vector<Complex>{{std::numeric_limits<double>::quiet_NaN(), 0}}),
                 InvalidInput);
    EXPECT_THROW(disk_polygon_energy(0, 0.5), InvalidInput);
    EXPECT_THROW(disk_polygon_energy(3, 1), InvalidInput);
    EXPECT_THROW(disk_polygon_radius(0), InvalidInput);
    Points one(1, 3);
    one << 0, 0, 1;
    EXPECT_THROW(sphere_renormalised_energy(one), InvalidInput);
    Points off(2, 3);
    off << 0, 0, 1, 0, 0, -2;
    try {
        sphere_renormalised_energy(off);
        FAIL();
    } catch (const InvalidInput& error) {
        EXPECT_EQ(error.elements(), std::vector<Index>{1});
    }
    EXPECT_THROW(asymptotic_energy(4, 0, 0), InvalidInput);
}

}  // namespace
}  // namespace octafield::surface
