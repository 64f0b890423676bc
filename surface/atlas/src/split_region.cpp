#include "split_region.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <queue>

#include "least_cut.hpp"

namespace octafield::surface::detail {
namespace {

constexpr double largest_band = 10000.0;  // triangles among which the cut is looked for

std::vector<double> distances_from(const SurfaceDomain& domain, const ChartMesh& chart, Index seed) {
    std::vector<double> distance(chart.triangle_count(), std::numeric_limits<double>::infinity());
    const auto centre = [&](Index t) -> Eigen::RowVector3d {
        const auto corners = domain.mesh().triangles.row(chart.parents[t]);
        const Points& at = domain.mesh().vertices;
        return (at.row(corners[0]) + at.row(corners[1]) + at.row(corners[2])) / 3;
    };
    using Entry = std::pair<double, Index>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
    distance[seed] = 0;
    front.emplace(0, seed);
    while (!front.empty()) {
        const auto [way, t] = front.top();
        front.pop();
        if (way > distance[t]) continue;
        for (int k = 0; k < 3; ++k) {
            const Index to = chart.neighbours(t, k);
            if (to < 0) continue;
            const double further = way + (centre(to) - centre(t)).norm();
            if (!(further < distance[to])) continue;
            distance[to] = further;
            front.emplace(further, to);
        }
    }
    return distance;
}

Index farthest(const std::vector<double>& distance) {
    return static_cast<Index>(std::max_element(distance.begin(), distance.end()) - distance.begin());
}

}  // namespace

std::vector<bool> split_in_two(const SurfaceDomain& domain, const ChartMesh& chart, const Eigen::VectorXd& costs,
                               SplitBounds bounds) {
    const Index count = chart.triangle_count();
    const Index first = farthest(distances_from(domain, chart, 0));
    const std::vector<double> from_first = distances_from(domain, chart, first);
    Index last = farthest(from_first);
    if (last == first) last = first == 0 ? 1 : 0;
    const std::vector<double> from_last = distances_from(domain, chart, last);
    // Ascending, so that every head and every tail of the order is connected.
    std::vector<Index> order(count), rank(count);
    std::iota(order.begin(), order.end(), 0);
    const auto key = [&](Index t) { return from_first[t] - from_last[t]; };
    std::sort(order.begin(), order.end(),
              [&](Index a, Index b) { return std::pair(key(a), a) < std::pair(key(b), b); });
    for (Index i = 0; i < count; ++i) rank[order[i]] = i;

    const double narrower = std::min(1.0, largest_band / std::max<Index>(1, bounds.most - bounds.least));
    const double middle = (bounds.least + bounds.most) / 2.0, reach = narrower * (bounds.most - bounds.least) / 2;
    const auto low = std::clamp<Index>(static_cast<Index>(std::ceil(middle - reach)), 1, count - 1);
    const auto high = std::clamp<Index>(static_cast<Index>(middle + reach), low, count - 1);
    // Nodes: the head, what is between, the tail.
    const auto node = [&](Index t) { return rank[t] < low ? 0 : rank[t] >= high ? high - low + 1 : rank[t] - low + 1; };
    double mean = 0;
    for (Index i = low; i < count && i <= high; ++i)
        for (int k = 0; k < 3; ++k) mean += costs[domain.topology().triangle_edges(chart.parents[order[i]], k)];
    mean /= 3.0 * std::max<Index>(1, std::min(high, count - 1) - low + 1);
    Network network(high - low + 2);
    for (Index t = 0; t < count; ++t)
        for (int k = 0; k < 3; ++k) {
            const Index other = chart.neighbours(t, k);
            if (other < t || node(t) == node(other)) continue;
            const double cost = costs[domain.topology().triangle_edges(chart.parents[t], k)];
            network.add(node(t), node(other),
                        std::max<std::int64_t>(1, std::llround(std::min(1e9, 1000 * cost / mean))));
        }
    const std::vector<bool> inside = network.least_cut(0, high - low + 1);
    std::vector<bool> part(count);
    for (Index t = 0; t < count; ++t) part[t] = !inside[node(t)];
    return part;
}

}  // namespace octafield::surface::detail
