#include "octafield/frames/sh4.hpp"

#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "nearest_frame.hpp"
#include "octafield/frames/harmonics.hpp"
#include "octafield/frames/sh4_projection.hpp"
#include "quartic.hpp"
#include "sh4_basis.hpp"

namespace octafield::frames {
namespace {

using Basis = Eigen::Matrix<double, 9, 15>;

Basis make_basis() {
    enum { x4, x3y, x3z, x2y2, x2yz, x2z2, xy3, xy2z, xyz2, xz3, y4, y3z, y2z2, yz3, z4 };
    const double c = std::sqrt(16 * std::numbers::pi / 189);
    const double pi = std::numbers::pi;
    Basis b = Basis::Zero();
    // m = -4: 3/4 sqrt(35/pi) xy (x2 - y2)
    const double n4 = c * 0.75 * std::sqrt(35 / pi);
    b(0, x3y) = n4, b(0, xy3) = -n4;
    // m = -3: 3/4 sqrt(35/(2 pi)) yz (3 x2 - y2)
    const double n3 = c * 0.75 * std::sqrt(35 / (2 * pi));
    b(1, x2yz) = 3 * n3, b(1, y3z) = -n3;
    // m = -2: 3/4 sqrt(5/pi) xy (7 z2 - r2)
    const double n2 = c * 0.75 * std::sqrt(5 / pi);
    b(2, xyz2) = 6 * n2, b(2, x3y) = -n2, b(2, xy3) = -n2;
    // m = -1: 3/4 sqrt(5/(2 pi)) yz (7 z2 - 3 r2)
    const double n1 = c * 0.75 * std::sqrt(5 / (2 * pi));
    b(3, yz3) = 4 * n1, b(3, x2yz) = -3 * n1, b(3, y3z) = -3 * n1;
    // m = 0: 3/16 sqrt(1/pi) (35 z4 - 30 z2 r2 + 3 r4)
    const double n0 = c * 3.0 / 16 * std::sqrt(1 / pi);
    b(4, z4) = 8 * n0, b(4, x2z2) = -24 * n0, b(4, y2z2) = -24 * n0;
    b(4, x4) = 3 * n0, b(4, y4) = 3 * n0, b(4, x2y2) = 6 * n0;
    // m = 1: xz (7 z2 - 3 r2)
    b(5, xz3) = 4 * n1, b(5, x3z) = -3 * n1, b(5, xy2z) = -3 * n1;
    // m = 2: 3/8 sqrt(5/pi) (x2 - y2)(7 z2 - r2)
    b(6, x2z2) = 3 * n2, b(6, x4) = -n2 / 2, b(6, y2z2) = -3 * n2, b(6, y4) = n2 / 2;
    // m = 3: xz (x2 - 3 y2)
    b(7, x3z) = n3, b(7, xy2z) = -3 * n3;
    // m = 4: 3/16 sqrt(35/pi) (x4 - 6 x2 y2 + y4)
    b(8, x4) = n4 / 4, b(8, x2y2) = -6 * n4 / 4, b(8, y4) = n4 / 4;
    return b;
}

}  // namespace

const Basis& axis_basis() {
    static const Basis b = make_basis();
    return b;
}

Sh4::Vector Sh4::axis(const Vector3& direction) { return axis_basis() * quartic_monomials(direction); }

// The basis above, summed over the axes.
Sh4::Vector Sh4::embed(const Quaternion& q) {
    require_unit(q);
    static const std::array<double, 5> norm = [] {
        std::array<double, 5> n;
        const Basis& b = axis_basis();
        n = {b(4, 14) / 8, b(3, 13) / 4, b(6, 5) / 6, b(7, 2), b(8, 0)};
        return n;
    }();
    const Matrix3 axes = q.toRotationMatrix();
    Vector sum = Vector::Zero();
    for (int k = 0; k < 3; ++k) {
        const double x = axes(0, k), y = axes(1, k), z = axes(2, k);
        const double xx = x * x, yy = y * y, zz = z * z, rr = xx + yy + zz;
        const double seven = 7 * zz - rr, six = 7 * zz - 3 * rr;
        sum[0] += 4 * x * y * (xx - yy);
        sum[1] += y * z * (3 * xx - yy);
        sum[2] += 2 * x * y * seven;
        sum[3] += y * z * six;
        sum[4] += 35 * zz * zz - 30 * zz * rr + 3 * rr * rr;
        sum[5] += x * z * six;
        sum[6] += (xx - yy) * seven;
        sum[7] += x * z * (xx - 3 * yy);
        sum[8] += xx * xx - 6 * xx * yy + yy * yy;
    }
    for (int m = -4; m <= 4; ++m) sum[4 + m] *= norm[std::abs(m)];
    return sum;
}

Sh4::Differential Sh4::differential(const Quaternion& q) { return Harmonics<4>::derivatives(embed(q)); }

// exp(w) turns the vector a by I + G(w) + G(w)^2 / 2 + ..., and the generators G are skew.
Matrix3 Sh4::hessian(const Quaternion& q, const Vector& v) {
    const Matrix3 products = Harmonics<4>::derivatives(v).transpose().lazyProduct(differential(q));
    return -(products + products.transpose()) / 2;
}

Sh4::Vector Sh4::rotate(const Quaternion& g, const Vector& v) { return Harmonics<4>::rotate(g, v); }

Projection Sh4::project(const Vector& v, const Quaternion* guess) {
    Vector4 frame, start;
    if (guess) start = to_wxyz(*guess);
    double distance;
    sh4_project(v.data(), guess ? start.data() : nullptr, 1, frame.data(), &distance);
    return {from_wxyz(frame), distance};
}

}  // namespace octafield::frames
