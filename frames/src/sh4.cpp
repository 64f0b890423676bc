#include "octafield/frames/sh4.hpp"

#include <cmath>
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

Sh4::Vector Sh4::embed(const Quaternion& q) {
    require_unit(q);
    const Matrix3 axes = q.toRotationMatrix();
    Vector15 sum = quartic_monomials(axes.col(0));
    for (int k = 1; k < 3; ++k) sum += quartic_monomials(axes.col(k));
    return axis_basis() * sum;
}

Sh4::Differential Sh4::differential(const Quaternion& q) {
    require_unit(q);
    const Matrix3 axes = q.toRotationMatrix();
    Eigen::Matrix<double, 15, 3> sum = Eigen::Matrix<double, 15, 3>::Zero();
    for (int k = 0; k < 3; ++k) {
        // Under exp(t w) the axis r moves by w x r, so column w of the derivative is grad . (w x r) = (r x grad) . w.
        const Eigen::Matrix<double, 15, 3> gradients = quartic_monomial_gradients(axes.col(k));
        for (int row = 0; row < 15; ++row)
            sum.row(row) += axes.col(k).cross(gradients.row(row).transpose()).transpose();
    }
    return axis_basis() * sum;
}

// With p = v . axis(x), M = p contracted twice with the axis r and X = [r]_x: under exp(w) the axis moves by
// w x r + 1/2 w x (w x r), so p(r) gains the second-order part 1/2 w.(12 X^T M X + 2 (Mr r^T + r Mr^T) - 4 r.Mr I) w.
Matrix3 Sh4::hessian(const Quaternion& q, const Vector& v) {
    require_unit(q);
    const Quartic p(axis_basis().transpose() * v);
    const Matrix3 axes = q.toRotationMatrix();
    Matrix3 hessian = Matrix3::Zero();
    for (int k = 0; k < 3; ++k) {
        const Vector3 r = axes.col(k);
        const Matrix3 m = p.contract(r);
        const Vector3 mr = m * r;
        Matrix3 x;
        x << 0, -r.z(), r.y(), r.z(), 0, -r.x(), -r.y(), r.x(), 0;
        hessian += 12 * x.transpose() * m * x + 2 * (mr * r.transpose() + r * mr.transpose()) -
                   4 * r.dot(mr) * Matrix3::Identity();
    }
    return hessian;
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
