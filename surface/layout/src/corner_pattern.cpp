#include "octafield/surface/corner_pattern.hpp"

#include <algorithm>
#include <map>
#include <queue>
#include <set>
#include <tuple>

#include "octafield/disjoint_sets.hpp"
#include "octafield/error.hpp"

namespace octafield::surface {
namespace {

// A quarter turn that a corner had more or less than it is to have.
struct Change {
    Index vertex;
    int turn;  // 1 or -1, to go inside
};

class Mover {
public:
    Mover(const SurfaceDomain& domain, SingularPattern& pattern) : domain_(domain), pattern_(pattern) {
        for (const ImposedPoint& point : pattern.points)
            if (point.triangle < 0 || point.triangle >= domain.triangle_count())
                throw InvalidInput("a point is in no triangle of the surface", "outside_surface");
        find_inside();
        DisjointSets parts(domain.vertex_count());
        triangle_at_.assign(domain.vertex_count(), -1);
        for (Index t = 0; t < domain.triangle_count(); ++t)
            for (int k = 0; k < 3; ++k) {
                parts.join(domain.mesh().triangles(t, 0), domain.mesh().triangles(t, k));
                triangle_at_[domain.mesh().triangles(t, k)] = t;
            }
        Index count = 0;
        part_of_ = std::move(parts).numbers(count);
    }

    void require_boundary(const std::vector<CornerQuads>& corners) const {
        for (const CornerQuads& c : corners)
            if (c.vertex < 0 || c.vertex >= domain_.vertex_count() || inside_[c.vertex] || triangle_at_[c.vertex] < 0)
                throw InvalidInput("vertex " + std::to_string(c.vertex) + " is not on the boundary", "not_on_boundary",
                                   {c.vertex});
    }

    void make_good(std::vector<Change> changes) {
        cancel(changes);
        for (const Change& change : changes)
            if (!take_away(change)) add(change);
    }

private:
    Eigen::Vector3d position(Index v) const { return domain_.mesh().vertices.row(v); }
    Eigen::Vector3d centre(Index t) const {
        const auto v = domain_.mesh().triangles.row(t);
        return (position(v[0]) + position(v[1]) + position(v[2])) / 3;
    }

    void find_inside() {
        inside_.assign(domain_.vertex_count(), true);
        for (Index e = 0; e < domain_.edge_count(); ++e)
            if (domain_.topology().edge_triangles.row(e).minCoeff() < 0)
                inside_[domain_.topology().edges(e, 0)] = inside_[domain_.topology().edges(e, 1)] = false;
    }

    void cancel(std::vector<Change>& changes) const {
        std::vector<std::tuple<double, std::size_t, std::size_t>> pairs;
        for (std::size_t a = 0; a < changes.size(); ++a)
            for (std::size_t b = a + 1; b < changes.size(); ++b)
                if (changes[a].turn != changes[b].turn && part_of_[changes[a].vertex] == part_of_[changes[b].vertex])
                    pairs.emplace_back((position(changes[a].vertex) - position(changes[b].vertex)).norm(), a, b);
        std::sort(pairs.begin(), pairs.end());
        std::vector<bool> gone(changes.size(), false);
        for (const auto& [distance, a, b] : pairs)
            if (!gone[a] && !gone[b]) gone[a] = gone[b] = true;
        std::size_t place = 0;
        std::erase_if(changes, [&](const Change&) { return gone[place++]; });
    }

    bool take_away(const Change& change) {
        auto best = pattern_.points.end();
        double least = 0;
        for (auto p = pattern_.points.begin(); p != pattern_.points.end(); ++p) {
            const Index part = part_of_[domain_.mesh().triangles(p->triangle, 0)];
            if (p->index_times_four != -change.turn || part != part_of_[change.vertex]) continue;
            const double distance = (imposed_position(domain_, *p) - position(change.vertex)).norm();
            if (best != pattern_.points.end() && distance >= least) continue;
            best = p;
            least = distance;
        }
        if (best == pattern_.points.end()) return false;
        pattern_.points.erase(best);
        return true;
    }

