#include "track_race.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <queue>
#include <tuple>

namespace octafield::surface::detail {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();
constexpr double least_sine = 0.5;  // of the angle at which tracks cross
constexpr double look_on = 3;       // tolerances: how far a track is followed behind its end, for points beside it

// Where a curve meets the border of a triangle: 2 k at corner k, between 2 k and 2 k + 2 on side k.
double ring_place(const Charts& charts, Index t, const LayoutCurvePoint& at) {
    for (int k = 0; k < 3; ++k) {
        if (at.vertex >= 0 ? charts.mesh().triangles(t, k) != at.vertex
                           : charts.topology().triangle_edges(t, k) != at.edge)
            continue;
        if (at.vertex >= 0) return 2 * k;
        const bool forward = charts.mesh().triangles(t, k) == charts.topology().edges(at.edge, 0);
        return 2 * k + 0.5 + (forward ? at.fraction : 1 - at.fraction);
    }
    return -1;
}

Complex place_of(const Charts& charts, Index t, double ring) {
    const int k = static_cast<int>(ring / 2);
    const double part = ring - 2 * k;
    return part == 0 ? charts.corners(t)[k] : charts.on_side(t, k, part - 0.5);
}

class Race {
public:
    Race(const LocalField& local, const SeparatrixTracer& tracer, const std::vector<LayoutCurve>& walls,
         const std::vector<Slot>& slots, double max_length, KnownWalks& known)
        : charts_(local.charts()),
          walls_(walls),
          max_length_(max_length),
          in_triangle_(charts_.mesh().triangles.rows()) {
        for (std::size_t w = 0; w < walls.size(); ++w)
            for (Index i = 0; i < static_cast<Index>(walls[w].triangles.size()); ++i)
                in_triangle_[walls[w].triangles[i]].push_back(part(walls[w], static_cast<Index>(w), i));
        for (const Slot& slot : slots) {
            tracks_.push_back({});
            tracks_.back().slot = slot;
            stops_.push_back(never);
            last_place_.push_back(-1);
            walks_.push_back({&known.try_emplace(slot, tracer, slot).first->second, 1});
        }
    }

    std::vector<Track> run() {
        for (Index i = 0; i < static_cast<Index>(tracks_.size()); ++i) enter(i);
        while (!events_.empty()) {
            const Event event = events_.top();
            events_.pop();
            if (event.stop) {
                stop(event);
            } else if (stops_[event.track] == never) {
                go_on(event.track);
            }
        }
        for (std::size_t i = 0; i < tracks_.size(); ++i) finish(i);
        return std::move(tracks_);
    }

private:
    struct Walk {
        KnownWalk* known;
        Index triangles;  // as far as it has gone
        double length() const { return known->length(triangles); }
        bool at_boundary() const { return known->at_boundary(triangles); }
        bool go_on() {
            const bool on = known->goes_on(triangles);
            triangles += on;
            return on;
        }
    };
    struct Part {
        Index curve, place;  // walls first; triangle of the curve
        double from, to;     // ring places
        double first, last;  // lengths
    };
    struct Event {
        double time;
        bool stop;  // otherwise it enters the next triangle
        Index track;
        Index place;  // of the triangle it stops in
        Index other;
        double other_length;  // along the other one
        bool from_left;
        bool operator<(const Event& b) const {  // the first one is the greatest
            return std::tie(b.time, b.stop, b.track, b.other) < std::tie(time, stop, track, other);
        }
    };

    Part part(const LayoutCurve& curve, Index number, Index i) const {
        const Index t = curve.triangles[i];
        return {number,
                i,
                ring_place(charts_, t, curve.points[i]),
                ring_place(charts_, t, curve.points[i + 1]),
                curve.points[i].length,
                curve.points[i + 1].length};
    }
    bool is_wall(Index curve) const { return curve < static_cast<Index>(walls_.size()); }
    Index track_of(Index curve) const { return curve - static_cast<Index>(walls_.size()); }

    static bool cross_one_another(const Part& a, const Part& b) {
        const auto [low, high] = std::minmax(a.from, a.to);
        if (b.from == low || b.from == high || b.to == low || b.to == high) return false;
        return (b.from > low && b.from < high) != (b.to > low && b.to < high);
    }

