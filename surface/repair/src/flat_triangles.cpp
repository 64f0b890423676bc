#include "flat_triangles.hpp"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "half_edges.hpp"
#include "triangle_tests.hpp"

namespace octafield::surface {
namespace {

class Flattening {
public:
    explicit Flattening(TriangleMesh& mesh) : mesh_(mesh), dropped_(mesh.triangles.rows(), false) {}

    std::size_t run() {
        if (!list_flat_triangles()) return 0;
        for_each_edge(sorted_half_edges(mesh_.triangles), [&](auto first, auto last) {
            for (auto side = first; side != last; ++side) edges_[{side->low, side->high}].push_back(side->triangle);
        });
        std::size_t treated = 0;
        // A treatment can free triangles elsewhere that were held up by the edge it removed: hence the further rounds.
        for (std::size_t before = 0; list_flat_triangles(); before = treated) {
            while (!waiting_.empty()) {
                const Index t = waiting_.back();
                waiting_.pop_back();
                if (!dropped_[t] && is_degenerate(mesh_, t)) treated += treat(t);
            }
            if (treated == before) break;
        }
        drop();
        return treated;
    }

private:
    bool list_flat_triangles() {
        if (flat_.empty()) {
            for (Index t = 0; t < mesh_.triangles.rows(); ++t)
                if (is_degenerate(mesh_, t)) flat_.push_back(t);
        } else {
            // Flips only make flat triangles of flat ones and their neighbours, which are listed when they are made.
            std::ranges::sort(flat_);
            flat_.erase(std::unique(flat_.begin(), flat_.end()), flat_.end());
            std::erase_if(flat_, [&](Index t) { return dropped_[t] || !is_degenerate(mesh_, t); });
        }
        waiting_.assign(flat_.rbegin(), flat_.rend());
        return !flat_.empty();
    }

    Index corner(Index t, int k) const { return mesh_.triangles(t, k % 3); }
    bool coincide(Index a, Index b) const { return mesh_.vertices.row(a) == mesh_.vertices.row(b); }
    std::vector<Index>& sides(Index a, Index b) { return edges_.at(std::minmax(a, b)); }

    // The corner opposite the longest side: the one between the two others.
    int middle_corner(Index t) const {
        int longest = 0;
        double most = -1;
        for (int k = 0; k < 3; ++k) {
            const double length = (mesh_.vertices.row(corner(t, k)) - mesh_.vertices.row(corner(t, k + 1))).norm();
            if (length > most) most = length, longest = k;
        }
        return (longest + 2) % 3;
    }

    bool treat(Index t) {
        const int k = middle_corner(t);
        const Index b = corner(t, k), c = corner(t, k + 1), a = corner(t, k + 2);
        const std::vector<Index> at_longest = sides(a, c);
        if (at_longest.size() > 2 || coincide(a, b) || coincide(b, c)) return false;
        if (at_longest.size() == 1) {
            detach(t);
            dropped_[t] = true;
        } else if (!flip(t, at_longest[0] == t ? at_longest[1] : at_longest[0], a, b, c)) {
            return false;
        }
        for (const auto& [p, q] : {std::pair(a, b), std::pair(b, c)}) queue_beside(p, q);
        return true;
    }

    // Triangles a b c and c a d become a b d and b c d.
    bool flip(Index t, Index beyond, Index a, Index b, Index c) {
        int j = 0;
        while (corner(beyond, j) == a || corner(beyond, j) == c) ++j;
        const Index d = corner(beyond, j);
        // Of two flat triangles on one line the one with the longest side of all goes first; so each flip shortens an
        // edge.
        if (is_degenerate(mesh_, beyond) && middle_corner(beyond) != j) return false;
        const bool oriented_alike = corner(beyond, j + 1) == a;
        if (!oriented_alike || b == d || edges_.contains(std::minmax(b, d))) return false;
        detach(t);
        detach(beyond);
        mesh_.triangles.row(t) << a, b, d;
        mesh_.triangles.row(beyond) << b, c, d;
        attach(t);
        attach(beyond);
        queue_beside(b, d);
        queue_beside(a, d);
        queue_beside(c, d);
        return true;
    }

    void detach(Index t) {
        for (int k = 0; k < 3; ++k) {
            const auto place = edges_.find(std::minmax(corner(t, k), corner(t, k + 1)));
            std::erase(place->second, t);
            if (place->second.empty()) edges_.erase(place);
        }
    }

    void attach(Index t) {
        for (int k = 0; k < 3; ++k) edges_[std::minmax(corner(t, k), corner(t, k + 1))].push_back(t);
    }

    void queue_beside(Index a, Index b) {
        const auto place = edges_.find(std::minmax(a, b));
        if (place == edges_.end()) return;
        for (const Index t : place->second) {
            if (!is_degenerate(mesh_, t)) continue;
            flat_.push_back(t);
            waiting_.push_back(t);
        }
    }

    void drop() {
        Index kept = 0;
        for (Index t = 0; t < mesh_.triangles.rows(); ++t)
            if (!dropped_[t]) mesh_.triangles.row(kept++) = mesh_.triangles.row(t).eval();
        mesh_.triangles.conservativeResize(kept, 3);
    }

    TriangleMesh& mesh_;
    std::vector<bool> dropped_;
    std::vector<Index> flat_, waiting_;                            // waiting: a stack
    std::map<std::pair<Index, Index>, std::vector<Index>> edges_;  // the triangles at each
};

}  // namespace

std::size_t flip_flat_triangles(TriangleMesh& mesh) { return Flattening(mesh).run(); }

}  // namespace octafield::surface
