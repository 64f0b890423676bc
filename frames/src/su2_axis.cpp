#include <cmath>
#include <cstdio>

#include "octafield/error.hpp"
#include "octafield/frames/su2.hpp"

namespace octafield::frames {
namespace {

Complex fourth_power(const Complex& z) { return z * z * z * z; }
Complex eighth_power(const Complex& z) { return fourth_power(z * z); }

void require_unit_axis(const Vector3& n) {
    const double norm = n.stableNorm();
    if (std::abs(norm - 1) < 1e-6) return;
    char text[96];
    std::snprintf(text, sizeof text, "the axis is not a unit vector: norm %.6g; normalise it first", norm);
    throw InvalidInput(text, "not_unit_vector");
}

}  // namespace

Su2Axis::Su2Axis(const Vector3& n) {
    require_unit_axis(n);
    const Vector3 unit = n.normalized();
    a_ = {-unit.z() / 2, unit.y() / 2};
    const double across = std::abs(a_);  // |u| |v|
    // The larger of |u|, |v| from n_x, the other from their product: 1 - |n_x| would lose digits near the x axis.
    const double larger = std::sqrt((1 + std::abs(unit.x())) / 2), smaller = across / larger;
    const Complex direction = across > 0 ? a_ / across : Complex(1, 0);
    u_ = unit.x() >= 0 ? larger : smaller;
    v_ = (unit.x() >= 0 ? smaller : larger) * direction;
    p_ = std::abs(eighth_power(u_));
    m_ = std::abs(eighth_power(v_));
}

Quaternion Su2Axis::turn_frame(double t) const {
    const Complex half_turn = std::polar(1.0, t / 2), u = u_ * half_turn, v = v_ * std::conj(half_turn);
    return {u.real(), u.imag(), v.real(), v.imag()};
}

Complex3 Su2Axis::turn(double t) const {
    const Complex half_turn = std::polar(1.0, t / 2);
    return Su2::invariants(u_ * half_turn, v_ * std::conj(half_turn));
}

Su2Axis::Ellipse Su2Axis::ellipse() const {
    const Complex a2 = a_ * a_, a4 = a2 * a2;
    return {14.0 * a4, -2.0 * a2 * a4, eighth_power(u_), eighth_power(v_), a2};
}

Complex Su2Axis::linear_residual(const Complex3& h) const {
    const Complex a2 = a_ * a_;
    return a2 * h[0] - h[1] - 16.0 * a2 * a2 * a2;
}

std::array<Complex, 2> Su2Axis::residual(const Complex3& h) const {
    const Complex a4 = fourth_power(a_), y = h[0] - 14.0 * a4;
    const Complex side = (p_ * p_ + m_ * m_) * y - 2.0 * a4 * a4 * std::conj(y);
    return {linear_residual(h), (p_ * p_ - m_ * m_) * h[2] - a_ * (h[0] - 48.0 * a4) * side};
}

}  // namespace octafield::frames
