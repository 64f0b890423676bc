#include "octafield/volume/refine_uniformly.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace octafield::volume {
namespace {

using Edge = std::pair<Index, Index>;

constexpr std::array<std::array<int, 2>, 6> edge_corners{{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

// Tets at the corners, by local edge numbers of their other vertices, oriented as the tet is.
constexpr std::array<std::array<int, 3>, 4> at_corner{{{0, 1, 2}, {0, 4, 3}, {1, 3, 5}, {2, 5, 4}}};

// The diagonals of the octahedron by edges, and the other four edges right-handed round from the first to the second.
struct Diagonal {
    int from, to;
    std::array<int, 4> ring;
};
constexpr std::array<Diagonal, 3> diagonals{{{0, 5, {1, 2, 4, 3}}, {1, 4, {0, 3, 5, 2}}, {2, 3, {0, 1, 5, 4}}}};

std::vector<Edge> edges_of(const Tets& tets) {
    std::vector<Edge> edges;
    edges.reserve(6 * tets.rows());
    for (Eigen::Index t = 0; t < tets.rows(); ++t)
        for (const auto& [a, b] : edge_corners) edges.push_back(std::minmax({tets(t, a), tets(t, b)}));
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
}

double signed_volume(const Points& v, const std::array<Index, 4>& t) {
    const auto p = [&](int k) { return Eigen::RowVector3d(v.row(t[k]) - v.row(t[0])); };
    return p(1).cross(p(2)).dot(p(3));
}

}  // namespace

RefinedDomain refine_uniformly(const TetDomain& domain) {
    const TetMesh& old = domain.mesh();
    const std::vector<Edge> edges = edges_of(old.tets);
    const Index n = domain.vertex_count();
    const auto middle = [&](Index a, Index b) {
        const Edge edge = std::minmax({a, b});
        return n + static_cast<Index>(std::lower_bound(edges.begin(), edges.end(), edge) - edges.begin());
    };
    TetMesh mesh;
    Edges parents(n + static_cast<Eigen::Index>(edges.size()), 2);
    mesh.vertices.resize(parents.rows(), 3);
    mesh.vertices.topRows(n) = old.vertices;
    for (Index v = 0; v < n; ++v) parents.row(v).setConstant(v);
    for (std::size_t e = 0; e < edges.size(); ++e) {
        const Index v = n + static_cast<Index>(e);
        parents.row(v) << edges[e].first, edges[e].second;
        mesh.vertices.row(v) = (old.vertices.row(edges[e].first) + old.vertices.row(edges[e].second)) / 2;
    }
    mesh.tets.resize(8 * old.tets.rows(), 4);
    std::vector<Index> regions;
    for (Index t = 0; t < domain.tet_count(); ++t) {
        std::array<Index, 6> m;
        for (int e = 0; e < 6; ++e) m[e] = middle(old.tets(t, edge_corners[e][0]), old.tets(t, edge_corners[e][1]));
        Index row = 8 * t;
        const auto add = [&](std::array<Index, 4> tet) {
            if (signed_volume(mesh.vertices, tet) < 0) std::swap(tet[2], tet[3]);  // a flat one's sign is rounding
            for (int k = 0; k < 4; ++k) mesh.tets(row, k) = tet[k];
            ++row;
        };
        for (int c = 0; c < 4; ++c) add({old.tets(t, c), m[at_corner[c][0]], m[at_corner[c][1]], m[at_corner[c][2]]});
        const auto length = [&](const Diagonal& d) {
            return (mesh.vertices.row(m[d.from]) - mesh.vertices.row(m[d.to])).squaredNorm();
        };
        const Diagonal& shortest = *std::min_element(
            diagonals.begin(), diagonals.end(), [&](const Diagonal& x, const Diagonal& y) { return length(x) < length(y); });
        for (int i = 0; i < 4; ++i)
            add({m[shortest.from], m[shortest.to], m[shortest.ring[i]], m[shortest.ring[(i + 1) % 4]]});
        if (!domain.regions().empty()) regions.insert(regions.end(), 8, domain.regions()[t]);
    }
    TetDomain plain(std::move(mesh), std::move(regions));
    // Features by the vertices of the new surface.
    std::vector<Index> number(parents.rows(), -1);
    for (std::size_t v = 0; v < plain.surface().vertex_map.size(); ++v)
        number[plain.surface().vertex_map[v]] = static_cast<Index>(v);
    surface::FeatureGraph features;
    features.edges.resize(2 * domain.features().edges.rows(), 2);
    for (Eigen::Index e = 0; e < domain.features().edges.rows(); ++e) {
        const Index a = domain.surface().vertex_map[domain.features().edges(e, 0)],
                    b = domain.surface().vertex_map[domain.features().edges(e, 1)], m = middle(a, b);
        features.edges.row(2 * e) << number[a], number[m];
        features.edges.row(2 * e + 1) << number[m], number[b];
    }
    for (const Index corner : domain.features().corners)
        features.corners.push_back(number[domain.surface().vertex_map[corner]]);
    return {plain.with_features(surface::ordered_features(std::move(features), plain.surface().mesh)),
            std::move(parents)};
}

}  // namespace octafield::volume
