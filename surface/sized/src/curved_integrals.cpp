#include "curved_integrals.hpp"

#include <cmath>

#include "charts.hpp"

namespace octafield::surface::detail {
namespace {

// Below it the closed forms cancel, to 16 / 4 log10(1 / t) digits.
constexpr double series_below = 0.5;
constexpr int terms = 14;

// sum over n of g(n) (i t)^n / (n + 4)!, what is left of exp(i t) / t^4 times a polynomial.
template <class Coefficient>
Complex series(double t, const Coefficient& g) {
    Complex sum = 0, power = 1;
    double factorial = 24;
    for (int n = 0; n < terms; ++n) {
        sum += g(n) * power / factorial;
        power *= Complex(0, t);
        factorial *= n + 5;
    }
    return sum;
}

Complex turned(double t) { return std::polar(1.0, t); }

}  // namespace

// m = (6 e^it - 6 - 6it + 3t^2 + it^3) / (3 t^4).
Complex mass_factor(double t) {
    if (std::abs(t) < series_below) return series(t, [](int) { return 2.0; });
    const Complex i(0, 1);
    return (6.0 * turned(t) - 6.0 - 6.0 * i * t + 3.0 * t * t + i * t * t * t) / (3 * std::pow(t, 4));
}

// f1 = (3 + it + t^4/24 - it^5/60 + (-3 + 2it + t^2/2) e^it) / t^4. Of (it)^n+4 / (n+4)! e^it leaves -3 + 2 (n+4) -
// (n+4)(n+3)/2.
Complex stiffness_factor(double t) {
    const Complex i(0, 1);
    if (std::abs(t) < series_below)
        return series(t, [](int n) { return -3 + 2.0 * (n + 4) - (n + 4) * (n + 3) / 2.0; }) + 1.0 / 24 - i * t / 60.0;
    const double square = t * t;
    return (3.0 + i * t + square * square / 24 - i * square * square * t / 60.0 +
            (-3.0 + 2.0 * i * t + square / 2) * turned(t)) /
           (square * square);
}

// f2 = (4 + it - it^3/6 - t^4/12 + it^5/30 + (-4 + 3it + t^2) e^it) / t^4, likewise.
Complex product_factor(double t) {
    const Complex i(0, 1);
    if (std::abs(t) < series_below)
        return series(t, [](int n) { return -4 + 3.0 * (n + 4) - (n + 4.0) * (n + 3); }) - 1.0 / 12 + i * t / 30.0;
    const double square = t * t;
    return (4.0 + i * t - i * square * t / 6.0 - square * square / 12 + i * square * square * t / 30.0 +
            (-4.0 + 3.0 * i * t + square) * turned(t)) /
           (square * square);
}

TriangleMatrices triangle_matrices(const std::array<Complex, 3>& corners, const std::array<Complex, 3>& steps) {
    TriangleMatrices result;
    const double t = result.holonomy = std::arg(steps[0] * steps[1] * steps[2]);
    const double area = cross(corners[1] - corners[0], corners[2] - corners[0]) / 2;
    for (int k = 0; k < 3; ++k) {
        const int j = (k + 1) % 3, l = (k + 2) % 3;  // the two other corners
        const Complex to_j = corners[j] - corners[k], to_l = corners[l] - corners[k];
        const double near = std::norm(to_j), far = std::norm(to_l), product = dot(to_j, to_l);
        result.mass[k][k] = area / 6;
        result.stiffness[k][k] = (std::norm(to_l - to_j) + t * t * (near + product + far) / 90) / (4 * area);
        const Complex back = std::conj(steps[j]);
        result.mass[j][l] = back * area * mass_factor(t);
        result.stiffness[j][l] = back * ((near + far) * stiffness_factor(t) + product * product_factor(t)) / area;
        result.mass[l][j] = std::conj(result.mass[j][l]);
        result.stiffness[l][j] = std::conj(result.stiffness[j][l]);
    }
    return result;
}

}  // namespace octafield::surface::detail
