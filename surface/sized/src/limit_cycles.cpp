#include "octafield/surface/limit_cycles.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "line_widths.hpp"
#include "octafield/surface/surface_singularities.hpp"
#include "streamline_tools.hpp"

namespace octafield::surface {
namespace {

using detail::Charts;
using detail::Complex;
using std::numbers::pi;

constexpr double default_band = 8;  // mean edge lengths: f turns once in it
constexpr int most_returns = 8;     // traces from the end of a line that is still going

void check(const DirectionField& field, const LimitCycleOptions& options) {
    if (field.symmetry != 4)
        throw InvalidInput(
            "limit cycles are those of cross fields, of symmetry 4, not " + std::to_string(field.symmetry),
            "wrong_symmetry");
    const auto is_length = [](double length) { return length >= 0 && std::isfinite(length); };
    if (!is_length(options.max_length) || !is_length(options.band_width))
        throw InvalidInput("max_length and band_width must be lengths, or 0 for their defaults", "bad_option");
    if (options.seeds < 1) throw InvalidInput("seeds must be at least 1", "bad_option");
    if (!(options.tolerance > 0)) throw InvalidInput("tolerance must be above 0", "bad_option");
    if (options.most_removed < 0) throw InvalidInput("most_removed must be 0 or more", "bad_option");
}

bool is_closed(const Streamline& line) { return line.last_end == StreamlineEnd::closed; }

double distance_to(const Streamline& line, const Eigen::Vector3d& p) {
    double least = INFINITY;
    for (Index i = 0; i + 1 < line.points.rows(); ++i)
        least = std::min(least, detail::tracing::distance_to_segment(p, line.points.row(i), line.points.row(i + 1)));
    return least;
}

class Search {
public:
    Search(const DirectionField& field, const SurfaceSingularities& singularities, const LimitCycleOptions& options)
        : options_(options), tracer_(field, singularities, tracing(field, options)), slopes_(tracer_.field()) {}

    std::vector<LimitCycle> run(const Progress& progress) {
        const Charts& charts = tracer_.field();
        const Index triangles = charts.domain().triangle_count();
        const Index seeds = std::min<Index>(options_.seeds, triangles);
        for (Index i = 0; i < seeds; ++i) {
            report_or_throw(progress, "limit cycles", static_cast<double>(i) / seeds, NAN);
            const auto t = static_cast<Index>((static_cast<std::int64_t>(triangles) * (2 * i + 1)) / (2 * seeds));
            for (const Complex heading : {Complex(1, 0), Complex(0, 1), Complex(-1, 0), Complex(0, -1)}) {
                const Complex at = charts.centroid(t);
                follow({t, at, tracer_.field().direction(t, at, heading)});
            }
        }
        return std::move(found_);
    }

private:
    static StreamlineOptions tracing(const DirectionField& field, const LimitCycleOptions& options) {
        StreamlineOptions tracing;
        tracing.both_ways = false;
        tracing.max_length = options.max_length > 0 ? options.max_length : 20 * field.domain.size();
        return tracing;
    }

    // What the line from here winds towards, if anything.
    void follow(detail::Place place) {
        for (int turn = 0; turn < most_returns; ++turn) {
            const Streamline line = tracer_.trace(place);
            if (is_closed(line)) return keep(line);
            if (line.last_end != StreamlineEnd::length || is_known(line.points.row(line.points.rows() - 1))) return;
            const Index t = line.triangles.back(), last = static_cast<Index>(line.triangles.size());
            const Complex from = tracer_.field().lower(t, line.points.row(last - 1)),
                          to = tracer_.field().lower(t, line.points.row(last));
            const Complex at = (from + to) / 2.0;
            place = {t, at, tracer_.field().direction(t, at, (to - from) / std::abs(to - from))};
        }
    }

    bool is_known(const Eigen::Vector3d& p) const {
        const double near = tracer_.field().domain().mean_edge_length();
        return std::any_of(found_.begin(), found_.end(),
                           [&](const LimitCycle& cycle) { return distance_to(cycle.line, p) < near; });
    }

    void keep(const Streamline& line) {
        LimitCycle cycle;
        cycle.flux = detail::width_growth(slopes_, line).back();
        if (std::abs(cycle.flux) < options_.tolerance) return;
        if (is_known(line.points.row(0)) && is_known(line.points.row(line.points.rows() / 2))) return;
        cycle.line = line;
        detail::LineIndex index(tracer_.field());
        index.add(0, line);
        cycle.crosses_itself = !index.crossings(0, line).empty();
        found_.push_back(std::move(cycle));
    }

    const LimitCycleOptions& options_;
    detail::TwoWayTracer tracer_;
    detail::AngleSlopes slopes_;
    std::vector<LimitCycle> found_;
};

// Signed distances from a cycle, to its left.
class Band {
public:
    Band(const Charts& charts, const Streamline& line, double width) : charts_(charts), line_(line), half_(width / 2) {}

