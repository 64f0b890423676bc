#include "boundary_indices.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace octafield::surface::detail {
namespace {

using std::numbers::pi;
constexpr double least_clearance = pi / 2;

// A fan with an index, and how clear of the worst angle the field gets on the way to it from the one before.
struct Change {
    Index fan;
    double clearance;
};

// The boundary curve through fan `start`: its fans in order, and for each the clearance of the edge that leads to it.
std::vector<Change> boundary_curve(const std::vector<CornerLink>& links, const VertexFans& fans,
                                   const std::vector<Index>& head_of, const Eigen::VectorXd& deviations, Index start) {
    std::vector<Change> curve;
    Index fan = start;
    do {
        const Index edge = links[fans.corners[fans.fans[fan].first]].first;
        fan = head_of[edge];
        curve.push_back({fan, pi - std::abs(deviations[edge])});
    } while (fan != start);
    return curve;
}

void cancel_along(std::vector<Change> curve, std::vector<int>& indices) {
    const auto clearest = std::max_element(curve.begin(), curve.end(),
                                           [](const auto& a, const auto& b) { return a.clearance < b.clearance; });
    std::rotate(curve.begin(), clearest, curve.end());
    std::vector<Change> kept;
    double clearance = 0;
    for (const Change& change : curve) {
        clearance = std::max(clearance, change.clearance);
        int& index = indices[change.fan];
        while (index != 0 && !kept.empty() && clearance < least_clearance) {
            int& before = indices[kept.back().fan];
            if ((before > 0) == (index > 0)) break;
            const int common = (index > 0 ? 1 : -1) * std::min(std::abs(index), std::abs(before));
            index -= common;
            before += common;
            if (before != 0) continue;
            clearance = std::max(clearance, kept.back().clearance);
            kept.pop_back();
        }
        if (index == 0) continue;
        kept.push_back({change.fan, clearance});
        clearance = 0;
    }
}

}  // namespace

double boundary_deviation(const EdgeTopology& topology, int symmetry, Index edge, Complex value) {
    const bool runs_low_to_high = topology.edge_triangles(edge, 0) >= 0;
    return std::arg(!runs_low_to_high && symmetry % 2 == 1 ? -value : value);
}

void cancel_boundary_pairs(const std::vector<CornerLink>& links, const VertexFans& fans,
                           const Eigen::VectorXd& deviations, std::vector<int>& indices) {
    std::vector<Index> head_of(deviations.size(), -1);  // boundary edge -> the fan it leads to
    for (std::size_t f = 0; f < fans.fans.size(); ++f)
        if (!fans.fans[f].closed) head_of[links[fans.corners[fans.fans[f].last - 1]].second] = static_cast<Index>(f);
    std::vector<bool> done(fans.fans.size(), false);
    for (std::size_t f = 0; f < fans.fans.size(); ++f) {
        if (fans.fans[f].closed || done[f]) continue;
        std::vector<Change> curve = boundary_curve(links, fans, head_of, deviations, static_cast<Index>(f));
        for (const Change& change : curve) done[change.fan] = true;
        cancel_along(std::move(curve), indices);
    }
}

}  // namespace octafield::surface::detail
