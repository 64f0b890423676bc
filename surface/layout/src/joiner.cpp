#include "joiner.hpp"

#include <algorithm>
#include <cmath>

namespace octafield::surface::detail {
namespace {

struct Candidate {
    Slot from;
    Passing to;
    auto key() const { return std::tuple(to.length, from, to.slot); }
};

}  // namespace

Joiner::Joiner(const SeparatrixTracer& tracer, const LayoutPoints& points, double max_length,
               const std::vector<bool>& of_points)
    : tracer_(tracer), points_(points), max_length_(max_length) {
    for (Index p = 0; p < static_cast<Index>(points.points.size()); ++p) {
        if (!of_points.empty() && !of_points[p]) continue;
        for (int s = 0; s < static_cast<int>(points.points[p].slots.size()); ++s) open_.push_back({{p, s}, {}});
    }
    count_ = static_cast<Index>(open_.size());
}

bool Joiner::trace(double reach, const Progress& progress) {
    if (traced_ >= max_length_) return false;
    bool longer = false;
    for (std::size_t i = 0; i < open_.size(); ++i) {
        report_or_throw(progress, "trace", 0.9 * static_cast<double>(i) / static_cast<double>(open_.size()), NAN);
        auto& [slot, trace] = open_[i];
        if (trace.boundary) continue;
        trace = tracer_.beginning(slot, reach);
        longer = true;
    }
    traced_ = reach;
    return longer;
}

void Joiner::join(double reach) {
    std::vector<Candidate> candidates;
    for (const auto& [slot, trace] : open_)
        for (const Passing& passing : trace.passing)
            if (passing.length <= reach || trace.boundary || reach >= max_length_)
                candidates.push_back({slot, passing});
    std::sort(candidates.begin(), candidates.end(),
              [](const Candidate& a, const Candidate& b) { return a.key() < b.key(); });
    for (const Candidate& c : candidates) {
        if (c.from == c.to.slot || taken_.contains(c.from) || taken_.contains(c.to.slot)) continue;
        if (!tried_.insert(c.key()).second) continue;
        auto curve = tracer_.joined(c.from, c.to);
        if (!curve) continue;
        taken_.insert({c.from, c.to.slot});
        joined_length_ += curve->points.back().length;
        joined_.push_back(std::move(*curve));
    }
    std::erase_if(open_, [&](const auto& each) { return taken_.contains(each.first); });
}

std::vector<Index> Joiner::take_curves(std::vector<LayoutCurve>& result) {
    result = std::move(joined_);
    std::vector<Index> unended;
    for (auto& [slot, trace] : open_) {
        if (!trace.boundary) unended.push_back(points_.points[slot.point].vertex);
        result.push_back(std::move(trace.curve));
    }
    return unended;
}

}  // namespace octafield::surface::detail
