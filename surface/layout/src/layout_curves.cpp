#include "octafield/surface/layout_curves.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "given_field.hpp"
#include "octafield/error.hpp"
#include "separatrix_tracer.hpp"
#include "short_number.hpp"
#include "split_between_points.hpp"

namespace octafield::surface {
namespace {

using detail::Slot;

constexpr double most_size_factor = 1.05;
// Of the root of the area in parameters.
constexpr double default_tolerance = 0.01, default_length = 40, first_reach = 1.5;

void require_parameters(const ImposedField& field) {
    std::vector<Index> vertices;
    for (const HolonomyCondition& c : field.conditions)
        if (!(c.size_factor <= most_size_factor)) vertices.push_back(c.vertex);
    if (!vertices.empty())
        throw InvalidInput("sizes disagree after one turn round the curves or generators at vertices " +
                               first_few(vertices) +
                               ": the field was rotated too far to have quad coordinates; move the points instead "
                               "(inadmissible: move)",
                           "rotated_field", vertices);
}

double area_in_parameters(const ImposedField& field) {
    const TriangleMesh& mesh = field.field.domain.mesh();
    const Eigen::VectorXd areas = triangle_areas(mesh);
    double sum = 0;
    for (Index t = 0; t < areas.size(); ++t)
        for (int k = 0; k < 3; ++k) {  // by the middles of the sides
            const Index a = mesh.triangles(t, k), b = mesh.triangles(t, (k + 1) % 3);
            sum += areas[t] / 3 * std::exp(-field.log_size[a] - field.log_size[b]);
        }
    return sum;
}

struct Candidate {
    Slot from;
    detail::Passing to;
    auto key() const { return std::tuple(to.length, from, to.slot); }
};

// Traces all separatrices and joins them, short ones first: what lies behind a point is not reached through it. So each
// is traced only as far as it has not been joined.
class Joiner {
public:
    Joiner(const detail::SeparatrixTracer& tracer, const detail::LayoutPoints& points, double max_length)
        : tracer_(tracer), points_(points), max_length_(max_length) {
        for (Index p = 0; p < static_cast<Index>(points.points.size()); ++p)
            for (int s = 0; s < static_cast<int>(points.points[p].slots.size()); ++s) open_.push_back({{p, s}, {}});
        count_ = static_cast<Index>(open_.size());
    }
    Index count() const { return count_; }

    // Those that are not joined yet, up to `reach`. False where all have been traced to their ends.
    bool trace(double reach, const Progress& progress) {
        if (traced_ >= max_length_) return false;
        bool longer = false;
        for (std::size_t i = 0; i < open_.size(); ++i) {
            report_or_throw(progress, "trace", 0.9 * i / static_cast<double>(open_.size()), NAN);
            auto& [slot, trace] = open_[i];
            if (trace.boundary) continue;
            trace = tracer_.beginning(slot, reach);
            longer = true;
        }
        traced_ = reach;
        return longer;
    }

    // Those that pass one another's points within `reach`.
    void join(double reach) {
        std::vector<Candidate> candidates;
        for (const auto& [slot, trace] : open_)
            for (const detail::Passing& passing : trace.passing)
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
            joined_.push_back(std::move(*curve));
        }
        std::erase_if(open_, [&](const auto& each) { return taken_.contains(each.first); });
    }

    // Returns where those start that did not end.
    std::vector<Index> curves(std::vector<LayoutCurve>& result) && {
        result = std::move(joined_);
        std::vector<Index> unended;
        for (auto& [slot, trace] : open_) {
            if (!trace.boundary) unended.push_back(points_.points[slot.point].vertex);
            result.push_back(std::move(trace.curve));
        }
        return unended;
    }

private:
    const detail::SeparatrixTracer& tracer_;
    const detail::LayoutPoints& points_;
    double max_length_, traced_ = 0;
    Index count_ = 0;
    std::vector<std::pair<Slot, detail::Trace>> open_;
    std::set<Slot> taken_;
    std::set<std::tuple<double, Slot, Slot>> tried_;
    std::vector<LayoutCurve> joined_;
};

void require_short(const std::vector<Index>& vertices, double max_length) {
    if (vertices.empty()) return;
    throw GeometryError(std::to_string(vertices.size()) + " separatrices, from vertices " + first_few(vertices) +
                            ", are longer than " + short_number(max_length) +
                            " in quad coordinates without an end: the singular points are not in positions that give "
                            "a coarse layout. Move them, or raise the end tolerance so that near misses are joined, "
                            "or the maximum length",
                        "long_separatrix", vertices);
}

}  // namespace

LayoutCurves layout_curves(const ImposedField& given, const LayoutCurveOptions& options, const Progress& progress) {
    if (!(options.end_tolerance >= 0) || !(options.max_length >= 0) || std::isinf(options.end_tolerance))
        throw InvalidInput("the end tolerance and maximum length of layout curves are numbers >= 0", "bad_option");
    detail::require_field(given);
    require_parameters(given);
    const ImposedField field = detail::split_between_points(given);
    LayoutCurves result;
    result.domain = field.field.domain;
    result.parameter_area = area_in_parameters(field);
    const double unit = std::sqrt(result.parameter_area);
    result.end_tolerance = options.end_tolerance > 0 ? options.end_tolerance : default_tolerance * unit;
    const double max_length = options.max_length > 0 ? options.max_length : default_length * unit;
    const detail::LocalField local(field);
    const detail::LayoutPoints points = detail::layout_points(field, local, options.cut_vertices);
    const detail::SeparatrixTracer tracer(local, points, result.end_tolerance, max_length);

    Joiner joiner(tracer, points, max_length);
    for (double reach = first_reach * unit; joiner.trace(reach, progress); reach *= 4) joiner.join(reach);
    result.traced = joiner.count();
    std::vector<Index> unended = std::move(joiner).curves(result.curves);
    require_short(unended, max_length);
    for (LayoutCurve& curve : result.curves) detail::tighten(curve, local.charts());
    return result;
}

}  // namespace octafield::surface
