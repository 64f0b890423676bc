// Values of the real orthonormal harmonics of one degree, in any floating-point type.
#pragma once

#include <array>
#include <cmath>
#include <numbers>

namespace octafield::frames {

// Y_lm = sqrt(2) Q_lm(z) Re (x + iy)^m for m > 0, Im (x + iy)^|m| for m < 0, and Q_l0 for m = 0, where
// sin^m Q_lm is the normalised associated Legendre function without the Condon-Shortley phase. Taking the power of the
// sine into (x + iy)^m leaves polynomials, accurate at the poles.
template <int degree, class T>
class HarmonicsValues {
public:
    using Values = std::array<T, 2 * degree + 1>;  // order m = -degree..degree

    HarmonicsValues() {
        T sectoral = 1 / std::sqrt(4 * std::numbers::pi_v<T>);
        for (int m = 0; m <= degree; ++m) {
            if (m > 0) sectoral *= std::sqrt(T(2 * m + 1) / (2 * m));
            first_[m] = sectoral;
            for (int l = m + 1; l <= degree; ++l) {
                const T n = T(l) * l - T(m) * m, before = T(l - 1) * (l - 1) - T(m) * m;
                scale_[m][l] = std::sqrt((4 * T(l) * l - 1) / n);
                back_[m][l] = std::sqrt(before / (4 * T(l - 1) * (l - 1) - 1));
            }
        }
    }

    Values operator()(T x, T y, T z) const {
        Values values;
        values[degree] = zonal(0, z);
        T cosine = 1, sine = 0;  // of m times the azimuth, times the sine of the polar angle to the power m
        for (int m = 1; m <= degree; ++m) {
            const T next = x * cosine - y * sine;
            sine = x * sine + y * cosine;
            cosine = next;
            const T q = std::numbers::sqrt2_v<T> * zonal(m, z);
            values[degree + m] = q * cosine;
            values[degree - m] = q * sine;
        }
        return values;
    }

private:
    // Q_lm(z), l = degree, by the recurrence upward in l.
    T zonal(int m, T z) const {
        T before = 0, now = first_[m];
        for (int l = m + 1; l <= degree; ++l) {
            const T next = scale_[m][l] * (z * now - back_[m][l] * before);
            before = now, now = next;
        }
        return now;
    }

    std::array<T, degree + 1> first_{};
    std::array<std::array<T, degree + 1>, degree + 1> scale_{}, back_{};
};

}  // namespace octafield::frames
