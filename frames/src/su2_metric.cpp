#include "octafield/frames/su2_metric.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <string>

#include "nearest_frame.hpp"
#include "octafield/error.hpp"

namespace octafield::frames::su2_metric {
namespace {

using PseudoInverse = Eigen::Matrix<Complex, 2, 3>;

// J^+ = (J^H J)^-1 J^H: J has full rank everywhere, with condition below 27.
PseudoInverse jacobian_inverse(const Quaternion& q) {
    const Su2::Jacobian j = Su2::jacobian({q.w(), q.x()}, {q.y(), q.z()});
    const Eigen::Matrix<Complex, 2, 2> normal = j.adjoint() * j;
    return normal.inverse() * j.adjoint();
}

Complex3 difference(const Quaternion& p, const Quaternion& q) { return Su2::complex(Su2::embed(q) - Su2::embed(p)); }

double measured(const Quaternion& at, const Complex3& dh) { return 2 * (jacobian_inverse(at) * dh).norm(); }

// The frame of a point of the surface over SU(2), rather than over quaternions of another norm.
Quaternion frame_of(const Complex3& h) {
    const Quaternion q = Su2::inverse(h)[0];
    if (!(std::abs(q.squaredNorm() - 1) < 2e-6))
        throw InvalidInput("(h0, h1, h2) belongs to quaternions of norm " + std::to_string(q.norm()) +
                               ", not to a frame; project it first",
                           "not_unit_quaternion");
    return q.normalized();
}

// World rotation vector whose image is the part of the tangent vector along the tangent space.
Vector3 rotation_of(const Quaternion& q, const Complex3& tangent) {
    require_finite(tangent, "the tangent vector");
    const Su2::Differential d = Su2::differential(q);
    return (d.transpose() * d).ldlt().solve(d.transpose() * Su2::real(tangent));
}

}  // namespace

double naive(const Quaternion& p, const Quaternion& q) { return difference(p, q).norm(); }

Matrix3c pulled_back(const Quaternion& at) {
    require_unit(at);
    const PseudoInverse inverse = jacobian_inverse(at);
    return inverse.adjoint() * inverse;
}

double pulled_back_at_end(const Quaternion& p, const Quaternion& q) { return measured(p, difference(p, q)); }

double pulled_back_symmetric(const Quaternion& p, const Quaternion& q) {
    const Complex3 dh = difference(p, q);
    const double at_p = measured(p, dh), at_q = measured(q, dh);
    return std::sqrt((at_p * at_p + at_q * at_q) / 2);
}

double pulled_back_midpoint(const Quaternion& p, const Quaternion& q) {
    return measured(slerp(p, q, 0.5), difference(p, q));
}

double distance(const Complex3& h, const Complex3& k) { return frames::distance(frame_of(h), frame_of(k)); }

Complex3 log(const Complex3& h, const Complex3& k) {
    const Quaternion q = frame_of(h);
    return Su2::complex(Su2::differential(q) * frame_log(q, frame_of(k)));
}

Complex3 exp(const Complex3& h, const Complex3& tangent) {
    const Quaternion q = frame_of(h);
    return Su2::complex(Su2::embed(frame_exp(q, rotation_of(q, tangent))));
}

double length(const Complex3& h, const Complex3& tangent) { return rotation_of(frame_of(h), tangent).norm(); }

Complex3 mean(const std::vector<Complex3>& points, const Eigen::VectorXd& weights) {
    Quaternions rows(static_cast<Eigen::Index>(points.size()), 4);
    for (Eigen::Index i = 0; i < rows.rows(); ++i)
        rows.row(i) = to_wxyz(frame_of(points[static_cast<std::size_t>(i)])).transpose();
    return Su2::complex(Su2::embed(frame_mean(rows, weights).frame));
}

}  // namespace octafield::frames::su2_metric
