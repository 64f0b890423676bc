#include "quartic_bands.hpp"

#include <cmath>
#include <numbers>

#include "harmonics_values.hpp"
#include "sphere_quadrature.hpp"

namespace octafield::frames {
namespace {

constexpr int quadrature_points = 5;  // exact for the degree 8 of a quartic times a harmonic of degree 4

template <int degree>
void add_band(Eigen::Matrix<long double, 15, 15>& q, const SphereNode& node, double eigenvalue) {
    static const HarmonicsValues<degree, long double> harmonics;
    const auto values = harmonics(node.x, node.y, node.z);
    const auto power = [](long double base, int exponent) {
        long double product = 1;
        for (int k = 0; k < exponent; ++k) product *= base;
        return product;
    };
    for (int c = 0; c < 15; ++c) {
        const auto& e = quartic_exponents[c];
        const long double monomial = power(node.x, e[0]) * power(node.y, e[1]) * power(node.z, e[2]);
        for (int m = 0; m < 2 * degree + 1; ++m)
            q(band_start[degree / 2] + m, c) += node.weight * values[m] * monomial / std::sqrt((long double)eigenvalue);
    }
}

}  // namespace

const std::array<double, 3>& kernel_eigenvalues() {
    constexpr double pi = std::numbers::pi;
    static constexpr std::array<double, 3> values = {4 * pi / 5, 16 * pi / 35, 32 * pi / 315};
    return values;
}

const Vector15& root_multiplicities() {
    static const Vector15 roots = [] {
        constexpr double factorial[5] = {1, 1, 2, 6, 24};
        Vector15 r;
        for (int c = 0; c < 15; ++c) {
            const auto& e = quartic_exponents[c];
            r[c] = std::sqrt(24 / (factorial[e[0]] * factorial[e[1]] * factorial[e[2]]));
        }
        return r;
    }();
    return roots;
}

// Row (l, m) is the unit tensor lambda_l^-1/2 int Y_lm(s) s^4 ds.
const Matrix15& quartic_bands() {
    static const Matrix15 bands = [] {
        Eigen::Matrix<long double, 15, 15> q = Eigen::Matrix<long double, 15, 15>::Zero();
        const auto& eigenvalues = kernel_eigenvalues();
        for (const SphereNode& node : sphere_quadrature(quadrature_points)) {
            add_band<0>(q, node, eigenvalues[0]);
            add_band<2>(q, node, eigenvalues[1]);
            add_band<4>(q, node, eigenvalues[2]);
        }
        return Matrix15(q.cast<double>() * root_multiplicities().asDiagonal());
    }();
    return bands;
}

}  // namespace octafield::frames
