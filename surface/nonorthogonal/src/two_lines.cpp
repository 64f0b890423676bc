#include "octafield/surface/two_lines.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace octafield::surface {
namespace {

using Complex = std::complex<double>;
using std::numbers::pi;
constexpr double vanishing = 1e-12;  // a root beside the other one

double modulo_pi(double angle) {
    const double rest = angle - pi * std::floor(angle / pi);
    return rest < pi ? rest : 0;  // rounding
}

}  // namespace

PowerSums power_sums(const TwoLines& lines) {
    const Complex u = std::polar(1.0, 2 * lines.first), v = std::polar(1.0, 2 * lines.second);
    return {u + v, u * u + v * v};
}

TwoLines ordered(const TwoLines& lines) {
    const auto [low, high] = std::minmax({modulo_pi(lines.first), modulo_pi(lines.second)});
    return {low, high};
}

std::optional<TwoLines> lines_of(const PowerSums& sums) {
    const Complex difference = std::sqrt(2.0 * sums.p2 - sums.p1 * sums.p1);
    Complex u = (sums.p1 + difference) / 2.0, v = (sums.p1 - difference) / 2.0;
    if (std::abs(u) < std::abs(v)) std::swap(u, v);
    if (!(std::abs(u) > 0) || !std::isfinite(std::abs(u))) return {};
    if (std::abs(v) < vanishing * std::abs(u)) v = -u;
    return ordered({std::arg(u) / 2, std::arg(v) / 2});
}

double angle_between(const TwoLines& lines) {
    const double angle = modulo_pi(lines.second - lines.first);
    return std::min(angle, pi - angle);
}

double squared_distance(const PowerSums& a, const PowerSums& b, double lambda) {
    return lambda * 16 * std::norm(a.p1 - b.p1) + std::norm(a.p2 - b.p2);
}

}  // namespace octafield::surface
