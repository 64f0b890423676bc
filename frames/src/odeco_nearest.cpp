// Nearest odeco tensor. With the best lengths for a frame, G^-1 b where b_k = <E(r_k), v>, what remains is to maximise
// b^T G^-1 b over rotations; G is the same for all frames (odeco_bands.hpp), so up to a factor the objective is
// sum_k b_k^2 - eta (sum_k b_k)^2, eta = beta / (alpha + 3 beta), with b_k the value of one quartic at r_k.
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "nearest_frame.hpp"
#include "octafield/frames/odeco.hpp"
#include "odeco_bands.hpp"

namespace octafield::frames {
namespace {

constexpr double eta = odeco_beta / (odeco_alpha + 3 * odeco_beta);

double objective(const Vector3& b) { return b.squaredNorm() - eta * b.sum() * b.sum(); }

Vector3 correlations(const Quartic& p, const Matrix3& axes) {
    Vector3 b;
    for (int k = 0; k < 3; ++k) b[k] = axes.col(k).dot(p.contract(axes.col(k)) * axes.col(k));
    return b;
}

Matrix3 cross_matrix(const Vector3& v) {
    Matrix3 m;
    m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
    return m;
}

// Value, gradient and Hessian under exp(w) from the left, which moves an axis r by w x r + w x (w x r) / 2.
struct Expansion {
    double value = 0;
    Vector3 gradient = Vector3::Zero();
    Matrix3 hessian = Matrix3::Zero();

    Expansion(const Quartic& p, const Matrix3& axes) {
        const Vector3 b = correlations(p, axes);
        const double shared = eta * b.sum();
        value = objective(b);
        Vector3 sum = Vector3::Zero();
        for (int k = 0; k < 3; ++k) {
            const Vector3 r = axes.col(k);
            const Matrix3 m = p.contract(r), x = cross_matrix(r);
            const Vector3 mr = m * r, slope = 4 * r.cross(mr);
            const Matrix3 curvature = 12 * x.transpose() * m * x + 2 * (mr * r.transpose() + r * mr.transpose()) -
                                      4 * b[k] * Matrix3::Identity();
            gradient += 2 * (b[k] - shared) * slope;
            hessian += 2 * (slope * slope.transpose() + (b[k] - shared) * curvature);
            sum += slope;
        }
        hessian -= 2 * eta * sum * sum.transpose();
    }
};

// Newton's step for a maximum, with the absolute values of the curvatures, at most max_angle long.
Vector3 newton_step(const Expansion& e) {
    constexpr double max_angle = 0.3;
    Eigen::SelfAdjointEigenSolver<Matrix3> eigen;
    eigen.computeDirect(e.hessian);
    const Vector3 curvature = eigen.eigenvalues().cwiseAbs();
    const double floor = 1e-6 * curvature.maxCoeff() + 1e-300;
    const Vector3 along = eigen.eigenvectors().transpose() * e.gradient;
    const Vector3 move = eigen.eigenvectors() * along.cwiseQuotient(curvature.cwiseMax(floor));
    const double angle = move.norm();
    return angle > max_angle ? Vector3(move * (max_angle / angle)) : move;
}

struct Maximum {
    Quaternion frame;
    double value;
};

Maximum ascend(const Quartic& p, Quaternion q) {
    constexpr int max_steps = 60;
    Expansion here(p, q.toRotationMatrix());
    for (int step = 0; step < max_steps; ++step) {
        const Vector3 move = newton_step(here);
        const double angle = move.norm();
        if (angle < 1e-15) break;
        bool ascended = false;
        Quaternion next;
        for (double length = 1; length > 1e-4 && !ascended; length /= 2) {
            next = (exp(length * move) * q).normalized();
            const double value = objective(correlations(p, next.toRotationMatrix()));
            // Newton's last steps gain less than rounding: taken while they are shorter than that can judge.
            ascended = value >= here.value || (angle < 1e-6 && value >= here.value - 1e-14 * std::abs(here.value));
        }
        if (!ascended) break;
        q = next;
        if (angle < 1e-9) break;
        here = Expansion(p, q.toRotationMatrix());
    }
    return {q, objective(correlations(p, q.toRotationMatrix()))};
}

// The best frames of the cover, no two in a likely common basin.
std::vector<Quaternion> promising_frames(const Quartic& p) {
    constexpr std::size_t most = 8, pool = 96;
    constexpr double apart = 0.25;
    static const std::vector<Matrix3> axes = [] {
        std::vector<Matrix3> matrices;
        for (const Quaternion& q : frame_cover()) matrices.push_back(q.toRotationMatrix());
        return matrices;
    }();
    std::vector<double> values(axes.size());
    for (std::size_t i = 0; i < axes.size(); ++i) values[i] = objective(correlations(p, axes[i]));
    std::vector<std::size_t> order(axes.size());
    std::iota(order.begin(), order.end(), 0);
    const std::size_t few = std::min(pool, order.size());
    std::partial_sort(order.begin(), order.begin() + few, order.end(), [&](std::size_t a, std::size_t b) {
        return values[a] != values[b] ? values[a] > values[b] : a < b;
    });
    std::vector<Quaternion> chosen;
    for (std::size_t k = 0; k < few && chosen.size() < most; ++k) {
        const Quaternion& candidate = frame_cover()[order[k]];
        if (std::none_of(chosen.begin(), chosen.end(),
                         [&](const Quaternion& q) { return distance(q, candidate) < apart; }))
            chosen.push_back(candidate);
    }
    return chosen;
}

}  // namespace

OdecoFrame Odeco::nearest(const Vector& v, const Quaternion* guess) {
    require_finite(v, "the vector to find the nearest odeco tensor of");
    if (guess) require_unit(*guess);
    const double size = v.stableNorm();
    if (!(size > 0)) return {guess ? *guess : Quaternion::Identity(), Vector3::Zero(), 0};
    const Quartic p = odeco_correlation(v / size);
    std::vector<Quaternion> starts = promising_frames(p);
    starts.insert(starts.begin(), extract(v).frame);
    if (guess) starts.insert(starts.begin(), guess->normalized());
    Maximum best = ascend(p, starts.front());
    for (std::size_t i = 1; i < starts.size(); ++i) {
        const Maximum other = ascend(p, starts[i]);
        // The margin keeps the first of equally good basins, so that rounding does not choose.
        if (other.value > best.value + 1e-12 * std::abs(best.value)) best = other;
    }
    return odeco_fit(best.frame, v);
}

OdecoFrame Odeco::nearest_local(const Vector& v, const Quaternion& start) {
    require_finite(v, "the vector to find the nearest odeco tensor of");
    require_unit(start);
    const double size = v.stableNorm();
    if (!(size > 0)) return {start, Vector3::Zero(), 0};
    return odeco_fit(ascend(odeco_correlation(v / size), start.normalized()).frame, v);
}

}  // namespace octafield::frames
