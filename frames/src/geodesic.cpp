#include "octafield/frames/geodesic.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "octafield/error.hpp"
#include "octafield/frames/sh4.hpp"

namespace octafield::frames {
namespace {

Quaternion row(const Quaternions& frames, Eigen::Index i) { return from_wxyz(frames.row(i)); }

// `weights` scaled to sum 1, equal ones if empty.
Eigen::VectorXd checked_weights(const Quaternions& frames, const Eigen::VectorXd& weights) {
    const Eigen::Index n = frames.rows();
    if (n == 0) throw InvalidInput("the mean of no frames does not exist", "empty_input");
    for (Eigen::Index i = 0; i < n; ++i) require_unit(row(frames, i));
    if (weights.size() == 0) return Eigen::VectorXd::Constant(n, 1.0 / static_cast<double>(n));
    if (weights.size() != n)
        throw InvalidInput(std::to_string(weights.size()) + " weights for " + std::to_string(n) + " frames",
                           "wrong_shape");
    const double largest = weights.allFinite() ? weights.maxCoeff() : -1;
    if (!(largest > 0) || weights.minCoeff() < 0)
        throw InvalidInput("weights must be finite, not negative and not all zero", "bad_weights");
    const Eigen::VectorXd scaled = weights / largest;
    return scaled / scaled.sum();
}

FrameMean measured(const Quaternions& frames, const Eigen::VectorXd& weights, const Quaternion& centre) {
    FrameMean result{centre};
    for (Eigen::Index i = 0; i < frames.rows(); ++i) {
        const double d = distance(centre, row(frames, i));
        result.variance += weights[i] * d * d;
    }
    return result;
}

// Fixed-point steps m <- exp(mean log) m. Half the squared distance on a positively curved space has no curvature
// above 1, and the nearest representative is a minimum, so a full step never raises the variance.
FrameMean descend(const Quaternions& frames, const Eigen::VectorXd& weights, Quaternion centre) {
    constexpr int max_iterations = 200;
    constexpr double tolerance = 1e-13;  // radians
    bool converged = false;
    int iterations = 0;
    while (iterations < max_iterations && !converged) {
        ++iterations;
        Vector3 step = Vector3::Zero();
        for (Eigen::Index i = 0; i < frames.rows(); ++i) step += weights[i] * frame_log(centre, row(frames, i));
        converged = step.norm() < tolerance;
        centre = (exp(step) * centre).normalized();
    }
    FrameMean result = measured(frames, weights, centre);
    result.converged = converged;
    result.iterations = iterations;
    return result;
}

}  // namespace

Quaternion frame_exp(const Quaternion& q, const Vector3& w) {
    require_unit(q);
    if (!w.allFinite()) throw InvalidInput("the rotation vector is not finite", "non_finite");
    return (exp(w) * q).normalized();
}

Vector3 frame_log(const Quaternion& p, const Quaternion& q) {
    require_unit(p), require_unit(q);
    return log(q * (p * octahedral_group()[matching(p, q)]).conjugate());
}

Quaternion slerp(const Quaternion& p, const Quaternion& q, double t) { return frame_exp(p, t * frame_log(p, q)); }

FrameMean frame_mean(const Quaternions& frames, const Eigen::VectorXd& weights) {
    constexpr Eigen::Index most_starts = 8;
    const Eigen::VectorXd w = checked_weights(frames, weights);
    Sh4::Vector sum = Sh4::Vector::Zero();
    for (Eigen::Index i = 0; i < frames.rows(); ++i) sum += w[i] * Sh4::embed(row(frames, i));
    FrameMean best = descend(frames, w, Sh4::project(sum).frame);
    const Eigen::Index starts = std::min(most_starts, frames.rows());
    for (Eigen::Index k = 0; k < starts; ++k) {
        const FrameMean other = descend(frames, w, row(frames, k * frames.rows() / starts));
        // The margin keeps the first of equally good means, so that rounding does not choose.
        if (other.variance < best.variance - 1e-12 * (1e-12 + best.variance)) best = other;
    }
    return best;
}

}  // namespace octafield::frames
