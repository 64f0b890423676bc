#include "octafield/frames/harmonics.hpp"

#include <cmath>

#include "harmonics_rotation.hpp"
#include "harmonics_values.hpp"
#include "nearest_frame.hpp"

namespace octafield::frames {
namespace {

// Coupling of the orders m and m + 1 by the generators about x and y: half of the ladder operators'
// sqrt((l - m)(l + m + 1)), and sqrt(2) of that at m = 0, which has no sine partner.
double coupling(int degree, int m) {
    return m == 0 ? std::sqrt(degree * (degree + 1) / 2.0) : std::sqrt((degree - m) * (degree + m + 1.0)) / 2;
}

template <int degree>
std::array<double, degree> couplings() {
    std::array<double, degree> a;
    for (int m = 0; m < degree; ++m) a[m] = coupling(degree, m);
    return a;
}

// Squares of the coefficients of the cubic harmonics at the orders 0, 4, 8 (von der Lage and Bethe 1947; checked in the
// tests against the group), the sign apart.
template <int degree>
typename Harmonics<degree>::Vector octahedral_coefficients() {
    typename Harmonics<degree>::Vector a = Harmonics<degree>::Vector::Zero();
    const auto at = [&a](int m) -> double& { return a[degree + m]; };
    if constexpr (degree == 4) at(0) = std::sqrt(7.0 / 12), at(4) = std::sqrt(5.0 / 12);
    if constexpr (degree == 6) at(0) = std::sqrt(1.0 / 8), at(4) = -std::sqrt(7.0 / 8);
    if constexpr (degree == 8) at(0) = std::sqrt(33.0 / 64), at(4) = std::sqrt(7.0 / 48), at(8) = std::sqrt(65.0 / 192);
    if constexpr (degree == 9) at(-4) = std::sqrt(17.0 / 24), at(-8) = -std::sqrt(7.0 / 24);
    return a;
}

}  // namespace

template <int degree>
typename Harmonics<degree>::Vector Harmonics<degree>::evaluate(const Vector3& direction) {
    if (!(std::abs(direction.squaredNorm() - 1) < 2e-6))
        throw InvalidInput("not a unit direction: norm " + std::to_string(direction.norm()) + "; normalise it first",
                           "not_unit_direction");
    static const HarmonicsValues<degree, double> values;
    const auto y = values(direction.x(), direction.y(), direction.z());
    return Eigen::Map<const Vector>(y.data());
}

template <int degree>
typename Harmonics<degree>::Vector Harmonics<degree>::rotate(const Quaternion& g, const Vector& c) {
    require_unit(g);
    require_finite(c, "the vector of harmonic coefficients");
    return rotate_harmonics<degree>(EulerTurns(g), c);
}

template <int degree>
typename Harmonics<degree>::Matrix Harmonics<degree>::rotation(const Quaternion& g) {
    require_unit(g);
    const EulerTurns turns(g);
    Matrix d;
    for (int k = 0; k < size; ++k) d.col(k) = rotate_harmonics<degree>(turns, Vector::Unit(k));
    return d;
}

// From L+- Y_l^m = sqrt(l (l + 1) - m (m +- 1)) Y_l^{m +- 1} and G = -i L, in the real basis.
template <int degree>
typename Harmonics<degree>::Derivatives Harmonics<degree>::derivatives(const Vector& c) {
    static const auto coupled = couplings<degree>();
    Derivatives d = Derivatives::Zero();
    const auto at = [&c](int m) { return c[degree + m]; };
    const auto x = [&d](int m) -> double& { return d(degree + m, 0); };
    const auto y = [&d](int m) -> double& { return d(degree + m, 1); };
    for (int m = -degree; m <= degree; ++m) d(degree + m, 2) = -m * at(-m);
    for (int m = 0; m < degree; ++m) {
        const double a = coupled[m];
        x(m) += a * at(-m - 1), x(-m - 1) -= a * at(m);
        y(m) -= a * at(m + 1), y(m + 1) += a * at(m);
        if (m == 0) continue;
        x(-m) -= a * at(m + 1), x(m + 1) += a * at(-m);
        y(-m) -= a * at(-m - 1), y(-m - 1) += a * at(-m);
    }
    return d;
}

template <int degree>
const std::array<typename Harmonics<degree>::Matrix, 3>& Harmonics<degree>::generators() {
    static const auto matrices = [] {
        std::array<Matrix, 3> g;
        for (int m = 0; m < size; ++m) {
            const Derivatives d = derivatives(Vector::Unit(m));
            for (int k = 0; k < 3; ++k) g[k].col(m) = d.col(k);
        }
        return g;
    }();
    return matrices;
}

template <int degree>
const typename Harmonics<degree>::Vector& Harmonics<degree>::octahedral() {
    static const Vector a = octahedral_coefficients<degree>();
    return a;
}

template struct Harmonics<2>;
template struct Harmonics<4>;
template struct Harmonics<6>;
template struct Harmonics<8>;
template struct Harmonics<9>;

}  // namespace octafield::frames
