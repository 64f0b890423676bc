// What a plane quad costs: the one measure that templates, groups of quads and vertices are all chosen by.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace octafield::surface::detail {

using Vector2 = Eigen::Vector2d;

constexpr double inverted_cost = 10;     // of a quad that is not strictly convex, at least
constexpr double irregular_cost = 0.04;  // of a vertex inside, times (valence - 4)^2

inline double cross(const Vector2& a, const Vector2& b) { return a[0] * b[1] - a[1] * b[0]; }

// From one direction to the other counter-clockwise, in [0, 2 pi).
inline double turn(const Vector2& from, const Vector2& to) {
    const double angle = std::atan2(cross(from, to), from.dot(to));
    return angle < 0 ? angle + 2 * std::numbers::pi : angle;
}

// Of the worst angle's deviation from a right angle, over a right angle: the fourth power, so that a sum over quads
// weighs the worst most.
inline double angle_cost(double deviation) {
    return deviation < 1 ? deviation * deviation * deviation * deviation : inverted_cost + 5 * deviation;
}

// The deviation of an outline's corner that this many quads share, at best.
inline double shared_deviation(double angle, int quads) { return std::abs(angle / quads * 2 / std::numbers::pi - 1); }

// Worst deviation of the angles of a quad from a right angle, over a right angle; 1 or more: it is not convex.
inline double deviation(const std::array<Vector2, 4>& p) {
    double worst = 0;
    for (int k = 0; k < 4; ++k) {
        const Vector2 out = p[(k + 1) % 4] - p[k], in = p[(k + 3) % 4] - p[k];
        const double area = cross(out, in);
        double here = std::abs(turn(out, in) * 2 / std::numbers::pi - 1);
        if (!(area > 1e-12 * out.norm() * in.norm())) here = std::max(here, 1.);
        worst = std::max(worst, here);
    }
    return worst;
}

// Long quads cost a little as well: from angles alone they become thin rectangles.
inline double quad_cost(const std::array<Vector2, 4>& p) {
    double longest = 0, shortest = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 4; ++k) {
        const double length = (p[(k + 1) % 4] - p[k]).squaredNorm();
        longest = std::max(longest, length);
        shortest = std::min(shortest, length);
    }
    const double stretch = shortest > 0 ? std::min(std::sqrt(longest / shortest), 50.) - 1 : 50.;
    return angle_cost(deviation(p)) + 0.01 * stretch * stretch;
}

}  // namespace octafield::surface::detail
