#include "separatrix_tracer.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "octafield/error.hpp"

namespace octafield::surface::detail {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int most_shots = 8;
constexpr std::size_t most_passing = 8;                    // what a curve passes later is out of its reach
constexpr double before_target = 0.5, after_target = 0.5;  // tolerances along a shot
constexpr double clearance = 1e-7;                         // of an edge, from its ends
constexpr double beside = pi / 4;                          // off the boundary
constexpr double least_off = 1e-9, most_off = 1e-6;        // of edges, beside it

LayoutCurvePoint edge_point(const Charts& charts, Index t, int side, double fraction, double length) {
    const Index edge = charts.topology().triangle_edges(t, side);
    const bool forward = charts.mesh().triangles(t, side) == charts.topology().edges(edge, 0);
    return {-1, edge, forward ? fraction : 1 - fraction, length};
}

// The part of a curve between the vertex of a point and the opposite side of a triangle there.
struct Spoke {
    Index t;
    int corner;
    double fraction;  // of the opposite side
    Complex end, direction;
    double radius;
};

Spoke spoke_at(const LocalField& local, const LayoutPoint& point, double phi) {
    phi -= point.angle * std::floor(phi / point.angle);
    std::size_t i = point.corners.size() - 1;
    while (i > 0 && point.starts[i] > phi) --i;
    const Charts& charts = local.charts();
    const Index t = point.corners[i] / 3;
    const int k = point.corners[i] % 3, link = (k + 1) % 3;
    const Complex centre = charts.corners(t)[k], along = charts.side(t, link);
    const Complex direction = std::polar(1.0, std::arg(charts.side(t, k)) + std::max(0.0, phi - point.starts[i]));
    const Complex way = charts.corners(t)[link] - centre;
    const double fraction = std::clamp(-cross(direction, way) / cross(direction, along), clearance, 1 - clearance);
    const Complex end = charts.on_side(t, link, fraction);
    return {t, k, fraction, end, (end - centre) / std::abs(end - centre), std::abs(end - centre)};
}

}  // namespace

SeparatrixTracer::SeparatrixTracer(const LocalField& local, const LayoutPoints& points, double tolerance,
                                   double max_length)
    : local_(local), points_(points), near_(local, points, tolerance), tolerance_(tolerance), max_length_(max_length) {}

bool SeparatrixTracer::arrives(const Passing& target, const LocalField::Place& at, int entry, double length) const {
    const int k = (entry + 2) % 3;
    const LayoutPoint& p = point(target.slot);
    if (local_.charts().mesh().triangles(at.t, k) != p.vertex || length < target.length / 2) return false;
    const double off = angle_at(local_, p, at.t, k, at.z) - p.slots[target.slot.slot];
    return std::abs(p.boundary ? off : wrapped(off, p.angle)) < sector_part * p.angle / p.quads;
}

// A shot at a point looks for that one alone, which is seen from behind it and at no more than a tolerance.
bool SeparatrixTracer::comes_by(const Passing& target, const Walk& walk, double step) {
    return walk.length < target.length + after_target * walk.tolerance &&
           walk.length + step > target.length - before_target * walk.tolerance;
}

std::vector<Passing> by_slot(const std::vector<PassedPoints::Nearest>& found) {
    std::vector<Passing> result;
    for (const PassedPoints::Nearest& n : found) result.push_back(n.passing);
    std::sort(result.begin(), result.end(), [](const Passing& a, const Passing& b) { return a.slot < b.slot; });
    return result;
}

SeparatrixTracer::Walk SeparatrixTracer::begin(const Slot& start, double shear) const {
    const LayoutPoint& from = point(start);
    const Spoke spoke = spoke_at(local_, from, from.slots[start.slot] + shear / from.power);
    Walk walk;
    walk.shear = shear;
    walk.tolerance = tolerance(start);
    walk.trace.curve.first_vertex = from.vertex;
    walk.length = spoke_length(local_, from, spoke.t, spoke.end, spoke.radius);
    walk.side = {spoke.t, (spoke.corner + 1) % 3};
    walk.fraction = spoke.fraction;
    walk.heading = std::arg(spoke.direction);
    walk.trace.curve.points = {{from.vertex, -1, 0, 0},
                               edge_point(local_.charts(), spoke.t, walk.side.side, walk.fraction, walk.length)};
    walk.trace.curve.triangles = {spoke.t};
    walk.trace.boundary = local_.charts().across(walk.side).triangle < 0;
    return walk;
}

// A curve that comes to the boundary nearly along it does so by rounding alone: it goes on beside it, the later the
// farther off, to where the boundary turns or the field leads it away; back by the side it came in by where that one
// ends there, too.
LocalField::Exit SeparatrixTracer::kept_inside(const LocalField::Place& at, const LocalField::Exit& exit,
                                               double length) const {
    const Charts& charts = local_.charts();
    const LocalField::Place there{at.t, charts.on_side(at.t, exit.side, exit.fraction), at.turn};
    if (std::abs(wrapped(local_.heading(there) - std::arg(charts.side(at.t, exit.side)), pi)) > beside) return exit;
    LocalField::Exit along = local_.along_side(there, exit.side);
    const double off = least_off + std::min(length / max_length_, 1.0) * most_off;
    along.fraction = along.fraction < 0.5 ? off : 1 - off;
    along.length += exit.length;
    return along;
}

