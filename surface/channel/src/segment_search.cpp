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

bool SegmentSearch::nearer(const Vector2& place, double distance) const {
    const double cells = std::min(std::ceil(distance / cell_ - 0.5), most_reach + 1.);
    const int reach = std::max(0, static_cast<int>(cells));
    const auto near = [&](const Ends& ends) { return detail::distance(place, ends[0], ends[1]) < distance; };
    if (reach > most_reach) return std::any_of(ends_.begin(), ends_.end(), near);
    for (Index x = column(place, 0) - reach; x <= column(place, 0) + reach; ++x)
        for (Index y = column(place, 1) - reach; y <= column(place, 1) + reach; ++y) {
            const auto found = cells_.find(key(x, y));
            if (found == cells_.end()) continue;
            for (const Index s : found->second)
                if (near(ends_[s])) return true;
        }
    return false;
}

}  // namespace octafield::surface::detail
