#include "triangle_pairs.hpp"

#include <algorithm>
#include <deque>

#include "octafield/disjoint_sets.hpp"

namespace octafield::surface::detail {
namespace {

constexpr double worst_pair = 0.9;  // deviation of the angles of two triangles that are joined

// A side between two wanted triangles that no segment is on.
struct Door {
    Index t;
    int k;
    Index other;
    double cost;
};

class Joining {
public:
    Joining(const PlaneTriangulation& made, const std::vector<char>& wanted, PlaneQuads& vertices)
        : made_(made), wanted_(wanted), vertices_(vertices) {
        for (Index t = 0; t < made.triangles.rows(); ++t)
            for (int k = 0; wanted[t] && k < 3; ++k) {
                const Index other = made.neighbours(t, k);
                if (other > t && wanted[other] && made.segments(t, k) < 0) doors_.push_back({t, k, other, 0});
            }
        pair();
        link();
    }

    std::vector<std::vector<Index>> polygons() const {
        std::vector<std::vector<Index>> result;
        for (Index t = 0; t < made_.triangles.rows(); ++t) {
            if (!wanted_[t] || (mate_[t] >= 0 && mate_[t] < t)) continue;
            std::vector<Index> polygon;
            if (mate_[t] < 0) {
                for (int k = 0; k < 3; ++k) add_side(t, k, polygon);
            } else {
                const Index other = mate_[t];
                const int door = side_to(t, other), back = side_to(other, t);
                for (int i = 1; i < 3; ++i) add_side(t, (door + i) % 3, polygon);
                for (int i = 1; i < 3; ++i) add_side(other, (back + i) % 3, polygon);
            }
            result.push_back(std::move(polygon));
        }
        return result;
    }

private:
    const PlaneTriangulation& made_;
    const std::vector<char>& wanted_;
    PlaneQuads& vertices_;
    std::vector<Door> doors_;
    std::vector<Index> mate_;                           // -1: none
    std::unordered_map<std::uint64_t, Index> middles_;  // of split sides

    int side_to(Index t, Index other) const {
        int k = 0;
        while (made_.neighbours(t, k) != other) ++k;
        return k;
    }
    std::array<Index, 2> ends(Index t, int k) const {
        return {made_.triangles(t, (k + 1) % 3), made_.triangles(t, (k + 2) % 3)};
    }
    void add_side(Index t, int k, std::vector<Index>& polygon) const {
        const auto [a, b] = ends(t, k);
        polygon.push_back(a);
        const auto middle = middles_.find(edge_key(a, b));
        if (middle != middles_.end()) polygon.push_back(middle->second);
    }

    // The best first.
    void pair() {
        mate_.assign(made_.triangles.rows(), -1);
        std::vector<Door> good;
        for (Door door : doors_) {
            const auto [a, b] = ends(door.t, door.k);
            const Index c = made_.triangles(door.t, door.k);
            const Index d = made_.triangles(door.other, side_to(door.other, door.t));
            const std::array<Vector2, 4> corners{vertices_.point(a), vertices_.point(d), vertices_.point(b),
                                                 vertices_.point(c)};
            if (deviation(corners) > worst_pair) continue;
            door.cost = quad_cost(corners);
            good.push_back(door);
        }
        std::stable_sort(good.begin(), good.end(), [](const Door& a, const Door& b) { return a.cost < b.cost; });
        for (const Door& door : good)
            if (mate_[door.t] < 0 && mate_[door.other] < 0) {
                mate_[door.t] = door.other;
                mate_[door.other] = door.t;
            }
    }

    // Short paths: a tree of steps away from the triangles that are left, and then the shortest ways between two of
    // these trees. On the whole forest each step is split that has an odd number of such triangles beyond it.
    void link() {
        const Index count = static_cast<Index>(mate_.size());
        const auto piece = [&](Index t) { return mate_[t] >= 0 ? std::min(t, mate_[t]) : t; };
        std::vector<std::vector<Index>> round(count);  // doors of each piece
        for (Index d = 0; d < static_cast<Index>(doors_.size()); ++d) {
            const Index a = piece(doors_[d].t), b = piece(doors_[d].other);
            if (a == b) continue;
            round[a].push_back(d);
            round[b].push_back(d);
        }
        std::vector<int> steps(count, -1);
        std::deque<Index> open;
        for (Index t = 0; t < count; ++t)
            if (wanted_[t] && mate_[t] < 0) {
                steps[t] = 0;
                open.push_back(t);
            }
        const auto across = [&](Index d, Index from) {
            const Index a = piece(doors_[d].t);
            return a == from ? piece(doors_[d].other) : a;
        };
        DisjointSets sets(count);
        std::vector<std::vector<Index>> tree(count);
        const auto grow = [&](Index d) {
            const Index a = piece(doors_[d].t), b = piece(doors_[d].other);
            sets.join(a, b);
            tree[a].push_back(d);
            tree[b].push_back(d);
        };
        for (; !open.empty(); open.pop_front())
            for (const Index d : round[open.front()]) {
                const Index next = across(d, open.front());
                if (steps[next] >= 0) continue;
                steps[next] = steps[open.front()] + 1;
                open.push_back(next);
                grow(d);
            }
        std::vector<Index> order;
        for (Index d = 0; d < static_cast<Index>(doors_.size()); ++d)
            if (steps[piece(doors_[d].t)] >= 0) order.push_back(d);
        const auto length = [&](Index d) { return steps[piece(doors_[d].t)] + steps[piece(doors_[d].other)]; };
        std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return length(a) < length(b); });
        for (const Index d : order)
            if (sets.lowest(piece(doors_[d].t)) != sets.lowest(piece(doors_[d].other))) grow(d);
        split_odd(tree, piece, across);
    }

    template <class Piece, class Across>
    void split_odd(const std::vector<std::vector<Index>>& tree, const Piece& piece, const Across& across) {
        const Index count = static_cast<Index>(mate_.size());
        std::vector<char> odd(count, false), seen(count, false);
        std::vector<Index> way(count, -1);
        for (Index root = 0; root < count; ++root) {
            if (!wanted_[root] || piece(root) != root || seen[root]) continue;
            std::vector<Index> order{root};
            seen[root] = true;
            for (std::size_t at = 0; at < order.size(); ++at) {
                odd[order[at]] = mate_[order[at]] < 0;
                for (const Index d : tree[order[at]]) {
                    const Index next = across(d, order[at]);
                    if (seen[next]) continue;
                    seen[next] = true;
                    way[next] = d;
                    order.push_back(next);
                }
            }
            for (std::size_t at = order.size(); at-- > 1;) {
                if (!odd[order[at]]) continue;
                const Index d = way[order[at]], up = across(d, order[at]);
                odd[up] = !odd[up];
                const auto [a, b] = ends(doors_[d].t, doors_[d].k);
                middles_[edge_key(a, b)] =
                    vertices_.add_vertex((vertices_.point(a) + vertices_.point(b)) / 2, Hold::free);
            }
        }
    }
};

}  // namespace

std::vector<std::vector<Index>> even_polygons(const PlaneTriangulation& made, const std::vector<char>& wanted,
                                              PlaneQuads& vertices) {
    return Joining(made, wanted, vertices).polygons();
}

}  // namespace octafield::surface::detail
