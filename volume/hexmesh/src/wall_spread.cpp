#include "wall_spread.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include "octafield/error.hpp"

namespace octafield::volume::detail {
namespace {

constexpr double reach = 0.3;  // of an edge: a vertex that is nearer to a plane moves there

double distance(const Eigen::Vector3d& x, const std::array<Eigen::Vector3d, 2>& segment) {
    const Eigen::Vector3d way = segment[1] - segment[0];
    const double length = way.squaredNorm();
    const double t = length > 0 ? std::clamp((x - segment[0]).dot(way) / length, 0., 1.) : 0.;
    return (x - segment[0] - t * way).norm();
}

const Eigen::Vector3d& place(const CutTet& tet, Index vertex) { return tet.at[tet.corner(vertex)]; }

// Of the parameters of a tet around an edge of it.
double angle(const CutTet& tet, const Wedge& wedge, const EdgeKey& edge) {
    return angle_round(place(tet, edge[0]), place(tet, edge[1]), place(tet, wedge.from), place(tet, wedge.to));
}

int quarters(double angle) { return static_cast<int>(std::lround(angle / (std::numbers::pi / 2))); }

}  // namespace

int quarters_around(const CutTets& tets, const EdgeRing& ring, const EdgeKey& edge) {
    double sum = 0;
    for (const Wedge& wedge : ring.wedges) sum += angle(tets.tet(wedge.tet), wedge, edge);
    return quarters(sum);
}

WallsAround walls_around(const CutTets& tets, const EdgeKey& edge, Index first) {
    const EdgeRing ring = tets.ring(edge, first);
    WallsAround result{{}, 0, ring.closed};
    if (!ring.closed) result.places.push_back({-1, 0});
    double sum = 0, start = ring.closed ? std::nan("") : 0;
    for (const Wedge& wedge : ring.wedges) {
        const CutTet& tet = tets.tet(wedge.tet);
        sum += angle(tet, wedge, edge);
        const int face = tet.corner(wedge.from);
        if (tet.wall[face] < 0 && tet.next[face] >= 0) continue;
        if (std::isnan(start)) start = sum;
        result.places.push_back({tet.wall[face], quarters(sum - start)});
    }
    result.quarters = quarters(sum);
    return result;
}

double WallSpread::height(const View& view, Index vertex) const {
    return place(tets_.tet(view.tet), vertex)[view.axis] - view.source[0][view.axis];
}

WallSpread::View WallSpread::across(const View& view, int face) const {
    const Transition& over = tets_.over(view.tet, face);
    View result = view;
    result.tet = tets_.tet(view.tet).next[face];
    over.rotation.col(view.axis).cwiseAbs().maxCoeff(&result.axis);
    for (int i = 0; i < 2; ++i) result.source[i] = over(view.source[i]);
    result.forward = over.rotation * view.forward;
    return result;
}

// From a wall around an edge to where the plane goes on.
WallSpread::Found WallSpread::look(View view, const EdgeKey& edge) const {
    bool crossed = false;
    double sign = 0;
    for (int steps = 0; steps < 100000; ++steps) {
        const CutTet& tet = tets_.tet(view.tet);
        const int a = tet.corner(edge[0]), b = tet.corner(edge[1]), from = tet.corner(view.from);
        const int to = 6 - a - b - from;
        const Index other = tet.vertices[to];
        double above = height(view, other);
        if (sign == 0) sign = above > 0 ? 1 : -1;
        above *= sign;
        const bool ahead = view.forward.dot(tet.at[to] - tet.at[a]) > 0;
        const bool reached = std::abs(above) <= tets_.tolerance() && ahead;
        if (reached) return {Found::triangle, view, other, crossed};
        if (above < -tets_.tolerance()) return {Found::inside, view, other, crossed};
        if (tet.next[from] < 0) return {Found::boundary, view, other, true};
        crossed |= tet.wall[from] >= 0;
        const double turned = tets_.over(view.tet, from).rotation.col(view.axis).sum();  // 1 or -1
        view = across(view, from);
        view.from = other;
        sign *= turned;
    }
    throw GeometryError(
        "parameters wind round the edge of vertices " + std::to_string(edge[0]) + " and " + std::to_string(edge[1]),
        "winding_edge", {edge[0], edge[1]});
}

std::optional<WallSpread::Found> WallSpread::next(Index number, const EdgeKey& edge) const {
    const WallTriangle wall = tets_.walls()[number];
    const auto corners = tets_.triangle(wall.tet, wall.face);
    Index third = -1;
    int known = 0;
    for (const Index v : corners) {
        if (v == edge[0] || v == edge[1])
            ++known;
        else
            third = v;
    }
    if (known < 2 || tets_.irregular.count(edge)) return std::nullopt;
    const CutTet& tet = tets_.tet(wall.tet);
    const Eigen::Vector3d &p = place(tet, edge[0]), &q = place(tet, edge[1]);
    Eigen::Vector3d forward = Eigen::Vector3d::Unit(wall.axis).cross(q - p);
    if (forward.dot(place(tet, third) - p) > 0) forward = -forward;
    const View view{wall.tet, third, wall.axis, wall.source, forward};
    const Found one = look(view, edge);
    const auto is_wall = [&](const Found& found) {
        const CutTet& at = tets_.tet(found.view.tet);
        const int face = at.corner(found.view.from);
        return at.wall[face] >= 0 || at.next[face] < 0;
    };
    if (one.kind == Found::triangle && is_wall(one)) return std::nullopt;
    if (tet.next[wall.face] < 0) return std::nullopt;
    const Found other = look(across(view, wall.face), edge);
    if (one.crossed && other.crossed) return std::nullopt;
    const Found& found = one.kind == Found::boundary ? other : one;
    if (found.kind == Found::boundary || (found.kind == Found::triangle && is_wall(found))) return std::nullopt;
    return found;
}

// A wall goes on to the end of the given tet at once: two walls that took turns in it could come nearer to where they
// cross for ever.
void WallSpread::go_on(Index wall, const EdgeKey& edge) {
    std::vector<CutTets::WallEdge> open{{wall, edge}};
    Index root = -1;
    while (!open.empty()) {
        const auto [from, side] = open.back();
        open.pop_back();
        const std::optional<Found> found = next(from, side);
        if (!found) continue;
        const Index there = tets_.tet(found->view.tet).root;
        if (root < 0) root = there;
        if (there != root) {
            push(from, side);
            continue;
        }
        const Index made = make(*found, side);
        for (const auto& fresh : tets_.take_new_edges()) {
            if (fresh.wall == made)
                open.push_back(fresh);
            else
                push(fresh.wall, fresh.edge);
        }
    }
}

double WallSpread::share(const View& view, Index a, Index b) const {
    const double low = height(view, a), high = height(view, b);
    return low / (low - high);
}

Index WallSpread::make(const Found& found, const EdgeKey& edge) {
    const View& view = found.view;
    Index tet = view.tet, end = found.to;
    if (found.kind == Found::inside) {
        const EdgeKey cut = edge_key(view.from, found.to);
        const double part = share(view, cut[0], cut[1]);
        const int nearer = part < 0.5 ? 0 : 1;
        const double way = nearer ? 1 - part : part;
        if (way < reach && tets_.slide(tet, cut[nearer], view.axis, view.source[0][view.axis]))
            end = cut[nearer];
        else
            end = tets_.split(cut, part);
    }
    const auto& vertices = tets_.tet(tet).vertices;
    for (int k = 0; k < 4; ++k)
        if (vertices[k] != edge[0] && vertices[k] != edge[1] && vertices[k] != end)
            return tets_.add_wall(tet, k, view.axis, view.source);
    throw std::logic_error("a tet has four vertices");
}

void WallSpread::queue_new_edges() {
    for (const auto& [wall, edge] : tets_.take_new_edges()) push(wall, edge);
}

void WallSpread::push(Index wall, const EdgeKey& edge) {
    const WallTriangle& at = tets_.walls()[wall];
    const CutTet& tet = tets_.tet(at.tet);
    const Eigen::Vector3d middle = (place(tet, edge[0]) + place(tet, edge[1])) / 2;
    queue_.push({distance(middle, at.source), age_++, wall, edge});
}

void WallSpread::require_end() const {
    if (tets_.tet_count() > most_tets_)
        throw SolverError("walls cut the mesh into more than " + std::to_string(most_tets_) +
                              " tets and do not end; does the map wind?",
                          "endless_walls");
}

void WallSpread::spread() {
    queue_new_edges();
    for (std::int64_t step = 0; !queue_.empty(); ++step) {
        if (step % 1024 == 0) report_or_throw(progress_, "walls", -1, std::nan(""));
        const auto [unused, age, wall, edge] = queue_.top();
        queue_.pop();
        go_on(wall, edge);
        require_end();
    }
}

void WallSpread::start_at_edges() {
    std::vector<EdgeKey> edges(tets_.irregular.begin(), tets_.irregular.end());
    for (std::size_t i = 0; i < edges.size(); ++i) {
        if (!tets_.irregular.count(edges[i])) continue;
        start_at_edge(edges[i]);
        const auto halves = tets_.take_new_irregular();
        edges.insert(edges.end(), halves.begin(), halves.end());
    }
    queue_new_edges();
}

void WallSpread::start_at_edge(const EdgeKey& edge) {
    for (bool again = true; again;) {
        again = false;
        for (const Wedge& wedge : tets_.ring(edge).wedges)
            if (start_in(edge, wedge)) {
                again = true;
                break;
            }
    }
}

// A wall at the edge inside a tet, or in the triangle at the end of it; false: none is missing there.
bool WallSpread::start_in(const EdgeKey& edge, const Wedge& wedge) {
    const CutTet& tet = tets_.tet(wedge.tet);
    const Eigen::Vector3d &p = place(tet, edge[0]), &q = place(tet, edge[1]);
    int along = 0;
    (q - p).cwiseAbs().maxCoeff(&along);
    const Eigen::Vector3d from = place(tet, wedge.from) - p, to = place(tet, wedge.to) - p;
    for (const int axis : {(along + 1) % 3, (along + 2) % 3}) {
        if (std::abs(p[axis] - q[axis]) > tets_.tolerance()) continue;
        const int ahead = 3 - along - axis;
        for (const int sign : {1, -1}) {
            const View view{wedge.tet, wedge.from, axis, {p, q}, sign * Eigen::Vector3d::Unit(ahead)};
            const int face = tet.corner(wedge.from);
            if (std::abs(to[axis]) <= tets_.tolerance()) {
                if (sign * to[ahead] <= 0 || tet.wall[face] >= 0 || tet.next[face] < 0) continue;
                make({Found::triangle, view, wedge.to, false}, edge);
                return true;
            }
            if (std::abs(from[axis]) <= tets_.tolerance() || from[axis] * to[axis] > 0) continue;
            const double part = from[axis] / (from[axis] - to[axis]);
            if (sign * (from[ahead] + part * (to[ahead] - from[ahead])) <= 0) continue;
            make({Found::inside, view, wedge.to, false}, edge);
            return true;
        }
    }
    return false;
}

bool WallSpread::start_at_corner(Index t, int corner, int axis) {
    const CutTet tet = tets_.tet(t);
    const Eigen::Vector3d at = tet.at[corner];
    std::vector<int> above, below, level;
    for (int k = 0; k < 4; ++k) {
        if (k == corner) continue;
        const double height = tet.at[k][axis] - at[axis];
        (std::abs(height) <= tets_.tolerance() ? level : height > 0 ? above : below).push_back(k);
    }
    if (level.size() == 2) {
        const int face = (above.empty() ? below : above)[0];
        if (tet.next[face] < 0 || tet.wall[face] >= 0) return false;
        tets_.add_wall(t, face, axis, {at, at});
        queue_new_edges();
        return true;
    }
    if (above.empty() || below.empty()) return false;
    // The edge from the corner to a crossing, or to a level vertex; the wall goes on from there within the tet.
    const View view{t, tet.vertices[above[0]], axis, {at, at}, Eigen::Vector3d::Zero()};
    if (level.empty()) {
        const bool two_above = above.size() == 2;
        const int alone = two_above ? below[0] : above[0];
        const auto& pair = two_above ? above : below;
        const EdgeKey cut = edge_key(tet.vertices[alone], tet.vertices[pair[0]]);
        const Index middle = tets_.split(cut, share(view, cut[0], cut[1]));
        const EdgeKey edge = edge_key(tet.vertices[corner], middle);
        const Index alone_vertex = tet.vertices[alone], far = tet.vertices[pair[1]];
        for (const Wedge& wedge : tets_.ring(edge).wedges) {
            const auto& v = tets_.tet(wedge.tet).vertices;
            const auto has = [&](Index x) { return std::find(v.begin(), v.end(), x) != v.end(); };
            if (!has(alone_vertex) || !has(far)) continue;
            View there = view;
            there.tet = wedge.tet;
            there.from = alone_vertex;
            make({Found::inside, there, far, false}, edge);
            queue_new_edges();
            return true;
        }
        return false;
    }
    const EdgeKey edge = edge_key(tet.vertices[corner], tet.vertices[level[0]]);
    make({Found::inside, view, tet.vertices[below[0]], false}, edge);
    queue_new_edges();
    return true;
}

}  // namespace octafield::volume::detail
