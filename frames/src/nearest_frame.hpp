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

    struct Point {
        Quaternion q;
        Vector e;
        double value, slope;  // slope: norm of the gradient
        Vector3 gradient;
    };

    Point at(const Quaternion& q, const Vector& v, double scale) const {
        Point p{q, embed(q), 0, 0, {}};
        p.value = value(p.e, v, scale);
        p.gradient = differential(q).transpose() * ((p.e - v) / scale);
        p.slope = p.gradient.norm();
        return p;
    }

    Point descend(const Quaternion& start, const Vector& v, double scale) const {
        constexpr int max_steps = 50;
        constexpr double max_angle = 0.15;  // the finest basins (su2) are about 20 degrees wide
        constexpr double polish = 1e-4;     // Newton gains about the square of this: too little to see in the values
        Eigen::SelfAdjointEigenSolver<Matrix3> eigen;
        Point here = at(start, v, scale);
        for (int step = 0; step < max_steps; ++step) {
            const auto j = differential(here.q);
            const Matrix3 curvature_matrix = j.transpose() * j / scale + hessian(here.q, (here.e - v) / scale);
            eigen.compute(curvature_matrix);
            const Vector3 curvature = eigen.eigenvalues().cwiseAbs();
            const double floor = 1e-6 * curvature.maxCoeff() + 1e-300;
            const Vector3 along = eigen.eigenvectors().transpose() * here.gradient;
            Vector3 move = -(eigen.eigenvectors() * along.cwiseQuotient(curvature.cwiseMax(floor)));
            const double angle = move.norm();
            if (angle < 1e-15) break;
            if (angle > max_angle) move *= max_angle / angle;
            const bool close = angle < polish && eigen.eigenvalues()[0] > 0;
            bool better = false;
            for (double length = 1; length > 1e-4 && !better; length /= 2) {
                const Point next = at((exp(length * move) * here.q).normalized(), v, scale);
                better = close ? next.slope < here.slope : next.value <= here.value;
                if (better) here = next;
                if (close) break;
            }
            if (!better) break;
        }
        return here;
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
        Point best = descend(begin.front(), v, scale);
        for (std::size_t i = 1; i < begin.size(); ++i) {
            const Point other = descend(begin[i], v, scale);
            // The margin keeps the first of equally good basins, so that rounding does not choose; in the same basin
            // the better converged.
            const double margin = 1e-12 * std::abs(best.value), gain = best.value - other.value;
            const bool same = std::abs(gain) <= margin && other.slope < best.slope && distance(other.q, best.q) < 1e-3;
            if (gain > margin || same) best = other;
        }
        return {best.q, (v - best.e).stableNorm()};
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
