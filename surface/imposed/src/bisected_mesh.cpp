#include "bisected_mesh.hpp"

#include <algorithm>

namespace octafield::surface::detail {
namespace {

constexpr double snap = 1e-4;

// (E) without the edges of the boundary that are features only as such. Both lists are in lexicographic order.
std::vector<bool> listed_features(const SurfaceDomain& domain) {
    const Edges &features = domain.features().edges, &edges = domain.topology().edges;
    std::vector<bool> result(edges.rows());
    Index next = 0;
    for (Index e = 0; e < edges.rows(); ++e) {
        result[e] = next < features.rows() && features.row(next) == edges.row(e);
        if (result[e]) ++next;
    }
    return result;
}

}  // namespace

Place snapped(Place place) {
    for (int k = 0; k < 3; ++k)
        if (place.weights[k] < snap) place.weights[k] = 0;
    place.weights /= place.weights.sum();
    return place;
}

BisectedMesh::BisectedMesh(const SurfaceDomain& domain, std::vector<Place> places) : places_(std::move(places)) {
    const TriangleMesh& mesh = domain.mesh();
    const EdgeTopology& topology = domain.topology();
    for (Index v = 0; v < domain.vertex_count(); ++v) positions_.emplace_back(mesh.vertices.row(v));
    const std::vector<bool> listed = listed_features(domain);
    triangles_.resize(domain.triangle_count());
    for (Index t = 0; t < domain.triangle_count(); ++t) {
        Triangle& triangle = triangles_[t];
        triangle.origin = t;
        for (int k = 0; k < 3; ++k) {
            const Index edge = topology.triangle_edges(t, k);
            triangle.corners[k] = mesh.triangles(t, k);
            triangle.neighbours[k] = topology.edge_triangles(edge, topology.edge_triangles(edge, 0) == t ? 1 : 0);
            triangle.is_feature[k] = listed[edge];
            triangle.weights[k] = Vector::Unit(k);
        }
    }
    for (Place& place : places_) place = snapped(place);
}

Vector BisectedMesh::position(const Place& place) const {
    return place.weights[0] * corner(place.triangle, 0) + place.weights[1] * corner(place.triangle, 1) +
           place.weights[2] * corner(place.triangle, 2);
}

// The neighbour's id alone does not tell: two triangles may share two sides.
int BisectedMesh::side_to(Index t, Index neighbour, Index from) const {
    for (int k = 0; k < 3; ++k)
        if (triangles_[t].neighbours[k] == neighbour && triangles_[t].corners[k] == from) return k;
    return -1;
}

// Ties go by vertex ids, alike from both sides.
int BisectedMesh::longest_side(Index t) const {
    const auto& corners = triangles_[t].corners;
    const auto key = [&](int k) { return std::pair(length(t, k), std::minmax(corners[k], corners[(k + 1) % 3])); };
    int best = 0;
    for (int k = 1; k < 3; ++k) {
        const auto [length, ends] = key(k);
        const auto [best_length, best_ends] = key(best);
        if (length > best_length || (length == best_length && ends > best_ends)) best = k;
    }
    return best;
}

void BisectedMesh::bisect(Index t) {
    int k = longest_side(t);
    Index other = triangles_[t].neighbours[k];
    while (other >= 0) {  // edges grow, so the path ends
        const int across = side_to(other, t, triangles_[t].corners[(k + 1) % 3]), next = longest_side(other);
        if (across == next) break;
        t = other;
        k = next;
        other = triangles_[t].neighbours[k];
    }
    const Index a = triangles_[t].corners[k], b = triangles_[t].corners[(k + 1) % 3];
    const int across = other >= 0 ? side_to(other, t, b) : -1;
    const Index middle = static_cast<Index>(positions_.size()), half = static_cast<Index>(triangles_.size());
    positions_.push_back((positions_[a] + positions_[b]) / 2);
    split_side(t, k, middle, half);  // t has a, `half` has b
    if (other < 0) return;
    split_side(other, across, middle, half + 1);  // `other` has b, `half + 1` has a
    const auto join = [&](Index x, Index y) {
        triangles_[x].neighbours[0] = y;
        triangles_[y].neighbours[0] = x;
    };
    join(half, other);
    join(t, half + 1);
}

// Triangle t with side k from a to b, c opposite, becomes (a, m, c), and `half` (m, b, c); side 0 is the half side.
void BisectedMesh::split_side(Index t, int k, Index middle, Index half) {
    move_places(t, k, half);
    const Triangle old = triangles_[t];
    const int k1 = (k + 1) % 3, k2 = (k + 2) % 3;
    const Vector weights = (old.weights[k] + old.weights[k1]) / 2;
    triangles_[t] = {{old.corners[k], middle, old.corners[k2]},
                     {-1, half, old.neighbours[k2]},
                     {old.is_feature[k], false, old.is_feature[k2]},
                     old.origin,
                     {old.weights[k], weights, old.weights[k2]}};
    triangles_.push_back({{middle, old.corners[k1], old.corners[k2]},
                          {-1, old.neighbours[k1], t},
                          {old.is_feature[k], old.is_feature[k1], false},
                          old.origin,
                          {weights, old.weights[k1], old.weights[k2]}});
    if (const Index beyond = old.neighbours[k1]; beyond >= 0)
        triangles_[beyond].neighbours[side_to(beyond, t, old.corners[k2])] = half;
}

void BisectedMesh::move_places(Index t, int k, Index half) {
    for (Place& place : places_) {
        if (place.triangle != t) continue;
        const double a = place.weights[k], b = place.weights[(k + 1) % 3], c = place.weights[(k + 2) % 3];
        place = snapped(a >= b ? Place{t, Vector(a - b, 2 * b, c)} : Place{half, Vector(2 * a, b - a, c)});
    }
}

}  // namespace octafield::surface::detail
