// Segments of the plane near to a point.
#pragma once

#include <unordered_map>
#include <vector>

#include "octafield/surface/fixed_boundary_quads.hpp"
#include "plane_quads.hpp"

namespace octafield::surface::detail {

class SegmentSearch {
public:
    // cell: near to the distances that will be asked for. Points without a segment count as segments of no length.
    SegmentSearch(const PlanePoints& points, const Edges& segments, double cell);

    using Ends = std::array<Vector2, 2>;

    // Whether a segment is nearer to it than that.
    bool nearer(const Vector2& place, double distance) const;
    // Whether one is, wholly or in part, in a convex quad, counter-clockwise.
    bool meets(const std::array<Vector2, 4>& quad) const;

private:
    double cell_ = 0;
    Vector2 origin_;
    std::vector<Ends> ends_;
    std::unordered_map<std::uint64_t, std::vector<Index>> cells_;

    Index column(const Vector2& place, int axis) const {
        return static_cast<Index>(std::floor((place[axis] - origin_[axis]) / cell_));
    }
    void add(const Ends& ends);
    // Whether the test holds for one of those that are nearer than that, and perhaps of others.
    template <class Test>
    bool any_near(const Vector2& place, double distance, const Test& test) const;
};

// Distance of a point from the segment between two others.
inline double distance(const Vector2& place, const Vector2& a, const Vector2& b) {
    const double length = (b - a).squaredNorm();
    const double t = length > 0 ? std::clamp((place - a).dot(b - a) / length, 0., 1.) : 0;
    return (place - a - t * (b - a)).norm();
}

}  // namespace octafield::surface::detail
