#include "sphere_quadrature.hpp"

#include <cmath>
#include <numbers>

namespace octafield::frames {
namespace {

struct Legendre {
    long double value, derivative;
};

Legendre legendre(int n, long double z) {
    long double before = 1, now = z;
    for (int l = 2; l <= n; ++l) {
        const long double next = ((2 * l - 1) * z * now - (l - 1) * before) / l;
        before = now, now = next;
    }
    return {now, n * (before - z * now) / (1 - z * z)};
}

}  // namespace

std::vector<SphereNode> sphere_quadrature(int points) {
    constexpr long double pi = std::numbers::pi_v<long double>;
    std::vector<SphereNode> nodes;
    for (int i = 0; i < points; ++i) {
        long double z = std::cos(pi * (i + 0.75L) / (points + 0.5L));
        for (int step = 0; step < 8; ++step) {
            const Legendre p = legendre(points, z);
            z -= p.value / p.derivative;
        }
        const long double slope = legendre(points, z).derivative, sine = std::sqrt(1 - z * z);
        const long double weight = 2 / ((1 - z * z) * slope * slope) * pi / points;
        for (int k = 0; k < 2 * points; ++k) {
            const long double azimuth = pi * k / points;
            nodes.push_back({sine * std::cos(azimuth), sine * std::sin(azimuth), z, weight});
        }
    }
    return nodes;
}

}  // namespace octafield::frames
