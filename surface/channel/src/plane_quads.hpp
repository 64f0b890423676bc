// Plane quads while they are exchanged for others.
#pragma once

#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "octafield/arrays.hpp"
#include "quad_shape.hpp"

namespace octafield::surface::detail {

using Quad = std::array<Index, 4>;

// (lower id, higher id) or a directed edge, as one number.
inline std::uint64_t key(Index a, Index b) {
    return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(a)) << 32) | static_cast<std::uint32_t>(b);
}
inline std::uint64_t edge_key(Index a, Index b) { return key(std::min(a, b), std::max(a, b)); }

enum class Hold : char {
    free,    // may move, and go
    inside,  // of the mesh inside: may move
    fixed,   // of the outline
};

class PlaneQuads {
public:
    Index add_vertex(const Vector2& at, Hold hold);
    // A quad that is `kept` is never exchanged.
    Index add_quad(const Quad& quad, bool kept);
    void remove_quad(Index q);
    // Quads meet here without being neighbours: a segment of the outline.
    void lock(Index a, Index b) { locked_.insert(edge_key(a, b)); }
    bool locked(Index a, Index b) const { return locked_.contains(edge_key(a, b)); }

    Index vertex_count() const { return static_cast<Index>(points_.size()); }
    Index quad_slots() const { return static_cast<Index>(quads_.size()); }  // removed ones are among them
    bool alive(Index q) const { return alive_[q]; }
    bool kept(Index q) const { return kept_[q]; }
    Hold hold(Index v) const { return hold_[v]; }
    const Quad& quad(Index q) const { return quads_[q]; }
    const Vector2& point(Index v) const { return points_[v]; }
    void move(Index v, const Vector2& to) { points_[v] = to; }
    const std::vector<Index>& quads_round(Index v) const { return round_[v]; }

    // The quad with this directed edge, -1: none.
    Index quad_at(Index a, Index b) const;
    // Across side k, unless the outline is there; -1: none.
    Index neighbour(Index q, int k) const;
    bool has_edge(Index a, Index b) const { return quad_at(a, b) >= 0 || quad_at(b, a) >= 0; }

    double cost(Index q) const;
    // Of the quads round a vertex.
    double cost_round(Index v) const;
    std::array<Vector2, 4> corners(Index q) const;

private:
    std::vector<Vector2> points_;
    std::vector<Hold> hold_;
    std::vector<std::vector<Index>> round_;
    std::vector<Quad> quads_;
    std::vector<char> alive_, kept_;
    std::unordered_map<std::uint64_t, Index> sides_;
    std::unordered_set<std::uint64_t> locked_;
};

}  // namespace octafield::surface::detail
