// Traces single curves of a field across the triangles of its surface.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <concepts>
#include <functional>
#include <numbers>
#include <optional>
#include <set>
#include <unordered_map>

#include "charts.hpp"
#include "octafield/surface/streamlines.hpp"

namespace octafield::surface::detail {

struct Place {
    Index triangle;
    Complex at, heading;  // in the triangle's chart; heading unit
};

// Called for every segment with its ends and triangle; false ends the curve before the segment.
using Admit = std::function<bool(const Eigen::Vector3d& from, const Eigen::Vector3d& to, Index triangle)>;

struct TracedCurve {
    std::vector<Eigen::Vector3d> points;
    std::vector<Index> triangles;
    double length = 0;
    StreamlineEnd end = StreamlineEnd::length;
    Index singularity = -1;
};

// What curves can follow: the directions at each point of each triangle, in the triangle's chart. symmetry: how many
// there are. direction(t, z, heading): the one of them nearest to `heading`, unit; `heading` itself where there is
// none.
template <class Field>
concept TracedField = std::derived_from<Field, Charts> &&
    requires(const Field& field, Index t, Complex z, Complex heading) {
    { field.symmetry() } -> std::convertible_to<int>;
    { field.direction(t, z, heading) } -> std::convertible_to<Complex>;
};

template <TracedField Field>
class FieldTracer {
public:
    // Fills in the defaults of the options. Keeps references.
    FieldTracer(const Field& field, const SurfaceSingularities& singularities, const StreamlineOptions& options);

    // From the singular point `origin`, if >= 0, whose surroundings do not end the curve before it has left them.
    TracedCurve trace(const Place& start, Index origin = -1, const Admit& admit = {}) const;

    double max_length() const { return max_length_; }
    bool is_feature(Index edge) const { return field_.domain().is_feature()[edge]; }

private:
    struct Run;

    void find_surroundings(const SurfaceSingularities& singularities);

    const Field& field_;
    const SurfaceSingularities& singularities_;
    double max_length_, singular_radius_, close_radius_, least_headway_;
    bool stop_at_features_;
    std::unordered_map<Index, std::vector<Index>> surroundings_;  // triangle -> singular points near it
};

namespace tracing {

// Curves keep this part of an edge away from its ends.
inline constexpr double vertex_gap = 1e-6;
// A step turns by no more than twice this (radians), as long as it has not been halved too often.
inline constexpr double half_turn = 0.15;
inline constexpr int most_halvings = 8;
// A direction within this angle of an edge runs along it.
inline constexpr double least_slope = 1e-9;
// Steps between two looks at the headway.
inline constexpr Index steps_per_look = 512;
// Per side of the edge, for curves that run along it.
inline constexpr int samples_along_edge = 8;

inline double distance_to_segment(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    const Eigen::Vector3d along = b - a;
    const double square = along.squaredNorm();
    const double t = square > 0 ? std::clamp(along.dot(p - a) / square, 0.0, 1.0) : 0.0;
    return (a + t * along - p).norm();
}

inline double clear_of_vertices(double fraction) { return std::clamp(fraction, vertex_gap, 1 - vertex_gap); }

}  // namespace tracing

template <TracedField Field>
FieldTracer<Field>::FieldTracer(const Field& field, const SurfaceSingularities& singularities,
                                const StreamlineOptions& options)
    : field_(field), singularities_(singularities), stop_at_features_(options.stop_at_features) {
    const double edge = field.domain().mean_edge_length(), size = field.domain().size();
    max_length_ = options.max_length > 0 ? options.max_length : 4 * size;
    singular_radius_ = options.singular_radius > 0 ? options.singular_radius : edge / 2;
    close_radius_ = edge / 10;
    least_headway_ = 1e-4 * edge;
    find_surroundings(singularities);
}

// Triangles round each singular point that reach into its radius, found across edges.
template <TracedField Field>
void FieldTracer<Field>::find_surroundings(const SurfaceSingularities& singularities) {
    const TriangleMesh& mesh = field_.mesh();
    std::unordered_map<Index, std::vector<Index>> at_vertex;
    for (const SurfaceSingularity& point : singularities.points)
        if (point.vertex >= 0) at_vertex[point.vertex];
    for (Index t = 0; t < mesh.triangles.rows() && !at_vertex.empty(); ++t)
        for (const Index v : mesh.triangles.row(t))
            if (const auto place = at_vertex.find(v); place != at_vertex.end()) place->second.push_back(t);

    const auto reaches = [&](Index t, const Eigen::Vector3d& position) {
        const Eigen::Vector3d a = mesh.vertices.row(mesh.triangles(t, 0)), b = mesh.vertices.row(mesh.triangles(t, 1)),
                              c = mesh.vertices.row(mesh.triangles(t, 2)), middle = (a + b + c) / 3;
        const double extent = std::max({(a - middle).norm(), (b - middle).norm(), (c - middle).norm()});
        return (position - middle).norm() <= singular_radius_ + extent;
    };
    for (std::size_t i = 0; i < singularities.points.size(); ++i) {
        const SurfaceSingularity& point = singularities.points[i];
        std::vector<Index> queue = point.vertex >= 0 ? at_vertex[point.vertex] : std::vector<Index>{point.triangle};
        std::set<Index> seen(queue.begin(), queue.end());
        for (std::size_t next = 0; next < queue.size(); ++next) {
            surroundings_[queue[next]].push_back(static_cast<Index>(i));
            for (int k = 0; k < 3; ++k) {
                const Index other = field_.across({queue[next], k}).triangle;
                if (other >= 0 && reaches(other, point.position) && seen.insert(other).second) queue.push_back(other);
            }
        }
    }
}

// One curve being traced.
template <TracedField Field>
struct FieldTracer<Field>::Run {
    const FieldTracer& tracer;
    const Field& field;
    const Place start;
    const Admit& admit;
    Index leaving;  // singular point whose surroundings the curve has not left yet
    TracedCurve curve;
    Index triangle;
    Complex at, heading;
    int entry = -1;  // side of the triangle the curve is on, -1: inside
    bool left_start = false;

