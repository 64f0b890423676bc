// Exact line search on a polynomial of degree 4.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace octafield::surface::detail {

// The t > 0 of the first local minimum of c[0] t + c[1] t^2 + c[2] t^3 + c[3] t^4, which falls from t = 0 on
// (c[0] < 0, or c[0] = 0 > c[1]) and has c[3] > 0.
inline double lowest_along(const std::array<double, 4>& c) {
    const auto slope = [&](double t) { return c[0] + t * (2 * c[1] + t * (3 * c[2] + t * 4 * c[3])); };
    // The slope rises up to `peak`, falls to `trough` and rises beyond: the roots of c1 + 3 c2 t + 6 c3 t^2, if any.
    double peak = 0, trough = 0;
    const double discriminant = 9 * c[2] * c[2] - 24 * c[1] * c[3];
    if (discriminant > 0) {
        const double q = -(3 * c[2] + std::copysign(std::sqrt(discriminant), c[2])) / 2;
        std::tie(peak, trough) = std::minmax(q / (6 * c[3]), c[1] / q);
    }
    double low = 0, high = peak;
    if (!(peak > 0 && slope(peak) > 0)) {
        low = std::max(0.0, trough);
        high = std::max(1.0, 2 * low);
        for (const double farthest = 1e12 * high; slope(high) < 0 && high < farthest; high *= 2) low = high;
    }
    for (double middle = (low + high) / 2; low < middle && middle < high; middle = (low + high) / 2)
        (slope(middle) < 0 ? low : high) = middle;
    return high;
}

}  // namespace octafield::surface::detail
