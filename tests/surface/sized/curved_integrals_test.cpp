// The matrices of a triangle against quadrature of the basis functions they are integrals of.
#include "curved_integrals.hpp"

#include "sized_fixtures.hpp"

namespace octafield::surface {
namespace {

using detail::cross;

// Values and covariant gradients of the basis functions in the gauge of a connection i omega . dx with curl omega =
// holonomy / area: carried straight from vertex k, b_k exp(i int omega).
struct Basis {
    std::array<Complex, 3> corners;
    double curl;

    Complex carried(Complex from, Complex to) const { return std::polar(1.0, curl / 2 * cross(from, to)); }
    Complex value(int k, Complex z) const {
        const double area = cross(corners[1] - corners[0], corners[2] - corners[0]);
        return cross(corners[(k + 2) % 3] - corners[(k + 1) % 3], z - corners[(k + 1) % 3]) / area *
               carried(corners[k], z);
    }
    // Along the x and y axes, by central differences.
    std::array<Complex, 2> gradient(int k, Complex z) const {
        std::array<Complex, 2> result;
        for (int axis = 0; axis < 2; ++axis) {
            const Complex step = axis == 0 ? Complex(1e-4, 0) : Complex(0, 1e-4);
            const double omega = axis == 0 ? -curl / 2 * z.imag() : curl / 2 * z.real();
            result[axis] = (value(k, z + step) - value(k, z - step)) / 2e-4 - Complex(0, omega) * value(k, z);
        }
        return result;
    }
};

// Midpoints of n^2 equal triangles, extrapolated.
template <class F>
Complex integral(const std::array<Complex, 3>& p, const F& f) {
    const auto by = [&](int n) {
        const double area = cross(p[1] - p[0], p[2] - p[0]) / 2 / n / n;
        Complex sum = 0;
        const auto at = [&](double i, double j) { return p[0] + (p[1] - p[0]) * (i / n) + (p[2] - p[0]) * (j / n); };
        const auto add = [&](Complex a, Complex b, Complex c) {
            sum += area / 3 * (f((a + b) / 2.0) + f((b + c) / 2.0) + f((c + a) / 2.0));
        };
        for (int i = 0; i < n; ++i)
            for (int j = 0; i + j < n; ++j) {
                add(at(i, j), at(i + 1, j), at(i, j + 1));
                if (i + j + 2 <= n) add(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
            }
        return sum;
    };
    return (16.0 * by(16) - by(8)) / 15.0;
}

TEST(CurvedIntegrals, TriangleMatricesAreTheIntegralsOfTheirBasisFunctions) {
    const std::array<Complex, 3> corners{Complex(0.2, -0.1), Complex(1.3, 0.3), Complex(0.5, 0.9)};
    const double area = cross(corners[1] - corners[0], corners[2] - corners[0]) / 2;
    for (const double holonomy : {0.0, 0.1, -0.45, 0.55, -1.3, 2.9}) {
        const Basis basis{corners, holonomy / area};
        std::array<Complex, 3> steps;
        for (int k = 0; k < 3; ++k) steps[k] = basis.carried(corners[k], corners[(k + 1) % 3]);
        const detail::TriangleMatrices found = detail::triangle_matrices(corners, steps);
        EXPECT_NEAR(found.holonomy, holonomy, 1e-12);
        for (int j = 0; j < 3; ++j)
            for (int k = 0; k < 3; ++k) {
                const Complex mass =
                    integral(corners, [&](Complex z) { return std::conj(basis.value(j, z)) * basis.value(k, z); });
                const Complex stiffness = integral(corners, [&](Complex z) {
                    const auto a = basis.gradient(j, z), b = basis.gradient(k, z);
                    return std::conj(a[0]) * b[0] + std::conj(a[1]) * b[1];
                });
                EXPECT_LT(std::abs(found.mass[j][k] - mass), 1e-7) << holonomy << " " << j << k;
                EXPECT_LT(std::abs(found.stiffness[j][k] - stiffness), 1e-6) << holonomy << " " << j << k;
            }
    }
}

TEST(CurvedIntegrals, FactorsGoOverFromSeriesToClosedForm) {
    for (const double t : {0.49999999, -0.49999999}) {
        const double over = t > 0 ? 0.50000001 : -0.50000001;
        EXPECT_LT(std::abs(detail::mass_factor(t) - detail::mass_factor(over)), 1e-8);
        EXPECT_LT(std::abs(detail::stiffness_factor(t) - detail::stiffness_factor(over)), 1e-8);
        EXPECT_LT(std::abs(detail::product_factor(t) - detail::product_factor(over)), 1e-8);
    }
    const Complex i(0, 1);  // sympy
    const double t = 0.1;
    EXPECT_LT(std::abs(detail::mass_factor(t) - (1 / 12.0 + i * t / 60.0 - t * t / 360 - i * t * t * t / 2520.0)),
              1e-8);
    EXPECT_LT(std::abs(detail::stiffness_factor(t) - (-i * t / 24.0 + t * t / 120 + i * t * t * t / 504.0)), 1e-7);
    EXPECT_LT(std::abs(detail::product_factor(t) - (-0.25 - i * t / 24.0 + t * t / 45 + 5.0 * i * t * t * t / 1008.0)),
              1e-6);
}

}  // namespace
}  // namespace octafield::surface