    Run(const FieldTracer& tracer, const Place& start, Index origin, const Admit& admit)
        : tracer(tracer),
          field(tracer.field_),
          start(start),
          admit(admit),
          leaving(origin),
          triangle(start.triangle),
          at(start.at),
          heading(start.heading) {
        curve.points.push_back(field.lift(triangle, at));
    }

    bool finish(StreamlineEnd end, Index singularity = -1) {
        curve.end = end;
        curve.singularity = singularity;
        return false;
    }

    void add(const Eigen::Vector3d& to) {
        curve.length += (to - curve.points.back()).norm();
        curve.points.push_back(to);
        curve.triangles.push_back(triangle);
    }

    // The singular point whose surroundings the segment enters, -1 if none.
    Index singularity_near(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
        const auto found = tracer.surroundings_.find(triangle);
        if (found == tracer.surroundings_.end()) {
            leaving = -1;
            return -1;
        }
        for (const Index i : found->second) {
            const Eigen::Vector3d& position = tracer.singularities_.points[i].position;
            const double distance = tracing::distance_to_segment(position, from, to);
            if (i == leaving) {
                if ((to - position).norm() > 1.5 * tracer.singular_radius_) leaving = -1;
            } else if (distance < tracer.singular_radius_) {
                return i;
            }
        }
        return -1;
    }

    bool closes(Complex to) const {
        if (triangle != start.triangle || !left_start) return false;
        const Complex along = to - at;
        const double square = std::norm(along);
        const double part = square > 0 ? std::clamp(dot(along, start.at - at) / square, 0.0, 1.0) : 0.0;
        return std::abs(at + part * along - start.at) < tracer.close_radius_ &&
               dot(heading, start.heading) > std::cos(std::numbers::pi / 2 / std::max(4, field.symmetry()));
    }

    // Goes straight to `to` in the current triangle; false at the curve's end.
    bool advance(Complex to) {
        const Eigen::Vector3d from = curve.points.back(), target = field.lift(triangle, to);
        if (admit && !admit(from, target, triangle)) return finish(StreamlineEnd::near_line);
        const Index singularity = singularity_near(from, target);
        const double rest = tracer.max_length_ - curve.length;
        if (closes(to) && (curve.points.front() - from).norm() <= rest) {
            add(curve.points.front());
            return finish(StreamlineEnd::closed);
        }
        const double step = (target - from).norm();
        if (step > rest) {
            add(from + rest / step * (target - from));
            return finish(StreamlineEnd::length);
        }
        add(target);
        at = to;
        left_start = left_start || curve.length > 4 * tracer.close_radius_;
        if (singularity >= 0) return finish(StreamlineEnd::singularity, singularity);
        return true;
    }

    bool leads_in(const Charts::Side& side, Complex direction) const {
        const Complex along = field.side(side.triangle, side.side);
        return cross(along, direction) > tracing::least_slope * std::abs(along);
    }

    void enter(const Charts::Side& side, double fraction, Complex direction) {
        triangle = side.triangle;
        entry = side.side;
        at = field.on_side(triangle, entry, fraction);
        heading = direction;
    }