    // In (-1, 1) across the band; nothing outside.
    std::optional<double> part(const Eigen::Vector3d& p) const {
        double least = half_;
        Index nearest = -1;
        for (Index i = 0; i + 1 < line_.points.rows(); ++i) {
            const double distance =
                detail::tracing::distance_to_segment(p, line_.points.row(i), line_.points.row(i + 1));
            if (distance >= least) continue;
            least = distance;
            nearest = i;
        }
        if (nearest < 0) return {};
        const Eigen::Vector3d normal = charts_.domain().normals().row(line_.triangles[nearest]);
        const Eigen::Vector3d along = line_.points.row(nearest + 1) - line_.points.row(nearest),
                              from = p - line_.points.row(nearest).transpose();
        return (normal.cross(along).dot(from) >= 0 ? 1 : -1) * least / half_;
    }

private:
    const Charts& charts_;
    const Streamline& line_;
    double half_;
};

void require_clear(const DirectionField& field, const SurfaceSingularities& singularities, const LimitCycle& cycle,
                   const Band& band) {
    const auto refuse = [](const std::string& what) {
        throw InvalidInput("the field cannot be turned round the limit cycle: " + what, "band_blocked");
    };
    if (cycle.crosses_itself) refuse("it crosses itself");
    for (const SurfaceSingularity& point : singularities.points)
        if (!point.boundary && band.part(point.position)) refuse("a singular point is too near; use a narrower band");
    const SurfaceDomain& domain = field.domain;
    for (Index e = 0; e < domain.edge_count(); ++e)
        if (domain.is_feature()[e])
            for (const Index v : domain.topology().edges.row(e))
                if (band.part(domain.mesh().vertices.row(v)))
                    refuse("the boundary or a feature is too near; use a narrower band");
}

// From 0 to 1 in [-1, 1].
double smooth_step(double t) {
    const double u = (t + 1) / 2;
    return u * u * u * (u * (6 * u - 15) + 10);
}

}  // namespace

std::vector<LimitCycle> limit_cycles(const DirectionField& field, const SurfaceSingularities& singularities,
                                     const LimitCycleOptions& options, const Progress& progress) {
    check(field, options);
    return Search(field, singularities, options).run(progress);
}

DirectionField without_limit_cycle(const DirectionField& field, const SurfaceSingularities& singularities,
                                   const LimitCycle& cycle, const LimitCycleOptions& options) {
    check(field, options);
    if (cycle.line.points.rows() < 3 || cycle.line.triangles.size() + 1 != std::size_t(cycle.line.points.rows()))
        throw InvalidInput("a limit cycle must be a closed streamline with the triangle of each segment", "bad_cycle");
    for (const Index t : cycle.line.triangles)
        if (t < 0 || t >= field.domain.triangle_count())
            throw InvalidInput(
                "the limit cycle runs through triangle " + std::to_string(t) + ", which the field's mesh does not have",
                "wrong_mesh", {t});
    const Charts charts(field.domain);
    const double width = options.band_width > 0 ? options.band_width : default_band * field.domain.mean_edge_length();
    const Band band(charts, cycle.line, width);
    require_clear(field, singularities, cycle, band);
    DirectionField result = field;
    const Edges& edges = field.domain.topology().edges;
    const Points& points = field.domain.mesh().vertices;
    // Against the turn of the field across the cycle, or directions along it would remain.
    const double sense = cycle.flux > 0 ? -1 : 1;
    for (Index e = 0; e < field.domain.edge_count(); ++e)
        if (const auto part = band.part((points.row(edges(e, 0)) + points.row(edges(e, 1))) / 2))
            result.values[e] *= std::polar(1.0, sense * 2 * pi * smooth_step(*part));
    return result;
}

UnwoundField without_limit_cycles(const DirectionField& field, const LimitCycleOptions& options,
                                  const Progress& progress) {
    check(field, options);
    UnwoundField result{field, {}, {}};
    SurfaceSingularities points = surface_singularities(result.field);
    std::vector<LimitCycle> cycles = limit_cycles(result.field, points, options, progress);
    for (std::size_t next = 0; next < cycles.size() && int(result.removed.size()) < options.most_removed;) {
        std::optional<DirectionField> tried;
        try {
            tried = without_limit_cycle(result.field, points, cycles[next], options);
        } catch (const InvalidInput& error) {
            if (error.kind() != "band_blocked") throw;
        }
        std::vector<LimitCycle> after;
        SurfaceSingularities others;
        if (tried) {
            others = surface_singularities(*tried);
            after = limit_cycles(*tried, others, options, progress);
        }
        if (!tried || after.size() >= cycles.size()) {
            ++next;
            continue;
        }
        result.removed.push_back(cycles[next]);
        result.field = std::move(*tried);
        points = std::move(others);
        cycles = std::move(after);
        next = 0;
    }
    result.left = std::move(cycles);
    return result;
}

}  // namespace octafield::surface
