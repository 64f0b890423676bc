#include "surface_walk.hpp"

#include <algorithm>
#include <queue>

#include "half_edges.hpp"

namespace octafield::surface {
namespace {

using Vector = Eigen::Vector3d;

constexpr int kPatience = 40;  // triangles, or segments, that bring one no nearer

}  // namespace

Vector nearest_on_segment(const Vector& p, const Vector& a, const Vector& b) {
    const double square = (b - a).squaredNorm();
    const double at = square > 0 ? std::clamp((p - a).dot(b - a) / square, 0., 1.) : 0;
    return at == 1 ? b : Vector(a + at * (b - a));
}

Vector nearest_on_triangle(const Vector& p, const Vector& a, const Vector& b, const Vector& c) {
    const Vector normal = (b - a).cross(c - a);
    const double square = normal.squaredNorm();
    if (square > 0) {
        const double second = (p - a).cross(c - a).dot(normal) / square,
                     third = (b - a).cross(p - a).dot(normal) / square;
        if (second >= 0 && third >= 0 && second + third <= 1) return a + second * (b - a) + third * (c - a);
    }
    Vector best = nearest_on_segment(p, a, b);
    for (const Vector& q : {nearest_on_segment(p, b, c), nearest_on_segment(p, c, a)})
        if ((q - p).squaredNorm() < (best - p).squaredNorm()) best = q;
    return best;
}

SurfaceWalk::SurfaceWalk(const Background& ground)
    : ground_(ground),
      curves_(curves_of(ground)),
      round_(ground.mesh.vertices.rows()),
      neighbours_(ground.mesh.triangles.rows(), {-1, -1, -1}),
      seen_triangle_(ground.mesh.triangles.rows(), 0),
      seen_segment_(ground.features.edges.rows(), 0) {
    for (const Index v : ground.pinned) curves_.is_corner[v] = true;
    for (Index t = 0; t < ground.mesh.triangles.rows(); ++t)
        for (const Index v : ground.mesh.triangles.row(t)) round_[v].push_back(t);
    for_each_edge(sorted_half_edges(ground.mesh.triangles), [&](auto begin, auto end) {
        if (end - begin != 2) return;
        neighbours_[begin->triangle][begin->corner] = std::next(begin)->triangle;
        neighbours_[std::next(begin)->triangle][std::next(begin)->corner] = begin->triangle;
    });
}

Carrier SurfaceWalk::carrier_of(Index v) const {
    if (curves_.is_corner[v] || (!curves_.edges[v].empty() && curves_.edges[v].size() != 2))
        return {Carrier::On::vertex, v};
    if (!curves_.edges[v].empty()) return {Carrier::On::segment, curves_.edges[v].front()};
    return round_[v].empty() ? Carrier{Carrier::On::vertex, v} : Carrier{Carrier::On::triangle, round_[v].front()};
}

template <class Neighbours, class Nearest>
std::optional<std::pair<Index, Vector>> SurfaceWalk::walk(std::span<const Index> starts, const Vector& target,
                                                          std::vector<int>& seen, const Neighbours& neighbours,
                                                          const Nearest& nearest) {
    if (starts.empty()) return std::nullopt;
    ++walks_;
    using Entry = std::pair<double, Index>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    const auto visit = [&](Index id, double most) {
        if (seen[id] == walks_) return;
        seen[id] = walks_;
        const double square = (nearest(id) - target).squaredNorm();
        if (square <= most) open.emplace(square, id);
    };
    for (const Index id : starts) visit(id, std::numeric_limits<double>::infinity());
    const double farthest = open.top().first * (1 + 1e-12);
    Entry best = open.top();
    for (int idle = 0; !open.empty() && idle < kPatience; ++idle) {
        const Entry now = open.top();
        open.pop();
        if (now.first < best.first) {
            best = now;
            idle = 0;
        }
        if (best.first == 0) break;
        neighbours(now.second, [&](Index id) { visit(id, farthest); });
    }
    return std::pair(best.second, nearest(best.second));
}

void SurfaceWalk::start_triangles(const Carrier& start, int patch, std::vector<Index>& found) const {
    const auto take = [&](Index t) {
        if (ground_.patch[t] == patch) found.push_back(t);
    };
    if (start.on == Carrier::On::triangle) return take(start.id);
    if (start.on == Carrier::On::vertex)
        std::ranges::for_each(round_[start.id], take);
    else
        for (const Index v : ground_.features.edges.row(start.id)) std::ranges::for_each(round_[v], take);
}

std::optional<Place> SurfaceWalk::on_surface(std::span<const Carrier> starts, int patch, const Vector& target) {
    std::vector<Index> first;
    for (const Carrier& start : starts) start_triangles(start, patch, first);
    const auto nearest = [&](Index t) {
        const auto corners = ground_.mesh.triangles.row(t);
        return nearest_on_triangle(target, vertex(corners[0]), vertex(corners[1]), vertex(corners[2]));
    };
    const auto neighbours = [&](Index t, const auto& visit) {
        for (const Index other : neighbours_[t])
            if (other >= 0 && ground_.patch[other] == patch) visit(other);
    };
    const auto found = walk(first, target, seen_triangle_, neighbours, nearest);
    if (!found) return std::nullopt;
    const auto& [triangle, point] = *found;
    return Place{point, {Carrier::On::triangle, triangle}, length_at(ground_, triangle, point)};
}

std::optional<Place> SurfaceWalk::on_curve(std::span<const Carrier> starts, int curve, const Vector& target) {
    const Edges& edges = ground_.features.edges;
    std::vector<Index> first;
    const auto take = [&](Index segment) {
        if (curves_.of_edge[segment] == curve) first.push_back(segment);
    };
    for (const Carrier& start : starts) {
        if (start.on == Carrier::On::segment) take(start.id);
        if (start.on == Carrier::On::vertex) std::ranges::for_each(curves_.edges[start.id], take);
    }
    const auto nearest = [&](Index s) { return nearest_on_segment(target, vertex(edges(s, 0)), vertex(edges(s, 1))); };
    const auto neighbours = [&](Index s, const auto& visit) {
        for (const Index v : edges.row(s))
            if (!curves_.is_corner[v])
                for (const Index next : curves_.edges[v]) visit(next);
    };
    const auto found = walk(first, target, seen_segment_, neighbours, nearest);
    if (!found) return std::nullopt;
    const auto& [segment, point] = *found;
    const Carrier carrier{Carrier::On::segment, segment};
    return Place{point, carrier, length(carrier, point)};
}

double SurfaceWalk::length(const Carrier& carrier, const Vector& point) const {
    if (carrier.on == Carrier::On::triangle) return length_at(ground_, carrier.id, point);
    if (carrier.on == Carrier::On::vertex) return ground_.length[carrier.id];
    const auto ends = ground_.features.edges.row(carrier.id);
    const double whole = (vertex(ends[1]) - vertex(ends[0])).norm();
    const double share = whole > 0 ? std::clamp((point - vertex(ends[0])).norm() / whole, 0., 1.) : 0;
    return (1 - share) * ground_.length[ends[0]] + share * ground_.length[ends[1]];
}

}  // namespace octafield::surface
