#include "passed_points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>
#include <tuple>

namespace octafield::surface::detail {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double quarter = pi / 2;
constexpr double zone = 3;           // tolerances from a point, along edges
constexpr double ahead = 3;          // least length over offset of points nearer than three tolerances
constexpr double straight = pi / 4;  // off the way back, in parameters

int quarters_of(double turn) { return static_cast<int>(std::lround(turn / quarter)) & 3; }

}  // namespace

double spoke_length(const LocalField& local, const LayoutPoint& point, Index t, Complex end, double radius) {
    return radius * std::exp(-local.log_size(t, end)) / point.power;
}

double angle_at(const LocalField& local, const LayoutPoint& point, Index t, int k, Complex z) {
    const Charts& charts = local.charts();
    const auto found = std::find(point.corners.begin(), point.corners.end(), 3 * t + k);
    return point.starts[found - point.corners.begin()] + std::arg((z - charts.corners(t)[k]) / charts.side(t, k));
}

PassedPoints::PassedPoints(const LocalField& local, const LayoutPoints& points, double tolerance)
    : local_(local), points_(points), tolerance_(tolerance), near_of_(local.charts().mesh().triangles.rows(), -1) {
    find_near();
    entered_.reserve(3 * near_.size());
    for (const Index t : near_)
        for (int k = 0; k < 3; ++k) entered_.push_back(entered(t, k));
    seen_.assign(near_.size(), 0);
}

// Distances along edges, which are longer than straight ones, but not by half in triangles that are not thin.
void PassedPoints::find_near() {
    const Charts& charts = local_.charts();
    const Triangles& triangles = charts.mesh().triangles;
    const VertexFans& fans = charts.domain().fans();
    std::vector<double> distance(charts.mesh().vertices.rows(), std::numeric_limits<double>::infinity());
    using Entry = std::tuple<double, Index, double>;  // the last one the zone
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
    for (const LayoutPoint& p : points_.points)
        front.emplace(distance[p.vertex] = 0, p.vertex, zone * std::min(tolerance_, p.most_tolerance));
    const auto go_on = [&](double here, double most, Index t, int side, Index to) {
        const double log_size = local_.log_size(t, charts.on_side(t, side, 0.5));
        const double there = here + std::abs(charts.side(t, side)) * std::exp(-log_size);
        if (there >= distance[to] || there > most) return;
        front.emplace(distance[to] = there, to, most);
    };
    while (!front.empty()) {
        const auto [here, v, most] = front.top();
        front.pop();
        if (here > distance[v]) continue;
        auto fan = std::lower_bound(fans.fans.begin(), fans.fans.end(), v,
                                    [](const VertexFans::Fan& f, Index vertex) { return f.vertex < vertex; });
        for (; fan != fans.fans.end() && fan->vertex == v; ++fan)
            for (Index c = fan->first; c < fan->last; ++c) {
                const Index t = fans.corners[c] / 3;
                const int k = fans.corners[c] % 3;
                near_of_[t] = 0;
                go_on(here, most, t, k, triangles(t, (k + 1) % 3));
                go_on(here, most, t, (k + 2) % 3, triangles(t, (k + 2) % 3));
            }
    }
    for (Index t = 0; t < triangles.rows(); ++t) {
        if (near_of_[t] < 0) continue;
        near_of_[t] = static_cast<Index>(near_.size());
        near_.push_back(t);
    }
}

PassedPoints::Way PassedPoints::way_through(Index t, int side, const LocalField::Place& from) const {
    const Charts& charts = local_.charts();
    const Charts::Side over = charts.across({t, side});
    const Index beyond = over.triangle < 0 ? -1 : near_of_[over.triangle];
    const Triangles& triangles = charts.mesh().triangles;
    const int next = (side + 1) % 3;
    if (beyond < 0 || points_.of_vertex[triangles(t, side)] >= 0 || points_.of_vertex[triangles(t, next)] >= 0)
        return {};
    // Both sides have the same four directions at the middle.
    const LocalField::Place middle{t, charts.on_side(t, side, 0.5), 0};
    return {3 * beyond + over.side, quarters_of(local_.across({t, side}, 0.5, local_.heading(middle), 0).turn),
            local_.parameters(from, charts.corners(t)[side]), local_.parameters(from, charts.corners(t)[next]),
            local_.parameters(from, middle.z)};
}