    // Lengths along both where they cross, by straight lines. None if they run side by side: curves of one family do
    // not meet but for rounding.
    struct Crossing {
        double here, there;
        bool from_left;  // of b, where a comes from
    };
    std::optional<Crossing> crossing(Index t, const Part& a, const Part& b) const {
        const Complex p = place_of(charts_, t, a.from), u = place_of(charts_, t, a.to) - p;
        const Complex q = place_of(charts_, t, b.from), v = place_of(charts_, t, b.to) - q;
        const double area = cross(u, v);
        if (std::abs(area) < least_sine * std::abs(u) * std::abs(v)) return {};
        const auto along = [](const Part& part, double fraction) {
            fraction = fraction > 0 ? std::min(fraction, 1.0) : 0.0;
            return part.first + fraction * (part.last - part.first);
        };
        return Crossing{along(a, cross(q - p, v) / area), along(b, cross(q - p, u) / area), area > 0};
    }

    // The last triangle of its walk is new.
    void enter(Index track) {
        const LayoutCurve& curve = walks_[track].known->curve();
        const Index place = walks_[track].triangles - 1;
        const Index t = curve.triangles[place];
        const Part own = part(curve, static_cast<Index>(walls_.size()) + track, place);
        for (const Part& other : in_triangle_[t]) {
            if (!cross_one_another(own, other)) continue;
            const auto crossed = crossing(t, own, other);
            if (!crossed) continue;
            const auto [here, there, from_left] = *crossed;
            if (is_wall(other.curve)) {
                events_.push({here, true, track, place, other.curve, there, from_left});
                continue;
            }
            const Index rival = track_of(other.curve);
            if (std::tie(there, rival) < std::tie(here, track)) {
                events_.push({here, true, track, place, other.curve, there, from_left});
            } else {
                events_.push({there, true, rival, other.place, own.curve, here, !from_left});
            }
        }
        in_triangle_[t].push_back(own);
        if (const Walk& walk = walks_[track]; !walk.at_boundary() && walk.length() <= max_length_)
            events_.push({walk.length(), false, track, -1, -1, 0, false});
    }

    void go_on(Index track) {
        walks_[track].go_on();
        enter(track);
    }

    void stop(const Event& event) {
        if (event.time >= stops_[event.track]) return;
        if (!is_wall(event.other) && event.other_length > stops_[track_of(event.other)]) return;
        stops_[event.track] = event.time;
        tracks_[event.track].stopped_by = event.other;
        tracks_[event.track].stopped_at = event.other_length;
        tracks_[event.track].from_left = event.from_left;
        last_place_[event.track] = event.place;
    }

    void finish(std::size_t i) {
        Track& track = tracks_[i];
        Walk& walk = walks_[i];
        track.curve = walk.known->curve();
        track.ended = walk.at_boundary() || track.stopped_by >= 0;
        track.length = std::min(stops_[i], walk.length());
        const Index triangles = track.stopped_by >= 0 ? last_place_[i] + 1 : walk.triangles;
        track.curve.triangles.resize(triangles);
        track.curve.points.resize(triangles + 1);
        const double last = track.length + look_on * walk.known->tolerance();
        while (track.ended && walk.length() < last && walk.go_on()) {
        }
        for (const Passing& p : walk.known->passing(walk.triangles))
            if (p.length < last) track.passing.push_back(p);
    }

    const Charts& charts_;
    const std::vector<LayoutCurve>& walls_;
    double max_length_;
    std::vector<std::vector<Part>> in_triangle_;
    std::vector<Track> tracks_;
    std::vector<double> stops_;
    std::vector<Walk> walks_;
    std::vector<Index> last_place_;
    std::priority_queue<Event> events_;
};

}  // namespace

std::vector<Track> race(const LocalField& local, const SeparatrixTracer& tracer, const std::vector<LayoutCurve>& walls,
                        const std::vector<Slot>& slots, double max_length, KnownWalks& known) {
    return Race(local, tracer, walls, slots, max_length, known).run();
}

}  // namespace octafield::surface::detail
