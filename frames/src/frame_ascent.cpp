#include "frame_ascent.hpp"

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <numbers>

namespace octafield::frames {
namespace {

struct Expansion {
    double value = 0;
    Vector3 gradient = Vector3::Zero();  // with respect to a rotation vector applied from the left
    Matrix3 hessian = Matrix3::Zero();
};

Matrix3 cross_matrix(const Vector3& v) {
    Matrix3 m;
    m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
    return m;
}

// Second-order expansion of F(exp(w) R) in w: r moves by w x r + 1/2 w x (w x r).
Expansion expand(const Quartic& p, const Matrix3& axes) {
    Expansion e;
    for (int k = 0; k < 3; ++k) {
        const Vector3 r = axes.col(k);
        const Matrix3 m = p.contract(r);
        const Vector3 half_gradient = m * r;  // grad p / 4
        const double value = r.dot(half_gradient);
        const Matrix3 x = cross_matrix(r);
        e.value += value;
        e.gradient += 4 * r.cross(half_gradient);
        e.hessian += 12 * x.transpose() * m * x + 2 * (half_gradient * r.transpose() + r * half_gradient.transpose()) -
                     4 * value * Matrix3::Identity();
    }
    return e;
}

double value_at(const Quartic& p, const Matrix3& axes) {
    double value = 0;
    for (int k = 0; k < 3; ++k) value += axes.col(k).dot(p.contract(axes.col(k)) * axes.col(k));
    return value;
}

struct Maximum {
    Quaternion frame;
    double value;
};

Maximum ascend(const Quartic& p, Quaternion q) {
    constexpr int max_steps = 60;
    constexpr double max_angle = 0.5;  // a basin is about 60 degrees wide; longer steps leave the expansion's range
    Expansion e = expand(p, q.toRotationMatrix());
    Eigen::SelfAdjointEigenSolver<Matrix3> eigen;
    for (int step = 0; step < max_steps; ++step) {
        eigen.computeDirect(e.hessian);
        const Vector3 curvature = eigen.eigenvalues().cwiseAbs();
        const double floor = 1e-6 * curvature.maxCoeff() + 1e-300;
        const Vector3 along = eigen.eigenvectors().transpose() * e.gradient;
        Vector3 move = eigen.eigenvectors() * along.cwiseQuotient(curvature.cwiseMax(floor));
        const double angle = move.norm();
        if (angle > max_angle) move *= max_angle / angle;
        if (move.norm() < 1e-15) break;
        Quaternion next;
        double next_value = e.value;
        bool ascended = false;
        for (double scale = 1; scale > 1e-4; scale /= 2) {
            next = (exp(scale * move) * q).normalized();
            next_value = value_at(p, next.toRotationMatrix());
            if (next_value >= e.value) {
                ascended = true;
                break;
            }
        }
        if (!ascended) break;  // at rounding level: no step along an ascent direction gains
        const bool settled = next_value - e.value <= 0 && angle < 1e-7;
        q = next;
        e = expand(p, q.toRotationMatrix());
        if (settled || angle < 1e-9) break;
    }
    return {q, e.value};
}

const std::array<Quaternion, 8>& seeds() {
    static const auto list = [] {
        std::array<Quaternion, 8> s;
        s[0] = Quaternion::Identity();
        const Vector3 axes[7] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {0, 1, 1}, {1, 0, 1}, {1, 1, 1}};
        for (int i = 0; i < 7; ++i) s[i + 1] = exp(std::numbers::pi / 4 * axes[i].normalized());
        return s;
    }();
    return list;
}

}  // namespace

Quaternion maximise_over_frames(const Quartic& p, const Quaternion* guess) {
    Maximum best = ascend(p, guess ? guess->normalized() : seeds()[0]);
    for (std::size_t i = guess ? 0 : 1; i < seeds().size(); ++i) {
        const Maximum other = ascend(p, seeds()[i]);
        // The margin keeps the first of equally good basins, so that rounding does not choose.
        if (other.value > best.value + 1e-12 * std::abs(best.value)) best = other;
    }
    return best.frame;
}

}  // namespace octafield::frames
