// The Karcher mean of frames (see geodesic.hpp): a descent that is proven to reach it if the frames are close together,
// otherwise several, from a scan of SO(3)/O.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include "nearest_frame.hpp"
#include "octafield/frames/geodesic.hpp"
#include "octafield/frames/sh4.hpp"

namespace octafield::frames {
namespace {

struct WeightedFrames {
    std::vector<Quaternion> frames;
    std::vector<double> weights;  // positive, of sum 1

    std::size_t size() const { return frames.size(); }
};

// Those of positive weight.
WeightedFrames checked(const Quaternions& rows, const Eigen::VectorXd& weights) {
    const Eigen::Index n = rows.rows();
    if (n == 0) throw InvalidInput("the mean of no frames does not exist", "empty_input");
    if (weights.size() != 0 && weights.size() != n)
        throw InvalidInput(std::to_string(weights.size()) + " weights for " + std::to_string(n) + " frames",
                           "wrong_shape");
    const double largest = weights.size() == 0 ? 1 : weights.allFinite() ? weights.maxCoeff() : -1;
    if (!(largest > 0) || (weights.size() != 0 && weights.minCoeff() < 0))
        throw InvalidInput("weights must be finite, not negative and not all zero", "bad_weights");
    WeightedFrames list;
    list.frames.reserve(n), list.weights.reserve(n);
    double sum = 0;
    for (Eigen::Index i = 0; i < n; ++i) {
        const Quaternion q = from_wxyz(rows.row(i));
        require_unit(q);
        const double w = weights.size() == 0 ? 1 : weights[i] / largest;
        if (!(w > 0)) continue;
        list.frames.push_back(q), list.weights.push_back(w);
        sum += w;
    }
    for (double& w : list.weights) w /= sum;
    return list;
}

// `n` of the frames, with equal weights: where the running sum of the weights passes the middles of n equal parts.
WeightedFrames sample(const WeightedFrames& list, std::size_t n) {
    WeightedFrames few{{}, std::vector<double>(n, 1.0 / static_cast<double>(n))};
    double sum = 0;
    for (std::size_t i = 0; i < list.size(); ++i) {
        sum += list.weights[i];
        while (few.frames.size() < n && (static_cast<double>(few.frames.size()) + 0.5) / static_cast<double>(n) < sum)
            few.frames.push_back(list.frames[i]);
    }
    few.frames.resize(n, list.frames.back());  // rounding of the sum
    return few;
}

// The group element nearest to r, up to sign. Its class is that of the largest of |a|, (|a| + |b|) / sqrt 2 and
// (|a| + |b| + |c| + |d|) / 2 over the components in falling order: all 24 need not be tried.
Quaternion nearest_element(const Quaternion& r) {
    const std::array<double, 4> x = {r.w(), r.x(), r.y(), r.z()};
    std::array<double, 4> g{};
    int first = 0, second = -1;
    double sum = std::abs(x[0]);
    for (int k = 1; k < 4; ++k) {
        const double size = std::abs(x[k]);
        sum += size;
        if (size > std::abs(x[first]))
            second = first, first = k;
        else if (second < 0 || size > std::abs(x[second]))
            second = k;
    }
    const double one = std::abs(x[first]), two = (one + std::abs(x[second])) * (std::numbers::sqrt2 / 2);
    if (sum / 2 > std::max(one, two)) {
        for (int k = 0; k < 4; ++k) g[k] = std::copysign(0.5, x[k]);
    } else if (two > one) {
        g[first] = std::copysign(std::numbers::sqrt2 / 2, x[first]);
        g[second] = std::copysign(std::numbers::sqrt2 / 2, x[second]);
    } else {
        g[first] = std::copysign(1, x[first]);
    }
    return {g[0], g[1], g[2], g[3]};
}

// The variance at a frame and the mean of the logarithms there, in the axes of the frame.
struct Moments {
    double variance = 0;
    Vector3 step = Vector3::Zero();
};

Moments moments(const WeightedFrames& list, const Quaternion& centre) {
    constexpr std::size_t block = 1024;  // sums of sums: the rounding does not grow with the number of frames
    const Quaternion inverse = centre.conjugate();
    Moments total;
    for (std::size_t begin = 0; begin < list.size(); begin += block) {
        Moments part;
        for (std::size_t i = begin; i < std::min(begin + block, list.size()); ++i) {
            const Quaternion r = inverse * list.frames[i];
            const Vector3 w = log(r * nearest_element(r).conjugate());
            part.variance += list.weights[i] * w.squaredNorm();
            part.step += list.weights[i] * w;
        }
        total.variance += part.variance, total.step += part.step;
    }
    return total;
}

// Fixed-point steps m <- exp(mean log) m (Karcher 1977). Half the squared distance on a positively curved space has no
// curvature above 1, and the nearest representative is a minimum, so a full step never raises the variance.
FrameMean descend(const WeightedFrames& list, Quaternion centre, int max_iterations) {
    constexpr double tolerance = 1e-13;  // radians
    for (int i = 1;; ++i) {
        const Moments here = moments(list, centre);
        const bool converged = here.step.norm() < tolerance;
        if (converged || i == max_iterations) return {centre, here.variance, converged, i};
        centre = (centre * exp(here.step)).normalized();
    }
}

// Frames in a ball of radius pi/8, half the injectivity radius (the shortest closed geodesic is a quarter turn), have
// one mean, and it is the only stationary point in the ball (Afsari 2011, theorem 2.1).
bool only_mean(const WeightedFrames& list, const FrameMean& mean) {
    constexpr double radius = std::numbers::pi / 8 - 1e-9;
    return mean.converged && std::all_of(list.frames.begin(), list.frames.end(),
                                         [&](const Quaternion& q) { return distance(mean.frame, q) < radius; });
}

// Frames of the cover, moved by one step each: those with the least variance to be expected, apart from one another.
// While no representative changes, the variance is that of points in a nearly flat space: |step|^2 less after a step.
std::vector<Quaternion> promising_frames(const WeightedFrames& list, std::size_t most) {
    constexpr double apart = 0.02;  // radians; several steps that end at one point come from one cell
    const std::vector<Quaternion>& cover = frame_cover();
    std::vector<Quaternion> moved(cover.size());
    std::vector<double> expected(cover.size());
    for (std::size_t i = 0; i < cover.size(); ++i) {
        const Moments m = moments(list, cover[i]);
        moved[i] = (cover[i] * exp(m.step)).normalized();
        expected[i] = m.variance - m.step.squaredNorm();
    }
    std::vector<std::size_t> order(cover.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return expected[a] < expected[b]; });
    std::vector<Quaternion> chosen;
    for (const std::size_t k : order) {
        if (chosen.size() == most) break;
        if (std::none_of(chosen.begin(), chosen.end(),
                         [&](const Quaternion& q) { return distance(q, moved[k]) < apart; }))
            chosen.push_back(moved[k]);
    }
    return chosen;
}

FrameMean best_of(const WeightedFrames& list, FrameMean best, const std::vector<Quaternion>& starts,
                  int max_iterations) {
    for (const Quaternion& start : starts) {
        const FrameMean other = descend(list, start, max_iterations);
        // The margin keeps the first of equally good means, so that rounding does not choose.
        if (other.variance < best.variance - 1e-12 * (1e-12 + best.variance)) best = other;
    }
    return best;
}

}  // namespace

FrameMean frame_mean(const Quaternions& rows, const Eigen::VectorXd& weights) {
    constexpr std::size_t most_scanned = 1000, most_starts = 64;
    constexpr int max_iterations = 50, large_iterations = 15;
    const WeightedFrames list = checked(rows, weights);
    Sh4::Vector sum = Sh4::Vector::Zero();
    for (std::size_t i = 0; i < list.size(); ++i) sum += list.weights[i] * Sh4::embed(list.frames[i]);
    const Quaternion start = Sh4::project(sum).frame;
    if (list.size() <= most_scanned) {
        const FrameMean first = descend(list, start, max_iterations);
        if (only_mean(list, first)) return first;
        return best_of(list, first, promising_frames(list, most_starts), max_iterations);
    }
    const FrameMean first = descend(list, start, large_iterations);
    if (only_mean(list, first)) return first;
    const WeightedFrames few = sample(list, most_scanned);
    const FrameMean seed =
        best_of(few, descend(few, first.frame, max_iterations), promising_frames(few, most_starts), max_iterations);
    const bool better = moments(list, seed.frame).variance < first.variance;
    return better ? descend(list, seed.frame, large_iterations) : first;
}

}  // namespace octafield::frames
