// sh6: frames as spherical harmonics of degree 6 alone. O has one invariant of that degree, and only O leaves it
// unchanged: O is a maximal subgroup of SO(3). So turning it by a frame is an embedding, as it is in degree 4.
#pragma once

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string_view>
#include <utility>
#include <vector>

#include "octafield/error.hpp"
#include "octafield/frames/harmonics.hpp"
#include "octafield/frames/octahedral_group.hpp"
#include "octafield/frames/representation.hpp"

namespace example {

namespace frames = octafield::frames;

// --8<-- [start:declaration]
struct Sh6 {
    using Harmonics = frames::Harmonics<6>;
    static constexpr std::string_view name = "sh6";
    static constexpr int dimension = Harmonics::size;               // 13
    static constexpr frames::BandWeights band_weights = {0, 1, 0};  // of degrees 4, 6 and 9
    static constexpr double speed = 3.7416573867739413;             // sqrt(l (l + 1) / 3), l = 6
    using Vector = Harmonics::Vector;                               // order m = -6..6, unit norm
    using Differential = Harmonics::Derivatives;                    // (13, 3): by the world axes

    static Vector embed(const frames::Quaternion& q);
    static Differential differential(const frames::Quaternion& q);
    static frames::Matrix3 hessian(const frames::Quaternion& q, const Vector& v);
    static Vector rotate(const frames::Quaternion& g, const Vector& v);
    static frames::Projection project(const Vector& v, const frames::Quaternion* guess = nullptr);
};

static_assert(frames::Equivariant<Sh6>);
// --8<-- [end:declaration]

// --8<-- [start:embedding]
// The invariant turned by the frame. q o gives the same: o leaves the invariant alone before q turns it.
inline Sh6::Vector Sh6::embed(const frames::Quaternion& q) { return Harmonics::rotate(q, Harmonics::octahedral()); }

// exp(t e_k) acts on the embedded frame by the k-th generator.
inline Sh6::Differential Sh6::differential(const frames::Quaternion& q) { return Harmonics::derivatives(embed(q)); }

// exp(w) e = e + w_i G_i e + 1/2 w_i w_j G_i G_j e, and the generators are skew: v . G_i G_j e = -(G_i v) . (G_j e).
inline frames::Matrix3 Sh6::hessian(const frames::Quaternion& q, const Vector& v) {
    const frames::Matrix3 products = Harmonics::derivatives(v).transpose() * differential(q);
    return -(products + products.transpose()) / 2;
}

inline Sh6::Vector Sh6::rotate(const frames::Quaternion& g, const Vector& v) { return Harmonics::rotate(g, v); }
// --8<-- [end:embedding]

// --8<-- [start:projection]
namespace detail {

// Newton steps uphill on v . embed(q); the curvature is made negative where it is not.
inline frames::Quaternion climb(frames::Quaternion q, const Sh6::Vector& v) {
    constexpr int max_steps = 40;
    constexpr double max_angle = 0.1;  // radians; basins are wider
    for (int step = 0; step < max_steps; ++step) {
        const frames::Vector3 gradient = Sh6::differential(q).transpose() * v;
        const Eigen::SelfAdjointEigenSolver<frames::Matrix3> eigen(Sh6::hessian(q, v));
        const frames::Vector3 curvature = eigen.eigenvalues().cwiseAbs().cwiseMax(1e-6);
        frames::Vector3 move =
            eigen.eigenvectors() * (eigen.eigenvectors().transpose() * gradient).cwiseQuotient(curvature);
        const double angle = move.norm();
        if (angle > max_angle) move *= max_angle / angle;
        q = (frames::exp(move) * q).normalized();
        if (angle < 1e-14) break;
    }
    return q;
}

}  // namespace detail

// Embedded frames have norm 1, so the nearest to v has the largest product with it: climb from the best of many frames.
inline frames::Projection Sh6::project(const Vector& v, const frames::Quaternion* guess) {
    if (!v.allFinite()) throw octafield::InvalidInput("the vector to project is not finite", "non_finite");
    static const auto table = [] {
        const octafield::Quaternions rows = frames::random_rotations(2000, 1);
        std::vector<std::pair<frames::Quaternion, Vector>> list;
        for (Eigen::Index i = 0; i < rows.rows(); ++i) {
            const frames::Quaternion q = frames::from_wxyz(frames::Vector4(rows.row(i).transpose()));
            list.emplace_back(q, embed(q));
        }
        return list;
    }();
    Vector target = v.stableNormalized();
    if (!target.allFinite()) target.setZero();

    std::vector<double> scores;
    for (const auto& [q, e] : table) scores.push_back(target.dot(e));
    std::vector<std::size_t> order(table.size());
    std::iota(order.begin(), order.end(), 0);
    constexpr std::size_t starts = 24;
    std::partial_sort(order.begin(), order.begin() + starts, order.end(),
                      [&](std::size_t a, std::size_t b) { return scores[a] > scores[b]; });

    frames::Quaternion best = detail::climb(guess ? *guess : table[order[0]].first, target);
    for (std::size_t k = 0; k < starts; ++k) {
        const frames::Quaternion other = detail::climb(table[order[k]].first, target);
        if (target.dot(embed(other)) > target.dot(embed(best))) best = other;
    }
    return {best, (v - embed(best)).stableNorm()};
}
// --8<-- [end:projection]

}  // namespace example
