#include "octafield/surface/layout_curves.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "layout_input.hpp"
#include "separatrix_tracer.hpp"

namespace octafield::surface {
namespace {

using detail::Slot;

struct Candidate {
    Slot from;
    detail::Passing to;
};

}  // namespace

LayoutCurves layout_curves(const ImposedField& given, const LayoutCurveOptions& options, const Progress& progress) {
    const detail::LayoutInput input(given, options);
    const detail::LocalField& local = input.local;
    const detail::LayoutPoints& points = input.points;
    LayoutCurves result = input.no_curves();
    const detail::SeparatrixTracer tracer(local, points, result.end_tolerance, input.max_length);

    std::vector<std::pair<Slot, detail::Trace>> traces;
    std::vector<Candidate> candidates;
    for (Index p = 0; p < static_cast<Index>(points.points.size()); ++p) {
        report_or_throw(progress, "trace", 0.9 * p / static_cast<double>(points.points.size()), NAN);
        for (int s = 0; s < static_cast<int>(points.points[p].slots.size()); ++s) {
            traces.push_back({{p, s}, tracer.trace({p, s})});
            for (const auto& passing : traces.back().second.passing) candidates.push_back({{p, s}, passing});
        }
    }
    result.traced = static_cast<Index>(traces.size());
    // Short ones first: what lies behind a point is not reached through it.
    std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
        return std::tuple(a.to.length, a.from, a.to.slot) < std::tuple(b.to.length, b.from, b.to.slot);
    });
    std::set<Slot> taken;
    for (const Candidate& c : candidates) {
        if (c.from == c.to.slot || taken.contains(c.from) || taken.contains(c.to.slot)) continue;
        auto curve = tracer.joined(c.from, c.to);
        if (!curve) continue;
        taken.insert({c.from, c.to.slot});
        result.curves.push_back(std::move(*curve));
    }
    std::vector<Index> unended;
    for (auto& [slot, trace] : traces) {
        if (taken.contains(slot)) continue;
        if (!trace.boundary) unended.push_back(points.points[slot.point].vertex);
        result.curves.push_back(std::move(trace.curve));
    }
    detail::require_short(unended, input.max_length);
    for (LayoutCurve& curve : result.curves) detail::tighten(curve, local.charts());
    return result;
}

}  // namespace octafield::surface
