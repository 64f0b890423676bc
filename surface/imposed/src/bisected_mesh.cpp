#include "bisected_mesh.hpp"

#include <algorithm>
#include <string>

#include "octafield/error.hpp"

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

BisectedMesh::BisectedMesh(const SurfaceDomain& domain, std::vector<Place> places) : waiting_(std::move(places)) {
    const TriangleMesh& mesh = domain.mesh();
    const EdgeTopology& topology = domain.topology();
    for (Index v = 0; v < domain.vertex_count(); ++v) positions_.emplace_back(mesh.vertices.row(v));
    triangle_at_.assign(positions_.size(), -1);
    is_centre_.assign(positions_.size(), false);
    const std::vector<bool> listed = listed_features(domain);
    if (domain.has_own_lengths()) {
        const Charts charts(domain);
        for (Index t = 0; t < domain.triangle_count(); ++t) shapes_.push_back(charts.corners(t));
    }
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
            triangle_at_[triangle.corners[k]] = t;
        }
    }
    for (std::size_t i = 0; i < waiting_.size(); ++i) insert(snapped(waiting_[i]));
    waiting_.clear();
}

void BisectedMesh::insert(const Place& place) {
    const auto inserted = static_cast<Index>(centres_.size());
    const auto zeros = (place.weights.array() == 0).count();
    int zero = 0, most = 0;
    place.weights.minCoeff(&zero);
    place.weights.maxCoeff(&most);
    waiting_[inserted].triangle = -1;
    Index centre = static_cast<Index>(positions_.size());
    if (zeros == 2) {
        centre = triangles_[place.triangle].corners[most];
    } else if (zeros == 1) {
        split_edge(place.triangle, (zero + 1) % 3, place.weights[(zero + 2) % 3]);
    } else {
        split_inside(place.triangle, place.weights);
    }
    const auto other = std::find(centres_.begin(), centres_.end(), centre);
    if (other != centres_.end())
        throw InvalidInput("singular points " + std::to_string(other - centres_.begin()) + " and " +
                               std::to_string(inserted) + " are in the same place; merge them into one",
                           "coincident_points", {static_cast<Index>(other - centres_.begin()), inserted});
    centres_.push_back(centre);
    is_centre_[centre] = true;
}

// The neighbour's id alone does not tell: two triangles may share two sides.
int BisectedMesh::side_to(Index t, Index neighbour, Index from) const {
    for (int k = 0; k < 3; ++k)
        if (triangles_[t].neighbours[k] == neighbour && triangles_[t].corners[k] == from) return k;
    return -1;
}

Vector BisectedMesh::corner(Index t, int k) const {
    k %= 3;
    const Triangle& triangle = triangles_[t];
    if (shapes_.empty()) return positions_[triangle.corners[k]];
    const auto& shape = shapes_[triangle.origin];
    const Vector& w = triangle.weights[k];
    const Complex z = w[0] * shape[0] + w[1] * shape[1] + w[2] * shape[2];
    return {z.real(), z.imag(), 0};
}

double BisectedMesh::length(Index t, int k) const {
    if (const Index beside = triangles_[t].neighbours[k]; !shapes_.empty() && beside >= 0 && beside < t)
        return length(beside, side_to(beside, t, triangles_[t].corners[(k + 1) % 3]));
    return (corner(t, k + 1) - corner(t, k)).norm();
}

// Ties go by vertex ids, alike from both sides.
int BisectedMesh::longest_side(Index t) const {
    const auto& corners = triangles_[t].corners;
    int best = 0;
    double most = -1;
    std::pair<Index, Index> best_ends;
    for (int k = 0; k < 3; ++k) {
        const double here = length(t, k);
        const std::pair<Index, Index> ends = std::minmax(corners[k], corners[(k + 1) % 3]);
        if (here < most || (here == most && ends < best_ends)) continue;
        best = k;
        most = here;
        best_ends = ends;
    }
    return best;
}

bool BisectedMesh::at_centre(Index t) const {
    return std::any_of(triangles_[t].corners.begin(), triangles_[t].corners.end(),
                       [&](Index v) { return is_centre_[v]; });
}

int BisectedMesh::bisected_side(Index t, bool keep_spokes) const {
    for (int k = 0; keep_spokes && k < 3; ++k)
        if (is_centre_[triangles_[t].corners[k]]) return (k + 1) % 3;
    return longest_side(t);
}

void BisectedMesh::bisect(Index t, bool keep_spokes) {
    for (bool done = false; !done;) {
        Index at = t;
        int k = bisected_side(at, keep_spokes);
        Index other = triangles_[at].neighbours[k];
        while (other >= 0) {  // edges grow, so the path ends
            const int across = side_to(other, at, triangles_[at].corners[(k + 1) % 3]),
                      next = bisected_side(other, keep_spokes);
            if (across == next) break;
            at = other;
            k = next;
            other = triangles_[at].neighbours[k];
        }
        done = at == t || other == t;
        split_edge(at, k, 0.5);
    }
}

