#include "sh4_bound.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

namespace octafield::frames::sh4 {
namespace {

const double fourth = std::sqrt(16.0 * 16 * 16 * 20 / 3) / 24;

double third(const LocalExpansion& e) {
    static const double t2 = std::sqrt(945.0) / 2 * std::sqrt(3.0 / 35);
    const double h23 = e.hessian(1, 2), h31 = e.hessian(2, 0), h12 = e.hessian(0, 1);
    return (16 * e.gradient.norm() + t2 * std::sqrt(h23 * h23 + h31 * h31 + h12 * h12)) / 6;
}

// 1/2 g.(mu - H)^-1 g, infinity unless mu - H is safely positive definite.
double resolvent(const LocalExpansion& e, double mu) {
    const Matrix3& h = e.hessian;
    const Vector3& g = e.gradient;
    const double b11 = mu - h(0, 0), b22 = mu - h(1, 1), b33 = mu - h(2, 2);
    const double b23 = -h(1, 2), b31 = -h(2, 0), b12 = -h(0, 1);
    const double c11 = b22 * b33 - b23 * b23, c12 = b23 * b31 - b12 * b33, c31 = b12 * b23 - b31 * b22;
    const double c22 = b11 * b33 - b31 * b31, c23 = b31 * b12 - b11 * b23, c33 = b11 * b22 - b12 * b12;
    const double det = b11 * c11 + b12 * c12 + b31 * c31;
    if (!(b33 > 0 && c11 > 0 && det > 1e-8)) return std::numeric_limits<double>::infinity();
    return 0.5 / det *
           (c11 * g[0] * g[0] + c22 * g[1] * g[1] + c33 * g[2] * g[2] +
            2 * (c12 * g[0] * g[1] + c23 * g[1] * g[2] + c31 * g[2] * g[0]));
}

// By the trigonometric solution of the characteristic cubic.
double largest_eigenvalue(const Matrix3& h) {
    const double mean = h.trace() / 3;
    const Matrix3 d = h - mean * Matrix3::Identity();
    const double spread = std::sqrt(d.squaredNorm() / 6);
    if (!(spread > 1e-12)) return mean + 2 * spread;
    const double cosine = d.determinant() / (2 * spread * spread * spread);
    return mean + 2 * spread * std::cos(std::acos(std::clamp(cosine, -1.0, 1.0)) / 3);
}

}  // namespace

double upper_bound(const LocalExpansion& e, double rho, double enough) {
    const double remainder = (third(e) + fourth * rho) * rho * rho * rho + rounding;
    enough -= e.value + remainder;
    double quadratic = resolvent(e, 0);
    if (!(quadratic <= enough)) {
        const double steepness = e.gradient.norm();
        // At most 1e-9 too low, which the margin covers: any mu above the largest eigenvalue is admissible, and
        // resolvent() refuses the others.
        const double least = std::max(0.0, largest_eigenvalue(e.hessian) + 1e-9);
        quadratic = std::min(quadratic, steepness * rho + 0.5 * least * rho * rho);
        double shift = 0.5 * steepness / rho;
        for (int k = 0; k < 8 && quadratic > enough && enough > 0; ++k, shift *= 0.25)
            quadratic = std::min(quadratic, resolvent(e, least + shift) + 0.5 * (least + shift) * rho * rho);
    }
    return e.value + quadratic + remainder;
}

// F <= f + |g| |u| - |u|^2 (lambda/2 - c_3 |u| - c_4 |u|^2) for H <= -lambda.
double radius_below(const LocalExpansion& e) {
    const Eigen::SelfAdjointEigenSolver<Matrix3> eigen(e.hessian, Eigen::EigenvaluesOnly);
    const double lambda = -eigen.eigenvalues().maxCoeff() - 1e-12;
    if (!(lambda > 0)) return 0;
    const double c3 = third(e);
    return lambda / (c3 + std::sqrt(c3 * c3 + 2 * lambda * fourth));
}

}  // namespace octafield::frames::sh4
