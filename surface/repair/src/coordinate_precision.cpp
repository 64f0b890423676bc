#include <charconv>
#include <cmath>
#include <limits>

#include "octafield/surface/repair.hpp"

namespace octafield::surface {
namespace {

constexpr int kFewestDigits = 6, kMostDigits = 15;  // printf's default; what doubles keep of any decimal number

bool has_digits(double value, int digits) {
    char text[40];
    const auto written = std::to_chars(text, text + sizeof text, value, std::chars_format::scientific, digits - 1);
    double again = 0;
    std::from_chars(text, written.ptr, again);
    return again == value;
}

// Significant digits that hold all of them; 0: more than doubles keep.
int digits_of(const Points& points) {
    int digits = kFewestDigits;
    for (const double value : points.reshaped())
        while (!has_digits(value, digits))
            if (++digits > kMostDigits) return 0;
    return digits;
}

}  // namespace

double coordinate_precision(const Points& points) {
    const double most = points.rows() ? points.cwiseAbs().maxCoeff() : 0;
    if (!(most > 0) || !std::isfinite(most)) return 0;
    if ((points.cast<float>().cast<double>().array() == points.array()).all())
        return std::ldexp(std::numeric_limits<float>::epsilon(), std::ilogb(most));
    if (const int digits = digits_of(points)) return std::pow(10.0, std::floor(std::log10(most)) - digits + 1);
    return 8 * std::numeric_limits<double>::epsilon() * most;
}

}  // namespace octafield::surface
