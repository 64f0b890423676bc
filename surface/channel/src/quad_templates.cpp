#include "octafield/surface/quad_templates.hpp"

#include <algorithm>
#include <deque>
#include <map>
#include <mutex>
#include <set>

#include "octafield/error.hpp"
#include "placed_quads.hpp"

namespace octafield::surface {
namespace {

using Polygon = std::vector<int>;
using Quad = std::array<int, 4>;
using Quads = std::vector<Quad>;

std::pair<int, int> edge(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

// Calls `use` for each side of each quad, in their order.
template <class Use>
void each_side(const Quads& quads, const Use& use) {
    for (int q = 0; q < static_cast<int>(quads.size()); ++q)
        for (int k = 0; k < 4; ++k) use(quads[q][k], quads[q][(k + 1) % 4], q, k);
}

// Every quad that can lie at the first side of an open polygon is tried in turn, and what it leaves open goes on.
class Search {
public:
    Search(int sides, int interior) : sides_(sides), interior_(interior) {
        Polygon outline(sides);
        for (int i = 0; i < sides; ++i) {
            outline[i] = i;
            edges_.insert(edge(i, (i + 1) % sides));
        }
        fill({outline}, 0);
    }
    std::vector<QuadTemplate> found() const {
        std::vector<QuadTemplate> result;
        for (const Quads& quads : found_) result.push_back({sides_, interior_, quads});
        return result;
    }

private:
    int sides_, interior_;
    Quads quads_;
    std::set<std::pair<int, int>> edges_;
    std::set<Quads> found_;

    void fill(std::vector<Polygon> open, int used) {
        if (open.empty()) {
            if (used == interior_ && sound()) found_.insert(canonical());
            return;
        }
        const Polygon polygon = open.back();
        open.pop_back();
        const int n = static_cast<int>(polygon.size());
        const int fresh = sides_ + used;
        for (int i = 2; i < n; ++i)
            for (int j = i + 1; j < n; ++j) place(open, polygon, i, j, polygon[i], polygon[j], used);
        if (used < interior_)
            for (int i = 2; i < n; ++i) {
                place(open, polygon, i, n, polygon[i], fresh, used + 1);
                place(open, polygon, 1, i, fresh, polygon[i], used + 1);
            }
        if (used + 1 < interior_) place(open, polygon, 1, n, fresh, fresh + 1, used + 2);
    }

    // The quad polygon[0], polygon[1], c, d. What is left: from polygon[1] to [i] and c, and from polygon[j] to [0] and
    // d; where c and d are vertices i and j of the polygon also what lies between them.
    void place(std::vector<Polygon> open, const Polygon& p, int i, int j, int c, int d, int used) {
        const int n = static_cast<int>(p.size());
        std::vector<Polygon> parts;
        const bool old_c = i > 1, old_d = j < n;
        if (old_c && old_d) {
            parts = {part(p, 1, i), part(p, i, j), part(p, j, n)};
        } else if (old_c) {  // round the new d
            Polygon rest = part(p, i, n);
            rest.push_back(d);
            parts = {part(p, 1, i), rest};
        } else if (old_d) {
            Polygon rest = part(p, 1, j);
            rest.push_back(c);
            parts = {rest, part(p, j, n)};
        } else {
            Polygon rest = part(p, 1, n);
            rest.push_back(d);
            rest.push_back(c);
            parts = {rest};
        }
        for (Polygon& each : parts) {
            if (each.size() % 2) return;
            if (each.size() > 2) open.push_back(std::move(each));
        }
        const Quad quad{p[0], p[1], c, d};
        std::vector<std::pair<int, int>> added;
        bool simple = true;
        for (int k = 1; k < 4 && simple; ++k) {
            const bool side_of_polygon =
                (k == 1 && i == 2) || (k == 2 && old_c && old_d && j == i + 1) || (k == 3 && j == n - 1);
            if (side_of_polygon) continue;
            const auto here = edge(quad[k], quad[(k + 1) % 4]);
            simple = edges_.insert(here).second;
            if (simple) added.push_back(here);
        }
        if (simple) {
            quads_.push_back(quad);
            fill(std::move(open), used);
            quads_.pop_back();
        }
        for (const auto& each : added) edges_.erase(each);
    }

    // Vertices from..to of the polygon; `to` may be its size, for vertex 0.
    static Polygon part(const Polygon& p, int from, int to) {
        Polygon result;
        for (int k = from; k <= to; ++k) result.push_back(p[k % static_cast<int>(p.size())]);
        return result;
    }

    bool sound() const {
        std::vector<int> degree(sides_ + interior_, 0);
        for (const auto& [a, b] : edges_) ++degree[a], ++degree[b];
        if (std::any_of(degree.begin() + sides_, degree.end(), [](int d) { return d < 3; })) return false;
        std::map<std::pair<int, int>, int> quad_of;
        std::set<std::pair<int, int>> neighbours;
        bool once = true;
        each_side(quads_, [&](int a, int b, int q, int) { quad_of[{a, b}] = q; });
        each_side(quads_, [&](int a, int b, int q, int) {
            const auto other = quad_of.find({b, a});
            if (other != quad_of.end()) once = once && neighbours.insert({q, other->second}).second;
        });
        return once;
    }

    Quads canonical() const {
        Quads least;
        for (int shift = 0; shift < sides_; ++shift)
            for (const bool mirrored : {false, true}) {
                Quads quads = detail::placed_quads({sides_, interior_, quads_}, shift, mirrored);
                if (least.empty() || quads < least) least = std::move(quads);
            }
        return least;
    }
};

}  // namespace

namespace detail {

Quads placed_quads(const QuadTemplate& given, int shift, bool mirrored) {
    const int sides = given.sides;
    Quads quads = given.quads;
    for (Quad& quad : quads) {
        for (int& v : quad)
            if (v < sides) v = mirrored ? (2 * sides - v - shift) % sides : (v + shift) % sides;
        if (mirrored) std::reverse(quad.begin(), quad.end());
    }
    std::map<std::pair<int, int>, std::pair<int, int>> place;
    each_side(quads, [&](int a, int b, int q, int k) { place[{a, b}] = {q, k}; });
    std::vector<int> name(sides + given.interior, -1);
    for (int v = 0; v < sides; ++v) name[v] = v;
    int next = sides;
    Quads result;
    std::vector<bool> seen(quads.size(), false);
    std::deque<std::pair<int, int>> open{{0, 1}};
    for (; !open.empty(); open.pop_front()) {
        const auto found = place.find(open.front());
        if (found == place.end() || seen[found->second.first]) continue;
        const auto [q, k] = found->second;
        seen[q] = true;
        Quad quad;
        for (int i = 0; i < 4; ++i) {
            int& as = name[quads[q][(k + i) % 4]];
            if (as < 0) as = next++;
            quad[i] = as;
            open.push_back({quads[q][(k + i + 1) % 4], quads[q][(k + i) % 4]});
        }
        std::rotate(quad.begin(), std::min_element(quad.begin(), quad.end()), quad.end());
        result.push_back(quad);
    }
    return result;
}

}  // namespace detail

const std::vector<QuadTemplate>& quad_templates(int sides, int interior) {
    if (sides % 2 || sides < 4 || sides > 10 || interior < 0 || interior > 4)
        throw InvalidInput("templates are of 4, 6, 8 or 10 sides with 0 to 4 vertices inside", "bad_template");
    static std::mutex mutex;
    static std::map<std::pair<int, int>, std::vector<QuadTemplate>> made;
    const std::lock_guard lock(mutex);
    const auto [at, added] = made.try_emplace({sides, interior});
    if (added) at->second = Search(sides, interior).found();
    return at->second;
}

}  // namespace octafield::surface
