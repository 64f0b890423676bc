#include "octafield/volume/refine_tets.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <string>
#include <utility>

#include "octafield/error.hpp"
#include "refined_count.hpp"

namespace octafield::volume {
namespace {

using Edge = std::pair<Index, Index>;
using Tet = std::array<Index, 4>;

constexpr std::array<std::array<int, 2>, 6> edge_corners{{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};
constexpr int all_edges = 63;
// The edges of the triangle opposite each corner, as bits.
constexpr std::array<int, 4> triangle_edges{8 | 16 | 32, 2 | 4 | 32, 1 | 4 | 16, 1 | 2 | 8};
// Edges at each corner.
constexpr std::array<std::array<int, 3>, 4> edges_at{{{0, 1, 2}, {0, 3, 4}, {1, 3, 5}, {2, 4, 5}}};

// The diagonals of the octahedron between the edges' middles, and the other four middles in their order round it.
struct Diagonal {
    int from, to;
    std::array<int, 4> ring;
};
constexpr std::array<Diagonal, 3> diagonals{{{0, 5, {1, 2, 4, 3}}, {1, 4, {0, 3, 5, 2}}, {2, 3, {0, 1, 5, 4}}}};

int edge_between(int a, int b) {
    if (a > b) std::swap(a, b);
    return a == 0 ? b - 1 : a + b;
}

double signed_volume(const Points& v, const Tet& t) {
    const auto p = [&](int k) { return Eigen::RowVector3d(v.row(t[k]) - v.row(t[0])); };
    return p(1).cross(p(2)).dot(p(3));
}

// Numbers of the edges of each tet.
struct TetEdges {
    std::vector<Edge> edges;
    Rows<Index, 6> of_tets;

    explicit TetEdges(const Tets& tets) : of_tets(tets.rows(), 6) {
        std::vector<std::pair<Edge, std::int64_t>> all;
        all.reserve(6 * tets.rows());
        for (Eigen::Index t = 0; t < tets.rows(); ++t)
            for (int e = 0; e < 6; ++e)
                all.push_back({std::minmax({tets(t, edge_corners[e][0]), tets(t, edge_corners[e][1])}), 6 * t + e});
        std::sort(all.begin(), all.end());
        for (const auto& [edge, place] : all) {
            if (edges.empty() || edges.back() != edge) edges.push_back(edge);
            of_tets(place / 6, place % 6) = static_cast<Index>(edges.size() - 1);
        }
    }
};

bool is_green(int halved) {
    return halved == 0 || std::has_single_bit(unsigned(halved)) ||
           std::find(triangle_edges.begin(), triangle_edges.end(), halved) != triangle_edges.end();
}

// Edges of the tet that are halved, as bits.
int halved_bits(const TetEdges& numbers, const std::vector<std::uint8_t>& halved, Eigen::Index tet) {
    int bits = 0;
    for (int e = 0; e < 6; ++e) bits |= halved[numbers.of_tets(tet, e)] << e;
    return bits;
}

// Halved edges so that each tet is cut into eight, or one of the green ways, or not at all.
std::vector<std::uint8_t> halved_edges(const TetEdges& numbers, const std::vector<std::uint8_t>& marked) {
    std::vector<std::uint8_t> halved(numbers.edges.size(), 0);
    const auto halve_all = [&](Eigen::Index t) {
        for (int e = 0; e < 6; ++e) halved[numbers.of_tets(t, e)] = 1;
    };
    for (std::size_t t = 0; t < marked.size(); ++t)
        if (marked[t]) halve_all(static_cast<Eigen::Index>(t));
    for (bool changed = true; changed;) {
        changed = false;
        for (Eigen::Index t = 0; t < numbers.of_tets.rows(); ++t) {
            const int bits = halved_bits(numbers, halved, t);
            if (bits == all_edges || is_green(bits)) continue;
            halve_all(t);
            changed = true;
        }
    }
    return halved;
}

// The parts of a tet. middle: of each edge, or -1.
void cut(const Tet& tet, const std::array<Index, 6>& middle, const Points& points, std::vector<Tet>& parts) {
    int bits = 0;
    for (int e = 0; e < 6; ++e) bits |= (middle[e] >= 0) << e;
    const auto with = [&](int corner, Index vertex) {
        Tet part = tet;
        part[corner] = vertex;
        return part;
    };
    if (bits == 0) return parts.push_back(tet);
    if (std::has_single_bit(unsigned(bits))) {
        const int e = std::countr_zero(unsigned(bits));
        parts.push_back(with(edge_corners[e][0], middle[e]));
        parts.push_back(with(edge_corners[e][1], middle[e]));
        return;
    }
    if (bits != all_edges) {
        const int apex =
            static_cast<int>(std::find(triangle_edges.begin(), triangle_edges.end(), bits) - triangle_edges.begin());
        Tet inner = tet;
        for (int c = 0; c < 4; ++c) {
            if (c == apex) continue;
            Tet part = tet;
            for (int d = 0; d < 4; ++d)
                if (d != c && d != apex) part[d] = middle[edge_between(c, d)];
            parts.push_back(part);
        }
        // The middles stand where the corners across from them do: the way round is the same.
        const int a = apex == 0 ? 1 : 0, b = apex <= 1 ? 2 : 1, c = apex <= 2 ? 3 : 2;
        inner[a] = middle[edge_between(b, c)];
        inner[b] = middle[edge_between(a, c)];
        inner[c] = middle[edge_between(a, b)];
        return parts.push_back(inner);
    }
    for (int c = 0; c < 4; ++c) {
        Tet part = tet;
        for (const int e : edges_at[c])
            part[edge_corners[e][0] == c ? edge_corners[e][1] : edge_corners[e][0]] = middle[e];
        parts.push_back(part);
    }
    const auto length = [&](const Diagonal& d) {
        return (points.row(middle[d.from]) - points.row(middle[d.to])).squaredNorm();
    };
    const Diagonal& shortest =
        *std::min_element(diagonals.begin(), diagonals.end(),
                          [&](const Diagonal& x, const Diagonal& y) { return length(x) < length(y); });
    for (int i = 0; i < 4; ++i) {
        Tet part{middle[shortest.from], middle[shortest.to], middle[shortest.ring[i]],
                 middle[shortest.ring[(i + 1) % 4]]};
        if (signed_volume(points, part) < 0) std::swap(part[2], part[3]);
        parts.push_back(part);
    }
}

surface::FeatureGraph refined_features(const TetDomain& old, const TetDomain& refined, const TetEdges& numbers,
                                       const std::vector<Index>& middle_of) {
    std::vector<Index> number(refined.vertex_count(), -1);
    const std::vector<Index>& map = refined.surface().vertex_map;
    for (std::size_t v = 0; v < map.size(); ++v) number[map[v]] = static_cast<Index>(v);
    std::vector<Edge> edges;
    for (Eigen::Index e = 0; e < old.features().edges.rows(); ++e) {
        const Index a = old.surface().vertex_map[old.features().edges(e, 0)],
                    b = old.surface().vertex_map[old.features().edges(e, 1)];
        const Edge edge = std::minmax({a, b});
        const auto found = std::lower_bound(numbers.edges.begin(), numbers.edges.end(), edge) - numbers.edges.begin();
        const Index middle = middle_of[found];
        if (middle < 0) {
            edges.emplace_back(number[a], number[b]);
        } else {
            edges.emplace_back(number[a], number[middle]);
            edges.emplace_back(number[middle], number[b]);
        }
    }
    surface::FeatureGraph features;
    features.edges.resize(static_cast<Eigen::Index>(edges.size()), 2);
    for (std::size_t e = 0; e < edges.size(); ++e)
        features.edges.row(static_cast<Eigen::Index>(e)) << edges[e].first, edges[e].second;
    for (const Index corner : old.features().corners)
        features.corners.push_back(number[old.surface().vertex_map[corner]]);
    return surface::ordered_features(std::move(features), refined.surface().mesh);
}

void require_marks(const TetDomain& domain, const std::vector<std::uint8_t>& marked) {
    if (static_cast<Eigen::Index>(marked.size()) != domain.tet_count())
        throw InvalidInput("marked has " + std::to_string(marked.size()) + " entries; give one per tet, " +
                               std::to_string(domain.tet_count()),
                           "wrong_size");
}

}  // namespace

std::int64_t refined_count(const TetDomain& domain, const std::vector<std::uint8_t>& marked) {
    require_marks(domain, marked);
    const TetEdges numbers(domain.mesh().tets);
    const std::vector<std::uint8_t> halved = halved_edges(numbers, marked);
    std::int64_t count = 0;
    for (Eigen::Index t = 0; t < numbers.of_tets.rows(); ++t) {
        const int bits = halved_bits(numbers, halved, t);
        count += bits == 0 ? 1 : bits == all_edges ? 8 : std::has_single_bit(unsigned(bits)) ? 2 : 4;
    }
    return count;
}

RefinedDomain refine_tets(const TetDomain& domain, std::vector<std::uint8_t> marked) {
    require_marks(domain, marked);
    const TetMesh& old = domain.mesh();
    const TetEdges numbers(old.tets);
    const std::vector<std::uint8_t> halved = halved_edges(numbers, marked);
    const Index n = domain.vertex_count();
    std::vector<Index> middle_of(halved.size(), -1);
    std::vector<Edge> parents;
    for (Index v = 0; v < n; ++v) parents.emplace_back(v, v);
    for (std::size_t e = 0; e < halved.size(); ++e)
        if (halved[e]) {
            middle_of[e] = static_cast<Index>(parents.size());
            parents.push_back(numbers.edges[e]);
        }
    TetMesh mesh;
    Edges parent_rows(static_cast<Eigen::Index>(parents.size()), 2);
    mesh.vertices.resize(parent_rows.rows(), 3);
    for (std::size_t v = 0; v < parents.size(); ++v) {
        const auto [a, b] = parents[v];
        parent_rows.row(static_cast<Eigen::Index>(v)) << a, b;
        mesh.vertices.row(static_cast<Eigen::Index>(v)) = (old.vertices.row(a) + old.vertices.row(b)) / 2;
    }
    mesh.vertices.topRows(n) = old.vertices;
    std::vector<Tet> parts;
    std::vector<Index> parent, regions;
    for (Index t = 0; t < domain.tet_count(); ++t) {
        std::array<Index, 6> middle;
        for (int e = 0; e < 6; ++e) middle[e] = middle_of[numbers.of_tets(t, e)];
        cut({old.tets(t, 0), old.tets(t, 1), old.tets(t, 2), old.tets(t, 3)}, middle, mesh.vertices, parts);
        parent.resize(parts.size(), t);
        if (!domain.regions().empty()) regions.resize(parts.size(), domain.regions()[t]);
    }
    mesh.tets.resize(static_cast<Eigen::Index>(parts.size()), 4);
    for (std::size_t t = 0; t < parts.size(); ++t)
        for (int k = 0; k < 4; ++k) mesh.tets(static_cast<Eigen::Index>(t), k) = parts[t][k];
    const TetDomain plain(std::move(mesh), std::move(regions));
    return {plain.with_features(refined_features(domain, plain, numbers, middle_of)), std::move(parent_rows),
            std::move(parent)};
}

}  // namespace octafield::volume
