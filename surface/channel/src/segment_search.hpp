// Segments of the plane near to a point.
#pragma once

#include <unordered_map>
#include <vector>

#include "octafield/surface/fixed_boundary_quads.hpp"
#include "plane_quads.hpp"

namespace octafield::surface::detail {

class SegmentSearch {
public:
    // Points without a segment count as segments of no length.
    SegmentSearch(const PlanePoints& points, const Edges& segments, double cell);

    // Whether a segment is nearer to it than that.
    bool nearer(const Vector2& place, double distance) const;

private:
    using Ends = std::array<Vector2, 2>;
    double cell_;
    std::vector<Ends> ends_;
    std::unordered_map<std::uint64_t, std::vector<Index>> cells_;

    Index column(double x) const { return static_cast<Index>(std::floor(x / cell_)); }
    void add(const Ends& ends);
};

// Distance of a point from the segment between two others.
inline double distance(const Vector2& place, const Vector2& a, const Vector2& b) {
    const double length = (b - a).squaredNorm();
    const double t = length > 0 ? std::clamp((place - a).dot(b - a) / length, 0., 1.) : 0;
    return (place - a - t * (b - a)).norm();
}

}  // namespace octafield::surface::detail
