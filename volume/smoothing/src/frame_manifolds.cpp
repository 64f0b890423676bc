#include "frame_manifolds.hpp"

namespace octafield::volume {
namespace {

using frames::Vector3;
using Jacobian = Eigen::Matrix<double, 4, 3, Eigen::RowMajor>;

// d exp(w) q / dw at w = 0: columns 1/2 (0, e_k) q. They are orthogonal with norm 1/2.
Jacobian left_jacobian(const double* x) {
    Jacobian j;
    // clang-format off
    j << -x[1], -x[2], -x[3],
          x[0],  x[3], -x[2],
         -x[3],  x[0],  x[1],
          x[2], -x[1],  x[0];
    // clang-format on
    return 0.5 * j;
}

Vector3 left_difference(const double* y, const double* x) { return frames::log(load_quaternion(y) * load_quaternion(x).conjugate()); }

}  // namespace

bool FrameManifold::Plus(const double* x, const double* delta, double* x_plus_delta) const {
    store_quaternion((frames::exp(Vector3(delta[0], delta[1], delta[2])) * load_quaternion(x)).normalized(), x_plus_delta);
    return true;
}

bool FrameManifold::PlusJacobian(const double* x, double* jacobian) const {
    Eigen::Map<Jacobian>(jacobian, 4, 3) = left_jacobian(x);
    return true;
}

bool FrameManifold::Minus(const double* y, const double* x, double* y_minus_x) const {
    Eigen::Map<Vector3>(y_minus_x, 3) = left_difference(y, x);
    return true;
}

bool FrameManifold::MinusJacobian(const double* x, double* jacobian) const {
    Eigen::Map<Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(jacobian, 3, 4) = 4 * left_jacobian(x).transpose();
    return true;
}

}  // namespace octafield::volume