Index BisectedMesh::add_vertex(Index t, const Vector& weights) {
    const auto& corners = triangles_[t].corners;
    positions_.push_back(weights[0] * positions_[corners[0]] + weights[1] * positions_[corners[1]] +
                         weights[2] * positions_[corners[2]]);
    triangle_at_.push_back(t);
    is_centre_.push_back(false);
    return static_cast<Index>(positions_.size() - 1);
}

void BisectedMesh::split_edge(Index t, int k, double fraction) {
    const Index b = triangles_[t].corners[(k + 1) % 3], other = triangles_[t].neighbours[k];
    const int across = other >= 0 ? side_to(other, t, b) : -1;
    const Index vertex = add_vertex(t, (1 - fraction) * Vector::Unit(k) + fraction * Vector::Unit((k + 1) % 3));
    const Index half = static_cast<Index>(triangles_.size());
    split_side(t, k, fraction, vertex, half);  // t has the first corner, `half` has b
    if (other < 0) return;
    split_side(other, across, 1 - fraction, vertex, half + 1);  // `other` has b, `half + 1` the first corner
    const auto join = [&](Index x, Index y) {
        triangles_[x].neighbours[0] = y;
        triangles_[y].neighbours[0] = x;
    };
    join(half, other);
    join(t, half + 1);
}

// Triangle t with side k from a to b, c opposite, becomes (a, vertex, c), and `half` (vertex, b, c); side 0 is the part
// of the side.
void BisectedMesh::split_side(Index t, int k, double fraction, Index vertex, Index half) {
    const Triangle old = triangles_[t];
    const int k1 = (k + 1) % 3, k2 = (k + 2) % 3;
    const Vector weights = (1 - fraction) * old.weights[k] + fraction * old.weights[k1];
    triangles_[t] = {{old.corners[k], vertex, old.corners[k2]},
                     {-1, half, old.neighbours[k2]},
                     {old.is_feature[k], false, old.is_feature[k2]},
                     old.origin,
                     {old.weights[k], weights, old.weights[k2]}};
    triangles_.push_back({{vertex, old.corners[k1], old.corners[k2]},
                          {-1, old.neighbours[k1], t},
                          {old.is_feature[k], old.is_feature[k1], false},
                          old.origin,
                          {weights, old.weights[k1], old.weights[k2]}});
    triangle_at_[old.corners[k1]] = half;
    if (const Index beyond = old.neighbours[k1]; beyond >= 0)
        triangles_[beyond].neighbours[side_to(beyond, t, old.corners[k2])] = half;
    for (Place& place : waiting_) {
        if (place.triangle != t) continue;
        const double a = place.weights[k], b = place.weights[k1], c = place.weights[k2];
        if (b * (1 - fraction) <= a * fraction) {
            place = snapped({t, Vector(a - b / fraction * (1 - fraction), b / fraction, c)});
        } else {
            const double part = a / (1 - fraction);
            place = snapped({half, Vector(part, b - part * fraction, c)});
        }
    }
}

// Into (vertex, corner k, corner k + 1) for k = 0, 1, 2.
void BisectedMesh::split_inside(Index t, const Vector& weights) {
    const Triangle old = triangles_[t];
    const Index vertex = add_vertex(t, weights), next = static_cast<Index>(triangles_.size());
    const Vector source = weights[0] * old.weights[0] + weights[1] * old.weights[1] + weights[2] * old.weights[2];
    const std::array<Index, 3> parts = {t, next, next + 1};
    triangles_.resize(triangles_.size() + 2);
    for (int k = 0; k < 3; ++k) {
        const int k1 = (k + 1) % 3;
        triangles_[parts[k]] = {{vertex, old.corners[k], old.corners[k1]},
                                {parts[(k + 2) % 3], old.neighbours[k], parts[k1]},
                                {false, old.is_feature[k], false},
                                old.origin,
                                {source, old.weights[k], old.weights[k1]}};
        triangle_at_[old.corners[k]] = parts[k];
        if (const Index beyond = old.neighbours[k]; beyond >= 0)
            triangles_[beyond].neighbours[side_to(beyond, t, old.corners[k1])] = parts[k];
    }
    for (Place& place : waiting_) {
        if (place.triangle != t) continue;
        // The part opposite to the corner whose weight the vertex uses up first.
        int least = 0;
        const Vector ratios = place.weights.cwiseQuotient(weights);
        const double share = ratios.minCoeff(&least);
        const Vector rest = place.weights - share * weights;
        const int k = (least + 1) % 3;
        place = snapped({parts[k], Vector(share, rest[k], rest[(k + 1) % 3])});
    }
}

}  // namespace octafield::surface::detail
