#include "plane_quads.hpp"

namespace octafield::surface::detail {

Index PlaneQuads::add_vertex(const Vector2& at, Hold hold) {
    points_.push_back(at);
    hold_.push_back(hold);
    round_.emplace_back();
    return vertex_count() - 1;
}

Index PlaneQuads::add_quad(const Quad& quad, bool kept) {
    const Index q = quad_slots();
    quads_.push_back(quad);
    alive_.push_back(true);
    kept_.push_back(kept);
    for (int k = 0; k < 4; ++k) {
        sides_[key(quad[k], quad[(k + 1) % 4])] = q;
        round_[quad[k]].push_back(q);
    }
    return q;
}

void PlaneQuads::remove_quad(Index q) {
    alive_[q] = false;
    for (int k = 0; k < 4; ++k) {
        sides_.erase(key(quads_[q][k], quads_[q][(k + 1) % 4]));
        std::erase(round_[quads_[q][k]], q);
    }
}

Index PlaneQuads::quad_at(Index a, Index b) const {
    const auto found = sides_.find(key(a, b));
    return found == sides_.end() ? -1 : found->second;
}

Index PlaneQuads::neighbour(Index q, int k) const {
    const Index a = quads_[q][k], b = quads_[q][(k + 1) % 4];
    return locked(a, b) ? -1 : quad_at(b, a);
}

std::array<Vector2, 4> PlaneQuads::corners(Index q) const {
    const Quad& quad = quads_[q];
    return {points_[quad[0]], points_[quad[1]], points_[quad[2]], points_[quad[3]]};
}

double PlaneQuads::cost(Index q) const { return quad_cost(corners(q)); }

double PlaneQuads::cost_round(Index v) const {
    double sum = 0;
    for (const Index q : round_[v]) sum += cost(q);
    return sum;
}

}  // namespace octafield::surface::detail
