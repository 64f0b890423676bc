#include "octafield/frames/su2.hpp"

#include "nearest_frame.hpp"
#include "su2_starts.hpp"

namespace octafield::frames {
namespace {

using Complex2 = Eigen::Matrix<Complex, 2, 1>;
using Complex22 = Eigen::Matrix<Complex, 2, 2>;
using Motions = Eigen::Matrix<Complex, 2, 3>;

// A form in (u, v) with its derivatives.
struct Jet {
    Complex value;
    Complex2 gradient;
    Complex22 hessian;
};

Jet operator*(const Jet& f, const Jet& g) {
    const Complex22 mixed = f.gradient * g.gradient.transpose();
    return {f.value * g.value, f.value * g.gradient + g.value * f.gradient,
            f.value * g.hessian + g.value * f.hessian + mixed + mixed.transpose()};
}

// Powers 0..12 of z.
std::array<Complex, 13> powers(const Complex& z) {
    std::array<Complex, 13> p;
    p[0] = 1;
    for (int k = 1; k < 13; ++k) p[k] = p[k - 1] * z;
    return p;
}

// The tetrahedral forms u v (u^4 - v^4), u^8 + 14 u^4 v^4 + v^8, u^12 - 33 u^4 v^4 (u^4 + v^4) + v^12.
std::array<Jet, 3> tetrahedral_jets(const Complex& u, const Complex& v) {
    const auto p = powers(u), q = powers(v);
    std::array<Jet, 3> g;
    g[0].value = p[5] * q[1] - p[1] * q[5];
    g[0].gradient << 5.0 * p[4] * q[1] - q[5], p[5] - 5.0 * p[1] * q[4];
    g[0].hessian(0, 0) = 20.0 * p[3] * q[1];
    g[0].hessian(0, 1) = g[0].hessian(1, 0) = 5.0 * (p[4] - q[4]);
    g[0].hessian(1, 1) = -20.0 * p[1] * q[3];

    g[1].value = p[8] + 14.0 * p[4] * q[4] + q[8];
    g[1].gradient << 8.0 * p[7] + 56.0 * p[3] * q[4], 8.0 * q[7] + 56.0 * p[4] * q[3];
    g[1].hessian(0, 0) = 56.0 * p[6] + 168.0 * p[2] * q[4];
    g[1].hessian(0, 1) = g[1].hessian(1, 0) = 224.0 * p[3] * q[3];
    g[1].hessian(1, 1) = 56.0 * q[6] + 168.0 * p[4] * q[2];

    g[2].value = p[12] - 33.0 * p[4] * q[4] * (p[4] + q[4]) + q[12];
    g[2].gradient << 12.0 * p[11] - 264.0 * p[7] * q[4] - 132.0 * p[3] * q[8],
        12.0 * q[11] - 264.0 * p[4] * q[7] - 132.0 * p[8] * q[3];
    g[2].hessian(0, 0) = 132.0 * p[10] - 1848.0 * p[6] * q[4] - 396.0 * p[2] * q[8];
    g[2].hessian(0, 1) = g[2].hessian(1, 0) = -1056.0 * p[3] * q[3] * (p[4] + q[4]);
    g[2].hessian(1, 1) = 132.0 * q[10] - 1848.0 * p[4] * q[6] - 396.0 * p[8] * q[2];
    return g;
}

// Of h0, h1, h2.
std::array<Jet, 3> invariant_jets(const Complex& u, const Complex& v) {
    const auto g = tetrahedral_jets(u, v);
    return {g[1], g[0] * g[0], g[0] * g[2]};
}

// Column k: d/dt (u, v) of exp(t e_k) q at t = 0, that is e_k q / 2 with q = u + v j.
Motions motions(const Complex& u, const Complex& v) {
    const Complex half(0.5, 0), half_i(0, 0.5);
    Motions m;
    m << half_i * u, -half * std::conj(v), -half_i * std::conj(v),  //
        half_i * v, half * std::conj(u), half_i * std::conj(u);
    return m;
}

Complex first(const Quaternion& q) { return {q.w(), q.x()}; }
Complex second(const Quaternion& q) { return {q.y(), q.z()}; }

}  // namespace

Su2::Vector Su2::embed(const Quaternion& q) {
    require_unit(q);
    return real(invariants(first(q), second(q)));
}

Su2::Differential Su2::differential(const Quaternion& q) {
    require_unit(q);
    const Complex u = first(q), v = second(q);
    const Eigen::Matrix<Complex, 3, 3> d = jacobian(u, v) * motions(u, v);
    Differential result;
    for (int k = 0; k < 3; ++k) result.col(k) = real(d.col(k));
    return result;
}

// To second order exp(w) q = q + w q / 2 - |w|^2 q / 8, and the last term moves a form of degree d by -d/8 |w|^2 times
// itself (Euler).
Matrix3 Su2::hessian(const Quaternion& q, const Vector& v) {
    require_unit(q);
    const Complex x = first(q), y = second(q);
    const auto forms = invariant_jets(x, y);
    const auto degrees = invariant_degrees(BinaryGroup::octahedral);
    const Complex3 weights = complex(v).conjugate();
    const Motions m = motions(x, y);
    Matrix3 result = Matrix3::Zero();
    for (int i = 0; i < 3; ++i) {
        result += (weights[i] * (m.transpose() * forms[i].hessian * m)).real();
        result -= degrees[i] / 4.0 * (weights[i] * forms[i].value).real() * Matrix3::Identity();
    }
    return result;
}

Projection Su2::project(const Vector& v, const Quaternion* guess) {
    require_finite(v, "the vector to project");
    return nearest_frame<Su2>(v, guess, su2_starts(complex(v)));
}

Complex3 Su2::complex(const Vector& v) { return {Complex(v[0], v[1]), Complex(v[2], v[3]), Complex(v[4], v[5])}; }

Su2::Vector Su2::real(const Complex3& h) {
    Vector v;
    v << h[0].real(), h[0].imag(), h[1].real(), h[1].imag(), h[2].real(), h[2].imag();
    return v;
}

Complex3 Su2::invariants(const Complex& u, const Complex& v) {
    const Complex u2 = u * u, v2 = v * v, u4 = u2 * u2, v4 = v2 * v2, sum = u4 + v4, product = u4 * v4;
    const Complex g0 = u * v * (u4 - v4), g2 = sum * (sum * sum - 36.0 * product);
    return {sum * sum + 12.0 * product, g0 * g0, g0 * g2};
}

Su2::Jacobian Su2::jacobian(const Complex& u, const Complex& v) {
    const Complex u2 = u * u, v2 = v * v, u3 = u2 * u, v3 = v2 * v, u4 = u2 * u2, v4 = v2 * v2;
    const Complex sum = u4 + v4, g0 = u * v * (u4 - v4), g2 = sum * (sum * sum - 36.0 * u4 * v4);
    const Complex g0_u = v * (5.0 * u4 - v4), g0_v = u * (u4 - 5.0 * v4);
    const Complex g2_u = 12.0 * u3 * (u4 * u4 - 22.0 * u4 * v4 - 11.0 * v4 * v4);
    const Complex g2_v = 12.0 * v3 * (v4 * v4 - 22.0 * u4 * v4 - 11.0 * u4 * u4);
    Jacobian j;
    j << 8.0 * u3 * (u4 + 7.0 * v4), 8.0 * v3 * (v4 + 7.0 * u4),  //
        2.0 * g0 * g0_u, 2.0 * g0 * g0_v,                         //
        g0_u * g2 + g0 * g2_u, g0_v * g2 + g0 * g2_v;
    return j;
}

Su2::SecondDerivatives Su2::second_derivatives(const Complex& u, const Complex& v) {
    const auto forms = invariant_jets(u, v);
    return {forms[0].hessian, forms[1].hessian, forms[2].hessian};
}

Complex Su2::surface_residual(const Complex3& h) { return relation_residual(BinaryGroup::octahedral, h); }

}  // namespace octafield::frames
