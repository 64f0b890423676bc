// Maps of the plane that keep the grid of whole numbers.
#pragma once

#include <Eigen/Core>

namespace octafield::surface::detail {

using Vector2 = Eigen::Vector2d;
using GridPoint = Eigen::Vector2i;

template <class Vector>
Vector turned(const Vector& p, int quarters) {
    switch (quarters & 3) {
        case 1:
            return Vector(-p[1], p[0]);
        case 2:
            return Vector(-p[0], -p[1]);
        case 3:
            return Vector(p[1], -p[0]);
        default:
            return p;
    }
}

// A place of the grid and a step of length 1 from there.
struct GridRay {
    GridPoint at = {0, 0}, way = {1, 0};
    GridPoint point(int steps) const { return at + steps * way; }
    bool operator==(const GridRay& other) const { return at == other.at && way == other.way; }
};

// p goes to p turned by quarters of a turn, and shifted.
struct QuarterTurn {
    int quarters = 0;
    GridPoint shift = {0, 0};

    GridPoint operator()(const GridPoint& p) const { return turned(p, quarters) + shift; }
    Vector2 operator()(const Vector2& p) const { return turned(p, quarters) + shift.cast<double>(); }
    GridRay operator()(const GridRay& ray) const { return {(*this)(ray.at), turned(ray.way, quarters)}; }
    bool operator==(const QuarterTurn& other) const { return quarters == other.quarters && shift == other.shift; }
    QuarterTurn inverse() const { return {(4 - quarters) & 3, -turned(shift, 4 - quarters)}; }
    // First the other one.
    QuarterTurn after(const QuarterTurn& first) const {
        return {(quarters + first.quarters) & 3, turned(first.shift, quarters) + shift};
    }
    // That takes one ray to the other.
    static QuarterTurn taking(const GridRay& from, const GridRay& to) {
        int quarters = 0;
        while (quarters < 3 && turned(from.way, quarters) != to.way) ++quarters;
        return {quarters, to.at - turned(from.at, quarters)};
    }
};

}  // namespace octafield::surface::detail
