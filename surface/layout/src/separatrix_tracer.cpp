#include "separatrix_tracer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <unordered_set>

#include "octafield/error.hpp"

namespace octafield::surface::detail {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double sector_part = 0.35;  // of the angle between separatrices: off their own direction
constexpr int most_shots = 8;
constexpr std::size_t most_passing = 8;  // what a curve passes later is out of its reach
constexpr double zone = 3;               // tolerances from a point, along edges
constexpr double straight = pi / 4;      // off the way back, in parameters
constexpr double clearance = 1e-7;       // of an edge, from its ends

double wrapped(double angle, double period = 2 * pi) { return angle - period * std::round(angle / period); }

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

double spoke_length(const LocalField& local, const LayoutPoint& point, Index t, Complex end, double radius) {
    return radius * std::exp(-local.log_size(t, end)) / point.power;
}

// Angle at the point, from its first edge, of z in triangle t, whose corner k it is.
double angle_at(const LocalField& local, const LayoutPoint& point, Index t, int k, Complex z) {
    const Charts& charts = local.charts();
    const auto found = std::find(point.corners.begin(), point.corners.end(), 3 * t + k);
    return point.starts[found - point.corners.begin()] + std::arg((z - charts.corners(t)[k]) / charts.side(t, k));
}

}  // namespace

void SeparatrixTracer::look_at(const LocalField::Place& at, Complex offset, int k, double from,
                               std::vector<Nearest>& found) const {
    const Charts& charts = local_.charts();
    const Index place = points_.of_vertex[charts.mesh().triangles(at.t, k)];
    const LayoutPoint& p = points_.points[place];
    const Complex middle = charts.on_side(at.t, (k + 1) % 3, 0.5), way = middle - charts.corners(at.t)[k];
    const double radial = std::arg(way) - local_.angle(at.t, middle) - at.turn;
    const double length = spoke_length(local_, p, at.t, middle, std::abs(way));
    const Complex where = offset + local_.parameters(at, middle) - std::polar(length, radial);
    // From behind the point the way round it may be shorter, which ends at another sector.
    if (std::abs(where.imag()) > tolerance_ || where.real() < 3 * tolerance_ || where.real() < from) return;
    const double back = wrapped(pi - radial);
    const double phi = angle_at(local_, p, at.t, k, middle) + back / p.power;
    const double sector = p.angle / p.quads;
    for (int s = 0; s < static_cast<int>(p.slots.size()); ++s) {
        const double off = p.boundary ? phi - p.slots[s] : wrapped(phi - p.slots[s], p.angle);
        if (std::abs(off) > sector_part * sector || std::abs(back) > 0.6 * pi) continue;
        const Nearest seen{{{place, s}, where.real(), where.imag()}, std::abs(back), from};
        const auto known = std::find_if(found.begin(), found.end(), [&](const Nearest& n) {
            return n.passing.slot.point == place && std::abs(n.passing.length - where.real()) < 5 * tolerance_;
        });
        if (known == found.end()) {
            found.push_back(seen);
        } else if (where.real() - from > length &&
                   ((from > known->from && seen.behind < straight) || seen.behind < known->behind)) {
            // What is nearer is told better, but not from the triangles at the point, where the curve may be past it,
            // nor from beside it.
            *known = seen;
        }
    }
}

SeparatrixTracer::SeparatrixTracer(const LocalField& local, const LayoutPoints& points, double tolerance,
                                   double max_length)
    : local_(local), points_(points), tolerance_(tolerance), max_length_(max_length) {
    const Charts& charts = local.charts();
    const Triangles& triangles = charts.mesh().triangles;
    // Distances along edges, which are longer than straight ones, but not by half in triangles that are not thin.
    std::vector<double> distance(charts.mesh().vertices.rows(), std::numeric_limits<double>::infinity());
    for (const LayoutPoint& point : points.points) distance[point.vertex] = 0;
    near_points_.assign(triangles.rows(), false);
    for (bool changed = true; changed;) {
        changed = false;
        for (Index t = 0; t < triangles.rows(); ++t)
            for (int k = 0; k < 3; ++k) {
                const Index a = triangles(t, k), b = triangles(t, (k + 1) % 3);
                const double length =
                    std::abs(charts.side(t, k)) * std::exp(-local.log_size(t, charts.on_side(t, k, 0.5)));
                const double least = std::min(distance[a], distance[b]);
                if (least > zone * tolerance) continue;
                near_points_[t] = true;
                if (std::max(distance[a], distance[b]) <= least + length) continue;
                (distance[a] > distance[b] ? distance[a] : distance[b]) = least + length;
                changed = true;
            }
    }
}

