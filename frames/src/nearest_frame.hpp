// Nearest frame for any representation: a scan of embedded frames that cover SO(3)/O, then Newton from the best ones.
#pragma once

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

#include "octafield/error.hpp"
#include "octafield/frames/octahedral_group.hpp"
#include "octafield/frames/representation.hpp"

namespace octafield::frames {

// Throws InvalidInput if v has a NaN or an infinity.
template <class Derived>
void require_finite(const Eigen::DenseBase<Derived>& v, const char* what) {
    if (!v.allFinite()) throw InvalidInput(std::string(what) + " is not finite", "non_finite");
}

// Frames in a fixed order, the identity first: no frame is farther than 7.5 degrees from all of them.
const std::vector<Quaternion>& frame_cover();

// 1/2 |embed(q) - v|^2 without its constant part, over max(1, |v|) so that it is finite for any v.
// Embedding: q -> Vector. Differential, Hessian as in Representation.
template <class Vector, class Embedding, class Differential, class Hessian>
struct NearestFrameProblem {
    Embedding embed;
    Differential differential;
    Hessian hessian;
    const std::vector<Vector>& table;  // embed() of frame_cover()

    double value(const Vector& e, const Vector& v, double scale) const {
        return (0.5 * e.squaredNorm() - v.dot(e)) / scale;
    }

    Quaternion descend(Quaternion q, const Vector& v, double scale) const {
        constexpr int max_steps = 50;
        constexpr double max_angle = 0.15;  // the finest basins (su2) are about 20 degrees wide
        Eigen::SelfAdjointEigenSolver<Matrix3> eigen;
        Vector e = embed(q);
        double current = value(e, v, scale);
        for (int step = 0; step < max_steps; ++step) {
            const auto j = differential(q);
            const Vector residual = (e - v) / scale;
            const Vector3 gradient = j.transpose() * residual;
            const Matrix3 curvature_matrix = j.transpose() * j / scale + hessian(q, residual);
            eigen.compute(curvature_matrix);
            const Vector3 curvature = eigen.eigenvalues().cwiseAbs();
            const double floor = 1e-6 * curvature.maxCoeff() + 1e-300;
            const Vector3 along = eigen.eigenvectors().transpose() * gradient;
            Vector3 move = -(eigen.eigenvectors() * along.cwiseQuotient(curvature.cwiseMax(floor)));
            const double angle = move.norm();
            if (angle < 1e-14) break;
            if (angle > max_angle) move *= max_angle / angle;
            bool lowered = false;
            for (double length = 1; length > 1e-4 && !lowered; length /= 2) {
                const Quaternion next = (exp(length * move) * q).normalized();
                const Vector next_e = embed(next);
                const double next_value = value(next_e, v, scale);
                // Newton's last steps gain less than rounding: taken while they are shorter than that can judge.
                if (next_value <= current || (angle < 1e-6 && next_value <= current + 1e-15)) {
                    lowered = true;
                    q = next, e = next_e, current = std::min(current, next_value);
                }
            }
            if (!lowered || angle < 1e-9) break;
        }
        return q;
    }

    // The best frames of the cover that are apart from one another.
    std::vector<Quaternion> starts(const Vector& scaled, double scale) const {
        constexpr std::size_t looked_at = 128, most = 10;
        constexpr double apart = 0.15;  // radians
        std::vector<double> scores(table.size());
        for (std::size_t i = 0; i < table.size(); ++i)
            scores[i] = 0.5 * table[i].squaredNorm() / scale - scaled.dot(table[i]);
        std::vector<std::size_t> order(table.size());
        std::iota(order.begin(), order.end(), 0);
        const auto end = order.begin() + std::min(looked_at, order.size());
        std::partial_sort(order.begin(), end, order.end(), [&](std::size_t a, std::size_t b) {
            return scores[a] != scores[b] ? scores[a] < scores[b] : a < b;
        });
        std::vector<Quaternion> chosen;
        for (auto k = order.begin(); k != end && chosen.size() < most; ++k) {
            const Quaternion& candidate = frame_cover()[*k];
            if (std::none_of(chosen.begin(), chosen.end(),
                             [&](const Quaternion& q) { return distance(q, candidate) < apart; }))
                chosen.push_back(candidate);
        }
        return chosen;
    }

    // `hints`: starts that the representation knows of.
    Projection solve(const Vector& v, const Quaternion* guess, const std::vector<Quaternion>& hints = {}) const {
        require_finite(v, "the vector to project");
        const double scale = std::max(1.0, v.stableNorm());
        const Vector scaled = v / scale;
        std::vector<Quaternion> begin = starts(scaled, scale);
        begin.insert(begin.begin(), hints.begin(), hints.end());
        if (guess) begin.insert(begin.begin(), guess->normalized());
        Quaternion best = begin.front();
        double best_value = 0;
        for (std::size_t i = 0; i < begin.size(); ++i) {
            const Quaternion q = descend(begin[i], v, scale);
            const Vector e = embed(q);
            const double reached = 0.5 * e.squaredNorm() / scale - scaled.dot(e);
            // The margin keeps the first of equally good basins, so that rounding does not choose.
            if (i == 0 || reached < best_value - 1e-12 * std::abs(best_value)) best = q, best_value = reached;
        }
        return {best, (v - embed(best)).stableNorm()};
    }
};

template <class Vector, class Embedding, class Differential, class Hessian>
NearestFrameProblem(Embedding, Differential, Hessian, const std::vector<Vector>&)
    -> NearestFrameProblem<Vector, Embedding, Differential, Hessian>;

// The embedded cover, computed once per representation.
template <class Embedding>
auto embedded_cover(const Embedding& embed) {
    std::vector<decltype(embed(Quaternion::Identity()))> table;
    table.reserve(frame_cover().size());
    for (const Quaternion& q : frame_cover()) table.push_back(embed(q));
    return table;
}

// R::project for a representation without a shortcut of its own.
template <class R>
Projection nearest_frame(const typename R::Vector& v, const Quaternion* guess,
                         const std::vector<Quaternion>& hints = {}) {
    static const auto table = embedded_cover([](const Quaternion& q) -> typename R::Vector { return R::embed(q); });
    const NearestFrameProblem problem{[](const Quaternion& q) -> typename R::Vector { return R::embed(q); },
                                      [](const Quaternion& q) { return R::differential(q); },
                                      [](const Quaternion& q, const typename R::Vector& r) { return R::hessian(q, r); },
                                      table};
    return problem.solve(v, guess, hints);
}

}  // namespace octafield::frames