PassedPoints::Entered PassedPoints::entered(Index t, int entry) const {
    const Charts& charts = local_.charts();
    const LocalField::Place middle{t, charts.on_side(t, entry, 0.5), 0};
    Entered result{{}, false};
    for (int k = 0, i = 0; k < 3; ++k) {
        result.at_point |= points_.of_vertex[charts.mesh().triangles(t, k)] >= 0;
        if (k != entry) result.ways[i++] = way_through(t, k, middle);
    }
    return result;
}

void PassedPoints::look_at(const LocalField::Place& at, Complex offset, const Part& part,
                           std::vector<Nearest>& found) const {
    for (int k = 0; k < 3; ++k)
        if (points_.of_vertex[local_.charts().mesh().triangles(at.t, k)] >= 0)
            look_at_corner(at, offset, k, part, found);
}

void PassedPoints::look_at_corner(const LocalField::Place& at, Complex offset, int k, const Part& part,
                                  std::vector<Nearest>& found) const {
    const double tolerance = part.tolerance, from = part.from;

    const Charts& charts = local_.charts();
    const Index place = points_.of_vertex[charts.mesh().triangles(at.t, k)];
    const LayoutPoint& p = points_.points[place];
    const Complex middle = charts.on_side(at.t, (k + 1) % 3, 0.5), way = middle - charts.corners(at.t)[k];
    const double radial = std::arg(way) - local_.angle(at.t, middle) - at.turn;
    const double length = spoke_length(local_, p, at.t, middle, std::abs(way));
    const Complex where = offset + local_.parameters(at, middle) - std::polar(length, radial);
    // From behind the point the way round it may be shorter, which ends at another sector.
    const double aside = std::abs(where.imag());
    const double nearest = points_.near ? std::min(3 * tolerance, ahead * aside) : 3 * tolerance;
    if (aside > tolerance || where.real() < nearest || where.real() < from) return;
    const double back = wrapped(pi - radial);
    const double phi = angle_at(local_, p, at.t, k, middle) + back / p.power;
    const double sector = p.angle / p.quads;
    for (int s = 0; s < static_cast<int>(p.slots.size()); ++s) {
        const double off = p.boundary ? phi - p.slots[s] : wrapped(phi - p.slots[s], p.angle);
        if (std::abs(off) > sector_part * sector || std::abs(back) > 0.6 * pi) continue;
        const Nearest seen{{{place, s}, where.real(), where.imag()}, std::abs(back), from};
        const auto known = std::find_if(found.begin(), found.end(), [&](const Nearest& n) {
            return n.passing.slot.point == place && std::abs(n.passing.length - where.real()) < 5 * tolerance;
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

// Not round points. The first triangle is entered anywhere, the others at the middle of a side.
void PassedPoints::look_round(const LocalField::Place& start, const Part& part, std::vector<Nearest>& found) const {
    if (near_of_[start.t] < 0) return;
    const Charts& charts = local_.charts();
    const auto [shear, tolerance, from, to] = part;
    std::array<Complex, 4> turned;
    for (int q = 0; q < 4; ++q) turned[q] = std::polar(1.0, -shear - q * quarter);
    ++round_;
    front_.clear();
    const auto go_on = [&](const Way& way, int quarters, Complex offset, Complex turn) {
        if (way.to < 0 || seen_[way.to / 3] == round_) return;
        const Complex a = offset + turn * way.from, b = offset + turn * way.until;
        if (std::min(a.imag(), b.imag()) > tolerance || std::max(a.imag(), b.imag()) < -tolerance ||
            std::min(a.real(), b.real()) > to + tolerance || std::max(a.real(), b.real()) < from - tolerance)
            return;
        seen_[way.to / 3] = round_;
        front_.push_back({way.to, (quarters + way.quarters) & 3, offset + turn * way.middle});
    };
    seen_[near_of_[start.t]] = round_;
    look_at(start, from, part, found);
    for (int k = 0; k < 3; ++k) go_on(way_through(start.t, k, start), quarters_of(start.turn - shear), from, 1.0);
    for (std::size_t i = 0; i < front_.size(); ++i) {
        const auto [place, quarters, offset] = front_[i];
        const Entered& entered = entered_[place];
        if (entered.at_point) {
            const Index t = near_[place / 3];
            look_at({t, charts.on_side(t, place % 3, 0.5), shear + quarters * quarter}, offset, part, found);
        }
        for (const Way& way : entered.ways) go_on(way, quarters, offset, turned[quarters]);
    }
}

}  // namespace octafield::surface::detail