    // One step by the midpoint rule inside the triangle, to a side (then arrive) or less far.
    bool step() {
        const Complex first = field.direction(triangle, at, heading);
        const Charts::Exit straight = field.exit(triangle, at, first, entry);
        if (straight.side < 0) return finish(StreamlineEnd::stuck);
        double length = straight.distance;
        Complex second = first;
        bool leads_back = false;
        for (int halvings = 0;; ++halvings, length /= 2) {
            second = field.direction(triangle, at + length / 2 * first, first);
            leads_back = entry >= 0 && !leads_in({triangle, entry}, second);
            if (halvings == tracing::most_halvings ||
                (!leads_back && std::abs(std::arg(second / first)) < tracing::half_turn))
                break;
        }
        if (leads_back) second = first;
        const Charts::Exit out = field.exit(triangle, at, second, entry);
        if (out.side < 0) return finish(StreamlineEnd::stuck);
        heading = second;
        if (length == straight.distance || length >= out.distance) return leave_by(out, at + out.distance * second);
        if (!advance(at + length * second)) return false;
        entry = -1;
        return true;
    }

    bool leave_by(const Charts::Exit& out, Complex target) {
        const Complex along = field.side(triangle, out.side);
        const double fraction =
            tracing::clear_of_vertices(dot(along, target - field.corners(triangle)[out.side]) / std::norm(along));
        return advance(field.on_side(triangle, out.side, fraction)) && arrive({triangle, out.side}, fraction);
    }

    // On a side of the current triangle, coming from inside.
    bool arrive(const Charts::Side& here, double fraction) {
        const Charts::Side there = field.across(here);
        if (there.triangle < 0) return finish(StreamlineEnd::boundary);
        if (tracer.stop_at_features_ && tracer.is_feature(field.topology().triangle_edges(triangle, here.side)))
            return finish(StreamlineEnd::feature);
        const Complex ahead = field.direction(there.triangle, field.on_side(there.triangle, there.side, 1 - fraction),
                                              field.carried(heading, here, there));
        if (leads_in(there, ahead)) {
            enter(there, 1 - fraction, ahead);
            return true;
        }
        return run_along(here, there, fraction);
    }

    // Both triangles lead to the edge: along it until one of them leads away, or past its end.
    bool run_along(const Charts::Side& here, const Charts::Side& there, double fraction) {
        const Complex edge = field.side(triangle, here.side);
        const bool forward = dot(edge, heading) >= 0;
        const double target = forward ? 1 - tracing::vertex_gap : tracing::vertex_gap;
        const Complex along = (forward ? 1.0 : -1.0) * edge / std::abs(edge);
        Complex inner = along, outer = field.carried(along, here, there);
        double next = fraction;
        bool outward = false, inward = false;
        for (int i = 1; i <= tracing::samples_along_edge && !outward && !inward; ++i) {
            next = fraction + (target - fraction) * i / tracing::samples_along_edge;
            outer = field.direction(there.triangle, field.on_side(there.triangle, there.side, 1 - next), outer);
            inner = field.direction(triangle, field.on_side(triangle, here.side, next), inner);
            outward = leads_in(there, outer);
            inward = leads_in(here, inner);
        }
        if (!advance(field.on_side(triangle, here.side, next))) return false;
        if (!outward && !inward) return pass_vertex(here, forward);
        if (outward) {
            enter(there, 1 - next, outer);
        } else {
            enter(here, next, inner);
        }
        return true;
    }

    double angle_at(const Charts::Side& side) const {  // at the corner the side starts from
        return std::arg(-field.side(side.triangle, (side.side + 2) % 3) / field.side(side.triangle, side.side));
    }

    // Coming along an edge to one of its ends: straight on, half the angle round the vertex to either hand.
    bool pass_vertex(const Charts::Side& here, bool forward) {
        const Charts::Side from = forward ? field.across(here) : here;  // the side that starts at the vertex
        double total = 0;
        Charts::Side side = from;
        do {
            total += angle_at(side);
            side = field.across({side.triangle, (side.side + 2) % 3});
            if (side.triangle < 0) return finish(StreamlineEnd::boundary);
        } while (side.triangle != from.triangle || side.side != from.side);
        double rest = total / 2;
        while (rest > angle_at(side)) {
            rest -= angle_at(side);
            side = field.across({side.triangle, (side.side + 2) % 3});
        }
        const Complex edge = field.side(side.triangle, side.side);
        triangle = side.triangle;
        entry = -1;
        heading = edge / std::abs(edge) * std::polar(1.0, rest);
        at = field.corners(triangle)[side.side];
        at += tracing::vertex_gap * (field.centroid(triangle) - at);
        return true;
    }
};

template <TracedField Field>
TracedCurve FieldTracer<Field>::trace(const Place& start, Index origin, const Admit& admit) const {
    Run run(*this, start, origin, admit);
    const Index most_steps = 1000 + 4 * static_cast<Index>(field_.mesh().triangles.rows());
    double length_before = 0;
    for (Index step = 1; run.step(); ++step) {
        if (step % tracing::steps_per_look != 0) continue;
        if (run.curve.length < length_before + least_headway_ || step > most_steps) {
            run.finish(StreamlineEnd::stuck);
            break;
        }
        length_before = run.curve.length;
    }
    return std::move(run.curve);
}

}  // namespace octafield::surface::detail
