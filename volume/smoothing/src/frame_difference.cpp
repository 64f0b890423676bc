#include "frame_difference.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "octafield/frames/octahedral_group.hpp"

namespace octafield::volume {
namespace {

using frames::Complex;
using frames::Complex3;
using frames::Matrix3;
using frames::Quaternion;
using frames::Su2;
using frames::Vector3;
using frames::Vector4;
using Complex2 = Eigen::Matrix<Complex, 2, 1>;
using Complex22 = Eigen::Matrix<Complex, 2, 2>;
using Complex23 = Eigen::Matrix<Complex, 2, 3>;
using Matrix43 = Eigen::Matrix<double, 4, 3>;

Complex2 pair_of(const Vector4& q) { return {Complex(q[0], q[1]), Complex(q[2], q[3])}; }
Vector4 wxyz_of(const Complex2& x) { return {x[0].real(), x[0].imag(), x[1].real(), x[1].imag()}; }
Vector4 product(const Vector4& a, const Vector4& b) {
    return frames::to_wxyz(frames::from_wxyz(a) * frames::from_wxyz(b));
}
Vector4 conjugate(const Vector4& q) { return {q[0], -q[1], -q[2], -q[3]}; }

// d exp(w) q / dw at w = 0, columns e_k q / 2.
Matrix43 motions(const Quaternion& q) {
    Matrix43 m;
    for (int k = 0; k < 3; ++k) m.col(k) = product(Vector4::Unit(k + 1) / 2, frames::to_wxyz(q));
    return m;
}

Matrix3 cross_matrix(const Vector3& r) {
    Matrix3 m;
    m << 0, -r.z(), r.y(), r.z(), 0, -r.x(), -r.y(), r.x(), 0;
    return m;
}

// d log(exp(w) exp(r)) / dw at w = 0; its transpose is d log(exp(r) exp(w)) / dw.
Matrix3 inverse_left_jacobian(const Vector3& r) {
    const double angle = r.norm();
    // 1 / t^2 - (1 + cos t) / (2 t sin t), by its series where the difference would lose digits.
    const double c =
        angle < 1e-2 ? 1.0 / 12 + angle * angle / 720 : (1 - angle / 2 / std::tan(angle / 2)) / (angle * angle);
    const Matrix3 k = cross_matrix(r);
    return Matrix3::Identity() - k / 2 + c * k * k;
}

// 2 J^+(m) (h(q) - h(p)) m^-1 and its derivatives, for a quaternion m that moves with p and q by dm_p and dm_q.
Difference<4> measured_at(const Vector4& m, const Matrix43& dm_p, const Matrix43& dm_q, const Su2Vertex& p,
                          const Su2Vertex& q, bool derivatives) {
    const Complex2 x = pair_of(m);
    const Su2::Jacobian j = Su2::jacobian(x[0], x[1]);
    const Complex22 normal = (j.adjoint() * j).inverse();
    const Complex23 inverse = normal * j.adjoint();
    const Complex3 step = q.h - p.h;
    const Complex2 dx = inverse * step;
    const Complex3 rest = step - j * dx;
    const Vector4 back = conjugate(m);
    Difference<4> result;
    result.value = product(2 * wxyz_of(dx), back);
    if (!derivatives) return result;

    const Su2::SecondDerivatives second = Su2::second_derivatives(x[0], x[1]);
    // d(J^+) step = -J^+ dJ J^+ step + (J^H J)^-1 dJ^H (1 - J J^+) step.
    const auto column = [&](const Vector4& dm, const Complex3& moved) -> Vector4 {
        const Complex2 move = pair_of(dm);
        Su2::Jacobian dj;
        for (int i = 0; i < 3; ++i) dj.row(i) = (second[i] * move).transpose();
        const Complex2 change = inverse * (moved - dj * dx) + normal * (dj.adjoint() * rest);
        return product(2 * wxyz_of(change), back) + product(2 * wxyz_of(dx), conjugate(dm));
    };
    for (int k = 0; k < 3; ++k) {
        result.by_first.col(k) = column(dm_p.col(k), -p.dh.col(k));
        result.by_second.col(k) = column(dm_q.col(k), q.dh.col(k));
    }
    return result;
}

// The difference that is the rotation vector itself.
Difference<3> turned_by(const Vector3& r, bool derivatives) {
    Difference<3> result;
    result.value = r;
    if (derivatives) {
        result.by_second = inverse_left_jacobian(r);
        result.by_first = -result.by_second.transpose();
    }
    return result;
}

struct Midpoint {
    Vector4 m;
    Matrix43 by_first, by_second;
};

// `near`: the representative of p nearest to q.
Midpoint midpoint(const Quaternion& near, const Quaternion& q) {
    const Vector4 sum = frames::to_wxyz(near) + frames::to_wxyz(q);
    const double norm = sum.norm();
    const Vector4 m = sum / norm;
    const Eigen::Matrix4d across = (Eigen::Matrix4d::Identity() - m * m.transpose()) / norm;
    return {m, across * motions(near), across * motions(q)};
}

// Rises from 0 at limit / 2 to 1 at limit with continuous slope.
struct Blend {
    double share, slope;
    Blend(double angle, double limit) : share(angle < limit ? 0 : 1), slope(0) {
        if (angle <= limit / 2 || angle >= limit) return;
        const double t = 2 * angle / limit - 1;
        share = t * t * (3 - 2 * t);
        slope = 12 * t * (1 - t) / limit;
    }
};

}  // namespace

Difference<3> GeodesicScheme::difference(std::size_t, const Vertex& p, const Vertex& q, bool derivatives) const {
    return turned_by(frames::log(q * frames::closest_representative(p, q).conjugate()), derivatives);
}

Quaternion Su2GeodesicScheme::at(const Quaternion& q, bool) { return Su2::inverse_frame(Su2::complex(Su2::embed(q))); }

Difference<3> SurfaceScheme::difference(std::size_t pair, const Vertex& p, const Vertex& q, bool derivatives) const {
    if (const auto turn = frames::su2_surface::log(p, q)) return turned_by(*turn, derivatives);
    const auto frame = [](const Vertex& at) { return Su2::inverse_frame(Su2::complex(at.h)); };
    return GeodesicScheme{}.difference(pair, frame(p), frame(q), derivatives);
}

Su2Vertex su2_vertex(const Quaternion& q, bool derivatives) {
    Su2Vertex result{q, Su2::invariants({q.w(), q.x()}, {q.y(), q.z()}), {}};
    if (!derivatives) return result;
    const Su2::Jacobian j = Su2::jacobian({q.w(), q.x()}, {q.y(), q.z()});
    const Matrix43 turns = motions(q);
    for (int k = 0; k < 3; ++k) result.dh.col(k) = j * pair_of(turns.col(k));
    return result;
}

Difference<4> MidpointScheme::difference(std::size_t pair, const Vertex& p, const Vertex& q, bool derivatives) const {
    const Difference<3> turn = GeodesicScheme{}.difference(pair, p.q, q.q, derivatives);
    const double angle = turn.value.norm();
    const Blend blend(angle, limit);
    Difference<4> far;
    far.value << 0, turn.value;
    if (derivatives) {
        far.by_first << Eigen::RowVector3d::Zero(), turn.by_first;
        far.by_second << Eigen::RowVector3d::Zero(), turn.by_second;
    }
    if (blend.share == 1) return far;

    const Quaternion near = frames::closest_representative(p.q, q.q);
    const Midpoint half_way = midpoint(near, q.q);
    Difference<4> result = measured_at(half_way.m, half_way.by_first, half_way.by_second, p, q, derivatives);
    if (blend.share == 0) return result;
    const Vector4 gap = far.value - result.value;
    result.value += blend.share * gap;
    if (derivatives) {
        const Eigen::RowVector3d along = blend.slope / angle * turn.value.transpose();
        result.by_first += blend.share * (far.by_first - result.by_first) + gap * (along * turn.by_first);
        result.by_second += blend.share * (far.by_second - result.by_second) + gap * (along * turn.by_second);
    }
    return result;
}

Difference<8> SymmetricScheme::difference(std::size_t, const Vertex& p, const Vertex& q, bool derivatives) const {
    const Quaternion near = frames::closest_representative(p.q, q.q);
    const Difference<4> first = measured_at(frames::to_wxyz(near), motions(near), Matrix43::Zero(), p, q, derivatives);
    const Difference<4> second = measured_at(frames::to_wxyz(q.q), Matrix43::Zero(), motions(q.q), p, q, derivatives);
    Difference<8> result;
    result.value << first.value, second.value;
    result.value /= std::sqrt(2);
    if (derivatives) {
        result.by_first << first.by_first, second.by_first;
        result.by_second << first.by_second, second.by_second;
        result.by_first /= std::sqrt(2);
        result.by_second /= std::sqrt(2);
    }
    return result;
}

FrozenScheme::Metric FrozenScheme::metric(const Quaternion& p, const Quaternion& q) {
    const Vector4 m = midpoint(frames::closest_representative(p, q), q).m;
    const Complex2 x = pair_of(m);
    const Su2::Jacobian j = Su2::jacobian(x[0], x[1]);
    const Complex23 inverse = (j.adjoint() * j).inverse() * j.adjoint();
    Metric result;
    for (int i = 0; i < 6; ++i)
        result.col(i) = product(2 * wxyz_of(inverse * Su2::complex(Su2::Vector::Unit(i))), conjugate(m));
    return result;
}

Difference<4> FrozenScheme::difference(std::size_t pair, const Vertex& p, const Vertex& q, bool derivatives) const {
    const Metric& metric = metrics[pair];
    Difference<4> result;
    result.value = metric * Su2::real(q.h - p.h);
    if (!derivatives) return result;
    for (int k = 0; k < 3; ++k) {
        result.by_first.col(k) = -metric * Su2::real(p.dh.col(k));
        result.by_second.col(k) = metric * Su2::real(q.dh.col(k));
    }
    return result;
}

}  // namespace octafield::volume
