// From invariants back to quaternions.

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "nearest_frame.hpp"
#include "octafield/frames/su2.hpp"
#include "su2_starts.hpp"

namespace octafield::frames {
namespace {

using Complex2 = Eigen::Matrix<Complex, 2, 1>;

// h of (u, v) / scale. Divided step by step, so that powers of the scale neither overflow nor underflow.
Complex3 scaled(const Complex3& h, double scale) {
    const double four = std::pow(scale, 4), six = std::pow(scale, 6);
    return {h[0] / four / four, h[1] / six / six, h[2] / six / six / six};
}

// The order of magnitude of |(u, v)|.
double size_of(const Complex3& h) {
    return std::max(
        {std::pow(std::abs(h[0]), 1.0 / 8), std::pow(std::abs(h[1]), 1.0 / 12), std::pow(std::abs(h[2]), 1.0 / 18)});
}

// The root of 16 x^3 - h0 x + h1 = 0 that is largest in modulus. The roots have sum zero, so it is apart from both
// others by at least its modulus. Cardano, then Newton.
Complex largest_axis_root(const Complex& h0, const Complex& h1) {
    const Complex p = h0 / 16.0, r = h1 / 16.0;  // x^3 - p x + r
    const Complex discriminant = std::sqrt(r * r / 4.0 - p * p * p / 27.0);
    const Complex plus = -r / 2.0 + discriminant, minus = -r / 2.0 - discriminant;
    const Complex cube = std::abs(plus) >= std::abs(minus) ? plus : minus;
    if (cube == 0.0) return 0;
    const Complex first = std::pow(cube, 1.0 / 3), turn(-0.5, std::sqrt(0.75));
    Complex best = 0;
    for (const Complex& c : {first, first * turn, first * std::conj(turn)}) {
        const Complex root = c + p / (3.0 * c);
        if (std::abs(root) > std::abs(best)) best = root;
    }
    for (int step = 0; step < 2; ++step) best -= ((best * best - p) * best + r) / (3.0 * best * best - p);
    return best;
}

// All three roots, the largest first; the others from the quadratic that is left.
std::array<Complex, 3> axis_roots(const Complex& h0, const Complex& h1) {
    const Complex largest = largest_axis_root(h0, h1);
    if (largest == 0.0) return {};
    const Complex product = -h1 / (16.0 * largest);  // and sum -largest
    const Complex root = std::sqrt(largest * largest - 4.0 * product);
    const Complex minus = -largest - root, plus = -largest + root;
    const Complex second = (std::abs(minus) >= std::abs(plus) ? minus : plus) / 2.0;
    return {largest, second, product / second};
}

Complex eighth_root(const Complex& z) { return std::sqrt(std::sqrt(std::sqrt(z))); }

// One (u, v) with invariants h up to rounding, if h is on the surface: see the header. Else anything, NaN included.
Complex2 solve(const Complex3& h) {
    const Complex x = largest_axis_root(h[0], h[1]), a = std::sqrt(x);
    const Complex sum = h[0] - 14.0 * x * x, difference = h[2] / (a * (h[0] - 48.0 * x * x));
    const Complex u8 = (sum + difference) / 2.0, v8 = (sum - difference) / 2.0;
    // The larger one of u and v has the smaller relative error.
    if (std::abs(u8) >= std::abs(v8)) {
        const Complex u = eighth_root(u8);
        return {u, a / u};
    }
    const Complex v = eighth_root(v8);
    return {a / v, v};
}

// Gauss-Newton in (u, v). The Jacobian's condition is below 27 (header), so normal equations lose nothing that matters.
Complex2 polished(Complex2 uv, const Complex3& h) {
    constexpr int steps = 3;
    for (int step = 0; step < steps; ++step) {
        const Su2::Jacobian j = Su2::jacobian(uv[0], uv[1]);
        const Eigen::Matrix<Complex, 2, 2> normal = j.adjoint() * j;
        uv += normal.inverse() * (j.adjoint() * (h - Su2::invariants(uv[0], uv[1])));
    }
    return uv;
}

void require_tolerance(double tolerance) {
    if (tolerance > 0 && std::isfinite(tolerance)) return;
    throw InvalidInput("tolerance: " + std::to_string(tolerance) + " is not a positive finite number", "bad_option");
}

[[noreturn]] void throw_off_surface(const Complex3& h, double misfit, double tolerance) {
    if (!std::isfinite(misfit))
        throw InvalidInput(
            "(h0, h1, h2) is not on the model surface h2^2 = h1 (h0^3 - 108 h1^2): beside h2 its h0 and h1 vanish, "
            "which "
            "no quaternion has; project it first (scaling a quaternion by s scales h0, h1, h2 by s^8, s^12, s^18)",
            "off_surface");
    char text[320];
    std::snprintf(
        text, sizeof text,
        "(h0, h1, h2) is not on the model surface h2^2 = h1 (h0^3 - 108 h1^2): scaled to a unit quaternion it "
        "is %.3g away (tolerance %.3g), the residual of the equation there is %.3g; project it first",
        misfit, tolerance, std::abs(Su2::surface_residual(h)));
    throw InvalidInput(text, "off_surface");
}

Quaternion inverse_one(const Complex3& h, double tolerance) {
    require_finite(h, "the point (h0, h1, h2)");
    require_tolerance(tolerance);
    const double size = size_of(h);
    if (!(size > 0)) throw InvalidInput("(h0, h1, h2) = 0 is no frame: no quaternion has these invariants", "zero");
    const Complex3 k = scaled(h, size);
    const Complex2 uv = polished(solve(k), k);
    const double squared = Su2::squared_norm(k), norm = squared > 0 ? std::sqrt(squared) : 1;
    const double misfit = scaled(k - Su2::invariants(uv[0], uv[1]), norm).norm();
    if (!(misfit <= tolerance)) throw_off_surface(scaled(k, norm), misfit, tolerance);
    const Complex2 result = size * uv;
    return {result[0].real(), result[0].imag(), result[1].real(), result[1].imag()};
}

}  // namespace

// The inverse map applied to a point off the surface: no frame of its own right, but near the nearest one when the
// point is near the surface, where frames far apart may have points close together.
std::vector<Quaternion> su2_starts(const Complex3& h) {
    const double size = size_of(h);
    if (!(size > 0) || !std::isfinite(size)) return {};
    std::vector<Quaternion> starts;
    const Complex3 k = scaled(h, size);
    const Complex2 rough = solve(k);
    for (const Complex2& uv : {rough, polished(rough, k)})
        if (uv.allFinite() && uv.squaredNorm() > 0)
            starts.push_back(Quaternion(uv[0].real(), uv[0].imag(), uv[1].real(), uv[1].imag()).normalized());
    return starts;
}

double Su2::squared_norm(const Complex3& h) {
    require_finite(h, "the point (h0, h1, h2)");
    const double size = size_of({h[0], h[1], 0});
    if (!(size > 0)) return 0;
    const Complex3 k = scaled({h[0], h[1], 0}, size);
    double sum = 0;
    for (const Complex& root : axis_roots(k[0], k[1])) sum += std::abs(root);
    return size * size * std::sqrt(2 * sum);
}

std::array<Quaternion, 48> Su2::inverse(const Complex3& h, double tolerance) {
    const Quaternion first = inverse_one(h, tolerance);
    std::array<Quaternion, 48> all;
    const auto& group = binary_octahedral_group();
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = first * group[i];
    return all;
}

Quaternion Su2::inverse_frame(const Complex3& h, double tolerance) { return inverse_one(h, tolerance).normalized(); }

}  // namespace octafield::frames