bool SeparatrixTracer::step(Walk& walk, bool looking, const std::optional<Passing>& target) const {
    const Charts& charts = local_.charts();
    Trace& trace = walk.trace;
    if (trace.boundary) return false;
    const int entry = charts.across(walk.side).side;
    const LocalField::Place at = local_.across(walk.side, walk.fraction, walk.heading, walk.shear);
    trace.curve.triangles.push_back(at.t);
    if (target && arrives(*target, at, entry, walk.length)) {
        const LayoutPoint& to = point(target->slot);
        const double radius = std::abs(at.z - charts.corners(at.t)[(entry + 2) % 3]);
        const double length = walk.length + spoke_length(local_, to, at.t, at.z, radius);
        trace.curve.points.push_back({to.vertex, -1, 0, length});
        trace.curve.last_vertex = to.vertex;
        trace.arrived = true;
        return true;
    }
    LocalField::Exit exit = local_.exit(at, entry);
    if (charts.across({at.t, exit.side}).triangle < 0) exit = kept_inside(at, exit, walk.length);
    if (looking && walk.found.size() < most_passing && (!target || comes_by(*target, walk, exit.length)))
        near_.look_round(at, {walk.shear, walk.tolerance, walk.length, walk.length + exit.length}, walk.found);
    walk.length += exit.length;
    walk.side = {at.t, exit.side};
    walk.fraction = exit.fraction;
    walk.heading = local_.heading({at.t, charts.on_side(at.t, exit.side, exit.fraction), at.turn});
    trace.curve.points.push_back(edge_point(charts, at.t, exit.side, exit.fraction, walk.length));
    trace.boundary = charts.across(walk.side).triangle < 0;
    return true;
}

Trace SeparatrixTracer::trace(const Slot& start, double shear, const std::optional<Passing>& target) const {
    return trace_to(start, shear, target,
                    target ? std::min(max_length_, target->length + 20 * tolerance(start)) : max_length_);
}

Trace SeparatrixTracer::beginning(const Slot& start, double reach) const {
    return trace_to(start, 0, {}, std::min(reach, max_length_));
}

Trace SeparatrixTracer::trace_to(const Slot& start, double shear, const std::optional<Passing>& target,
                                 double longest) const {
    Walk walk = begin(start, shear);
    while (!walk.trace.arrived && walk.length <= longest && step(walk, true, target)) {
    }
    walk.trace.passing = by_slot(walk.found);
    return std::move(walk.trace);
}

std::optional<LayoutCurve> SeparatrixTracer::joined(const Slot& start, Passing target) const {
    const double offset = target.offset;
    double shear = 0;
    for (int shot = 0; shot < most_shots; ++shot) {
        shear += std::atan2(target.offset, target.length);
        Trace trace = this->trace(start, shear, target);
        if (trace.arrived) {
            trace.curve.offset = offset;
            return trace.curve;
        }
        const auto seen = std::find_if(trace.passing.begin(), trace.passing.end(),
                                       [&](const Passing& p) { return p.slot == target.slot; });
        if (seen == trace.passing.end()) return {};
        target = *seen;
        if (std::abs(target.offset) < 1e-3 * tolerance(start) && shot > 1) return {};  // it goes to another sector
    }
    return {};
}

void tighten(LayoutCurve& curve, const Charts& charts) {
    auto& points = curve.points;
    auto& triangles = curve.triangles;
    const auto touches = [&](const LayoutCurvePoint& vertex, const LayoutCurvePoint& on_edge) {
        const auto ends = charts.topology().edges.row(on_edge.edge);
        return ends[0] == vertex.vertex || ends[1] == vertex.vertex;
    };
    const auto erase = [](auto& from, std::size_t first, std::size_t count) {
        from.erase(from.begin() + static_cast<std::ptrdiff_t>(first),
                   from.begin() + static_cast<std::ptrdiff_t>(first + count));
    };
    for (std::size_t i = 0; i + 1 < points.size();) {
        const bool last = i + 2 == points.size();
        if (i > 0 && !last && points[i].edge >= 0 && points[i].edge == points[i + 1].edge) {
            erase(points, i, 2);
            erase(triangles, i, 2);  // in triangles[i - 1] from both sides
            i -= 1;
        } else if (i == 0 && !last && points[0].vertex >= 0 && points[1].edge >= 0 && touches(points[0], points[1])) {
            erase(points, 1, 1);
            erase(triangles, 0, 1);
        } else if (i > 0 && last && points[i + 1].vertex >= 0 && points[i].edge >= 0 &&
                   touches(points[i + 1], points[i])) {
            erase(points, i, 1);
            erase(triangles, i, 1);
            i -= 1;
        } else {
            ++i;
        }
    }
}

}  // namespace octafield::surface::detail
