#include "least_cut.hpp"

#include <algorithm>
#include <limits>

namespace octafield::surface::detail {

void Network::add(Index a, Index b, std::int64_t capacity) {
    arcs_at_[a].push_back(static_cast<Index>(arcs_.size()));
    arcs_.push_back({b, capacity});
    arcs_at_[b].push_back(static_cast<Index>(arcs_.size()));
    arcs_.push_back({a, capacity});
}

bool Network::find_levels(Index source, Index sink) {
    level_.assign(arcs_at_.size(), -1);
    level_[source] = 0;
    std::vector<Index> front = {source};
    for (std::size_t i = 0; i < front.size(); ++i)
        for (const Index arc : arcs_at_[front[i]])
            if (const Index to = arcs_[arc].to; arcs_[arc].left > 0 && level_[to] < 0) {
                level_[to] = level_[front[i]] + 1;
                front.push_back(to);
            }
    return level_[sink] >= 0;
}

// Along one path of rising levels, without recursion.
std::int64_t Network::push(Index source, Index sink) {
    std::vector<Index> path;
    Index at = source;
    while (at != sink) {
        Index& place = next_[at];
        const auto& arcs = arcs_at_[at];
        while (place < static_cast<Index>(arcs.size()) &&
               !(arcs_[arcs[place]].left > 0 && level_[arcs_[arcs[place]].to] == level_[at] + 1))
            ++place;
        if (place < static_cast<Index>(arcs.size())) {
            path.push_back(arcs[place]);
            at = arcs_[arcs[place]].to;
        } else {
            if (path.empty()) return 0;
            at = arcs_[path.back() ^ 1].to;
            path.pop_back();
            ++next_[at];
        }
    }
    std::int64_t flow = std::numeric_limits<std::int64_t>::max();
    for (const Index arc : path) flow = std::min(flow, arcs_[arc].left);
    for (const Index arc : path) {
        arcs_[arc].left -= flow;
        arcs_[arc ^ 1].left += flow;
    }
    return flow;
}

std::vector<bool> Network::least_cut(Index source, Index sink) {
    while (find_levels(source, sink)) {
        next_.assign(arcs_at_.size(), 0);
        while (push(source, sink) > 0) {
        }
    }
    std::vector<bool> inside(arcs_at_.size());
    for (std::size_t v = 0; v < inside.size(); ++v) inside[v] = level_[v] >= 0;
    return inside;
}

}  // namespace octafield::surface::detail