    // From triangle to neighbour, by the distance of centres along the way.
    void add(const Change& change) {
        std::set<Index> taken, done;
        for (const ImposedPoint& point : pattern_.points) taken.insert(point.triangle);
        using Entry = std::pair<double, Index>;
        std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
        front.push({0, triangle_at_[change.vertex]});
        Index found = -1;
        while (!front.empty()) {
            const auto [distance, t] = front.top();
            front.pop();
            if (!done.insert(t).second) continue;
            bool room = false;
            for (int k = 0; k < 3; ++k) room |= inside_[domain_.mesh().triangles(t, k)];
            if (!taken.contains(t) && (found < 0 || room)) found = t;
            if (found == t && room) break;
            for (int k = 0; k < 3; ++k) {
                const auto beside = domain_.topology().edge_triangles.row(domain_.topology().triangle_edges(t, k));
                const Index next = beside[0] == t ? beside[1] : beside[0];
                if (next >= 0) front.push({distance + (centre(next) - centre(t)).norm(), next});
            }
        }
        if (found < 0)
            throw GeometryError("the face with the corner at vertex " + std::to_string(change.vertex) +
                                    " has no triangle without a singular point left; refine it",
                                "no_room", {change.vertex});
        pattern_.points.push_back({found, Eigen::Vector3d::Constant(1.0 / 3), change.turn});
    }

    const SurfaceDomain& domain_;
    SingularPattern& pattern_;
    std::vector<bool> inside_;
    std::vector<Index> triangle_at_, part_of_;
};

}  // namespace

SingularPattern with_corner_quads(const SurfaceDomain& domain, SingularPattern pattern,
                                  const std::vector<CornerQuads>& corners) {
    Mover mover(domain, pattern);
    mover.require_boundary(corners);
    mover.require_boundary(pattern.corners);
    std::map<Index, int> had, wanted;  // quads more than 2
    for (const CornerQuads& c : default_corner_quads(domain)) had[c.vertex] = wanted[c.vertex] = c.quads - 2;
    for (const CornerQuads& c : pattern.corners) had[c.vertex] = c.quads - 2;
    for (auto& [vertex, quads] : wanted) quads = 0;
    for (const CornerQuads& c : corners) wanted[c.vertex] = c.quads - 2;
    std::vector<Change> changes;
    std::vector<CornerQuads> all;
    for (const auto& [vertex, quads] : had) wanted.emplace(vertex, 0);
    for (const auto& [vertex, quads] : wanted) {
        const int more = quads - (had.contains(vertex) ? had[vertex] : 0);
        for (int i = 0; i < std::abs(more); ++i) changes.push_back({vertex, more > 0 ? 1 : -1});
        all.push_back({vertex, quads + 2});
    }
    pattern.corners = std::move(all);
    mover.make_good(std::move(changes));
    return pattern;
}

std::vector<CornerQuads> finite_corner_quads(const SurfaceDomain& domain, const SingularPattern& pattern) {
    std::map<Index, int> by_angle, quads;
    for (const CornerQuads& c : default_corner_quads(domain)) quads[c.vertex] = by_angle[c.vertex] = c.quads;
    for (const CornerQuads& c : pattern.corners) quads[c.vertex] = c.quads;
    const auto angle_quads = [&](Index v) { return by_angle.contains(v) ? by_angle[v] : 2; };
    const double reach = 4 * domain.mean_edge_length();
    for (auto& [vertex, count] : quads) {
        for (; count < 1; ++count) {
            Index nearest = -1;
            double least = reach;
            for (const auto& [other, more] : quads) {
                const double distance = (domain.mesh().vertices.row(other) - domain.mesh().vertices.row(vertex)).norm();
                if (more <= angle_quads(other) || other == vertex || distance >= least) continue;
                nearest = other;
                least = distance;
            }
            if (nearest >= 0) --quads[nearest];
        }
    }
    std::vector<CornerQuads> result;
    for (const auto& [vertex, count] : quads) result.push_back({vertex, count});
    return result;
}

}  // namespace octafield::surface