// Unfolds the triangles within the tolerance of the curve's part in a triangle, but not round points.
void SeparatrixTracer::look_round(const LocalField::Place& start, double from, double to,
                                  std::vector<Nearest>& found) const {
    struct Unfolded {
        LocalField::Place at;
        Complex offset;  // parameters of at.z
    };
    if (!near_points_[start.t]) return;
    const Charts& charts = local_.charts();
    std::vector<Unfolded> front = {{start, from}};
    std::unordered_set<Index> seen = {start.t};
    for (std::size_t i = 0; i < front.size(); ++i) {
        const Unfolded at = front[i];
        const auto is_point = [&](int k) { return points_.of_vertex[charts.mesh().triangles(at.at.t, k)] >= 0; };
        for (int k = 0; k < 3; ++k)
            if (is_point(k)) look_at(at.at, at.offset, k, from, found);
        for (int k = 0; k < 3; ++k) {
            const Charts::Side over = charts.across({at.at.t, k});
            if (over.triangle < 0 || is_point(k) || is_point((k + 1) % 3) || !near_points_[over.triangle] ||
                seen.contains(over.triangle))
                continue;
            const Complex a = at.offset + local_.parameters(at.at, charts.corners(at.at.t)[k]);
            const Complex b = at.offset + local_.parameters(at.at, charts.corners(at.at.t)[(k + 1) % 3]);
            if (std::min(a.imag(), b.imag()) > tolerance_ || std::max(a.imag(), b.imag()) < -tolerance_ ||
                std::min(a.real(), b.real()) > to + tolerance_ || std::max(a.real(), b.real()) < from - tolerance_)
                continue;
            const Complex middle = charts.on_side(at.at.t, k, 0.5);
            const double heading = local_.heading({at.at.t, middle, at.at.turn});
            seen.insert(over.triangle);
            // Both sides have the same four directions at the middle.
            front.push_back(
                {local_.across({at.at.t, k}, 0.5, heading, at.at.turn), at.offset + local_.parameters(at.at, middle)});
        }
    }
}

bool SeparatrixTracer::arrives(const Passing& target, const LocalField::Place& at, int entry, double length) const {
    const int k = (entry + 2) % 3;
    const LayoutPoint& p = point(target.slot);
    if (local_.charts().mesh().triangles(at.t, k) != p.vertex || length < target.length / 2) return false;
    const double off = angle_at(local_, p, at.t, k, at.z) - p.slots[target.slot.slot];
    return std::abs(p.boundary ? off : wrapped(off, p.angle)) < sector_part * p.angle / p.quads;
}

std::vector<Passing> SeparatrixTracer::Walk::passing() const {
    std::vector<Passing> result;
    for (const Nearest& n : found) result.push_back(n.passing);
    std::sort(result.begin(), result.end(), [](const Passing& a, const Passing& b) { return a.slot < b.slot; });
    return result;
}

SeparatrixTracer::Walk SeparatrixTracer::begin(const Slot& start, double shear) const {
    const LayoutPoint& from = point(start);
    const Spoke spoke = spoke_at(local_, from, from.slots[start.slot] + shear / from.power);
    Walk walk;
    walk.shear = shear;
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
    const LocalField::Exit exit = local_.exit(at, entry);
    if (looking && walk.found.size() < most_passing) look_round(at, walk.length, walk.length + exit.length, walk.found);
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
                    target ? std::min(max_length_, target->length + 20 * tolerance_) : max_length_);
}

Trace SeparatrixTracer::beginning(const Slot& start, double reach) const {
    return trace_to(start, 0, {}, std::min(reach, max_length_));
}

Trace SeparatrixTracer::trace_to(const Slot& start, double shear, const std::optional<Passing>& target,
                                 double longest) const {
    Walk walk = begin(start, shear);
    while (!walk.trace.arrived && walk.length <= longest && step(walk, true, target)) {
    }
    walk.trace.passing = walk.passing();
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
        if (std::abs(target.offset) < 1e-3 * tolerance_ && shot > 1) return {};  // it goes to another sector
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
