#include "segment_search.hpp"

namespace octafield::surface::detail {

constexpr double most_cells = 1e5;  // along the longer side of the points' box
constexpr int most_reach = 50;      // cells to each side; for more all segments are looked at

SegmentSearch::SegmentSearch(const PlanePoints& points, const Edges& segments, double cell) {
    const Vector2 extent = points.colwise().maxCoeff() - points.colwise().minCoeff();
    origin_ = points.colwise().minCoeff();
    cell_ = std::max(cell, extent.maxCoeff() / most_cells);
    std::vector<char> used(points.rows(), false);
    for (Index s = 0; s < segments.rows(); ++s) {
        for (int k = 0; k < 2; ++k) used[segments(s, k)] = true;
        add({points.row(segments(s, 0)), points.row(segments(s, 1))});
    }
    for (Index i = 0; i < points.rows(); ++i)
        if (!used[i]) add({points.row(i), points.row(i)});
}

// To the cells along the segment and those beside them.
void SegmentSearch::add(const Ends& ends) {
    const Index number = static_cast<Index>(ends_.size());
    ends_.push_back(ends);
    const int steps = 1 + static_cast<int>((ends[1] - ends[0]).norm() / cell_);
    for (int i = 0; i <= steps; ++i) {
        const Vector2 at = ends[0] + (ends[1] - ends[0]) * i / steps;
        for (Index x = column(at, 0) - 1; x <= column(at, 0) + 1; ++x)
            for (Index y = column(at, 1) - 1; y <= column(at, 1) + 1; ++y) {
                auto& cell = cells_[key(x, y)];
                if (cell.empty() || cell.back() != number) cell.push_back(number);
            }
    }
}

template <class Test>
bool SegmentSearch::any_near(const Vector2& place, double distance, const Test& test) const {
    const double cells = std::min(std::ceil(distance / cell_ - 0.5), most_reach + 1.);
    const int reach = std::max(0, static_cast<int>(cells));
    if (reach > most_reach) return std::any_of(ends_.begin(), ends_.end(), test);
    for (Index x = column(place, 0) - reach; x <= column(place, 0) + reach; ++x)
        for (Index y = column(place, 1) - reach; y <= column(place, 1) + reach; ++y) {
            const auto found = cells_.find(key(x, y));
            if (found == cells_.end()) continue;
            for (const Index s : found->second)
                if (test(ends_[s])) return true;
        }
    return false;
}

bool SegmentSearch::nearer(const Vector2& place, double distance) const {
    return any_near(place, distance,
                    [&](const Ends& ends) { return detail::distance(place, ends[0], ends[1]) < distance; });
}

bool SegmentSearch::meets(const std::array<Vector2, 4>& quad) const {
    const Vector2 middle = (quad[0] + quad[1] + quad[2] + quad[3]) / 4;
    double radius = 0;
    for (const Vector2& corner : quad) radius = std::max(radius, (corner - middle).norm());
    return any_near(middle, radius, [&](const Ends& ends) {
        double from = 0, to = 1;  // the part of the segment that is on the inner side of all sides
        for (int k = 0; k < 4; ++k) {
            const Vector2 side = quad[(k + 1) % 4] - quad[k];
            const double first = cross(side, ends[0] - quad[k]), last = cross(side, ends[1] - quad[k]);
            if (first < 0 && last < 0) return false;
            if (first < 0) from = std::max(from, first / (first - last));
            if (last < 0) to = std::min(to, first / (first - last));
        }
        return from <= to;
    });
}

}  // namespace octafield::surface::detail
