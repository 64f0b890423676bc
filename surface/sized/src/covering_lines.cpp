#include "covering_lines.hpp"

#include <algorithm>
#include <cmath>

#include "line_widths.hpp"

namespace octafield::surface::detail {
namespace {

constexpr double spread = 5;  // of the streamlines to be covered, in spacings

// The curves to be covered, and where lines cross them already.
class Cover {
public:
    Cover(const Charts& charts, std::vector<Streamline> curves, double spacing)
        : curves_(std::move(curves)), index_(charts), spacing_(spacing), taken_(curves_.size()) {
        for (std::size_t c = 0; c < curves_.size(); ++c) index_.add(static_cast<Index>(c), curves_[c]);
        for (const Streamline& curve : curves_) {
            arcs_.push_back({0});
            for (Index i = 0; i + 1 < curve.points.rows(); ++i)
                arcs_.back().push_back(arcs_.back().back() + (curve.points.row(i + 1) - curve.points.row(i)).norm());
        }
    }

    const std::vector<Streamline>& curves() const { return curves_; }

    void add(const Streamline& line) {
        for (const LineCrossing& crossing : index_.crossings(0, line)) {
            const auto& arcs = arcs_[crossing.other.line];
            const double from = arcs[crossing.other.segment], to = arcs[crossing.other.segment + 1];
            auto& taken = taken_[crossing.other.line];
            const double at = from + crossing.other.part * (to - from);
            taken.insert(std::upper_bound(taken.begin(), taken.end(), at), at);
        }
    }

    bool is_free(std::size_t curve, double at) const {
        const auto& taken = taken_[curve];
        const auto after = std::lower_bound(taken.begin(), taken.end(), at);
        if (after != taken.end() && *after - at < spacing_ / 2) return false;
        return after == taken.begin() || at - *(after - 1) >= spacing_ / 2;
    }

    // Places along a curve to look at: the middle of each tenth of a spacing.
    std::vector<double> places(std::size_t curve) const {
        const double length = arcs_[curve].back();
        const int count = std::max(1, static_cast<int>(std::ceil(length / (spacing_ / 10))));
        std::vector<double> places;
        for (int i = 0; i < count; ++i) places.push_back((i + 0.5) / count * length);
        return places;
    }

    // In the chart of the triangle there, heading across the curve.
    Place across(const Charts& charts, std::size_t curve, double at) const {
        const auto& arcs = arcs_[curve];
        const Index segment = static_cast<Index>(
            std::clamp<std::ptrdiff_t>(std::upper_bound(arcs.begin(), arcs.end(), at) - arcs.begin() - 1, 0,
                                       static_cast<std::ptrdiff_t>(arcs.size()) - 2));
        const Index t = curves_[curve].triangles[segment];
        const Complex from = charts.lower(t, curves_[curve].points.row(segment)),
                      to = charts.lower(t, curves_[curve].points.row(segment + 1));
        const double length = arcs[segment + 1] - arcs[segment];
        const double part = length > 0 ? std::clamp((at - arcs[segment]) / length, 0.0, 1.0) : 0;
        const Complex place = from + part * (to - from), along = to - from;
        // A little towards the middle: places on edges start inside.
        return {t, place + 1e-6 * (charts.centroid(t) - place), Complex(0, 1) * along / std::abs(along)};
    }

private:
    std::vector<Streamline> curves_;
    LineIndex index_;
    double spacing_;
    std::vector<std::vector<double>> arcs_, taken_;
};

std::vector<Streamline> to_cover(const DirectionField& field, const SurfaceSingularities& singularities,
                                 const StreamlineOptions& tracing, double spacing, const Progress& progress) {
    std::vector<Streamline> curves = separatrices(field, singularities, tracing, progress);
    EvenStreamlineOptions spread_out;
    spread_out.spacing = spread * spacing;
    spread_out.tracing = tracing;
    for (Streamline& line : even_streamlines(field, singularities, spread_out, progress))
        curves.push_back(std::move(line));
    std::erase_if(curves, [](const Streamline& line) { return line.triangles.empty() || !(line.length > 0); });
    return curves;
}

}  // namespace

CoveringLines covering_lines(const DirectionField& field, const SurfaceSingularities& singularities,
                             SizeFamilyOptions options, const Progress& progress) {
    if (options.spacing == 0) options.spacing = field.domain.size() / 40;
    if (options.singular_radius == 0) options.singular_radius = 2 * field.domain.mean_edge_length();
    StreamlineOptions tracing;
    tracing.max_length = options.max_length;
    tracing.stop_at_features = options.stop_at_features;
    const Charts charts(field.domain);
    Cover cover(charts, to_cover(field, singularities, tracing, options.spacing, progress), options.spacing);
    tracing.singular_radius = options.singular_radius;
    const TwoWayTracer tracer(field, singularities, tracing);
    CoveringLines result;
    for (std::size_t c = 0; c < cover.curves().size(); ++c) {
        report_or_throw(progress, "lines", static_cast<double>(c) / static_cast<double>(cover.curves().size()), NAN);
        for (const double at : cover.places(c)) {
            if (!cover.is_free(c, at)) continue;
            Place place = cover.across(tracer.field(), c, at);
            place.heading = tracer.field().direction(place.triangle, place.at, place.heading);
            Streamline line = tracer.trace(place);
            if (line.triangles.empty()) continue;
            cover.add(line);
            const bool too_near =
                line.first_end == StreamlineEnd::singularity || line.last_end == StreamlineEnd::singularity;
            if (too_near)
                ++result.left_out;
            else
                result.lines.push_back(std::move(line));
        }
    }
    return result;
}

}  // namespace octafield::surface::detail
