#include "tet_topology.hpp"

#include <algorithm>
#include <numeric>

#include "cell_shapes.hpp"

namespace octafield::volume::detail {
namespace {

// Items by their lowest vertex, and there in order: close to linear, as there are few at each.
template <class Item>
struct Buckets {
    std::vector<Index> start;
    std::vector<Item> items;
};

template <class Item, class Each>
Buckets<Item> sorted_by_lowest(Index vertices, const Each& each) {
    Buckets<Item> buckets;
    buckets.start.assign(static_cast<std::size_t>(vertices) + 1, 0);
    each([&](Index lowest, const Item&) { ++buckets.start[lowest + 1]; });
    std::partial_sum(buckets.start.begin(), buckets.start.end(), buckets.start.begin());
    buckets.items.resize(buckets.start.back());
    std::vector<Index> next(buckets.start.begin(), buckets.start.end() - 1);
    each([&](Index lowest, const Item& item) { buckets.items[next[lowest]++] = item; });
    for (Index v = 0; v < vertices; ++v)
        std::sort(buckets.items.begin() + buckets.start[v], buckets.items.begin() + buckets.start[v + 1]);
    return buckets;
}

using Face = std::array<Index, 4>;  // middle and highest vertex, tet, 2 * face + side

Buckets<Face> sorted_faces(const Tets& tets, Index vertices) {
    return sorted_by_lowest<Face>(vertices, [&](const auto& take) {
        for (Index t = 0; t < tets.rows(); ++t)
            for (Index f = 0; f < 4; ++f) {
                const auto& local = tet_shape.faces[f].local;
                std::array<Index, 3> v{tets(t, local[0]), tets(t, local[1]), tets(t, local[2])};
                const int ascents = (v[0] < v[1]) + (v[1] < v[2]) + (v[2] < v[0]);
                if (v[1] < v[0]) std::swap(v[0], v[1]);
                if (v[2] < v[1]) std::swap(v[1], v[2]);
                if (v[1] < v[0]) std::swap(v[0], v[1]);
                take(v[0], Face{v[1], v[2], t, 2 * f + (ascents == 2 ? 0 : 1)});
            }
    });
}

}  // namespace

TetTopology::TetTopology(const Tets& tets, Index vertices) : tet_triangles(tets.rows()) {
    const Buckets<Face> faces = sorted_faces(tets, vertices);
    std::vector<std::array<Index, 3>> corners;  // of the triangles, ascending
    for (Index v = 0; v < vertices; ++v)
        for (Index f = faces.start[v]; f < faces.start[v + 1]; ++f) {
            const auto& [middle, highest, tet, side] = faces.items[f];
            if (corners.empty() || corners.back() != std::array{v, middle, highest}) {
                corners.push_back({v, middle, highest});
                triangle_tets.push_back({-1, -1});
            }
            triangle_tets.back()[side % 2] = tet;
            tet_triangles[tet][side / 2] = triangle_count() - 1;
        }

    using Entry = std::array<Index, 3>;  // the edge's higher vertex, the third one, the triangle
    const Buckets<Entry> entries = sorted_by_lowest<Entry>(vertices, [&](const auto& take) {
        for (Index t = 0; t < triangle_count(); ++t) {
            const auto& [a, b, c] = corners[t];
            take(a, Entry{b, c, t});
            take(a, Entry{c, b, t});
            take(b, Entry{c, a, t});
        }
    });
    std::vector<std::array<Index, 2>> edges;
    for (Index v = 0; v < vertices; ++v)
        for (Index i = entries.start[v]; i < entries.start[v + 1]; ++i) {
            const auto& [higher, third, triangle] = entries.items[i];
            if (edges.empty() || edges.back() != std::array{v, higher}) {
                edges.push_back({v, higher});
                link_start.push_back(i);
            }
            link_vertices.push_back(third);
            link_triangles.push_back(triangle);
        }
    link_start.push_back(static_cast<Index>(link_vertices.size()));

    neighbour_start.assign(static_cast<std::size_t>(vertices) + 1, 0);
    for (const auto& edge : edges)
        for (const Index v : edge) ++neighbour_start[v + 1];
    std::partial_sum(neighbour_start.begin(), neighbour_start.end(), neighbour_start.begin());
    neighbours.resize(neighbour_start.back());
    neighbour_edges.resize(neighbour_start.back());
    std::vector<Index> next(neighbour_start.begin(), neighbour_start.end() - 1);
    // Edges come in the order of their lower vertices, so each list ascends.
    for (Index e = 0; e < static_cast<Index>(edges.size()); ++e)
        for (int k = 0; k < 2; ++k) {
            const Index at = next[edges[e][k]]++;
            neighbours[at] = edges[e][1 - k];
            neighbour_edges[at] = e;
        }
}

Index TetTopology::edge(Index a, Index b) const {
    const std::span<const Index> all = around(a);
    const auto found = std::lower_bound(all.begin(), all.end(), b);
    return found != all.end() && *found == b ? neighbour_edges[neighbour_start[a] + (found - all.begin())] : -1;
}

Index TetTopology::triangle_at(Index edge, Index third) const {
    if (edge < 0) return -1;
    for (Index i = link_start[edge]; i < link_start[edge + 1]; ++i)
        if (link_vertices[i] == third) return link_triangles[i];
    return -1;
}

std::vector<std::uint8_t> TetTopology::marked(const Triangles& given) const {
    std::vector<std::uint8_t> marks(given.rows() ? triangle_count() : 0, 0);
    for (const auto row : given.rowwise())
        if (const Index found = triangle(row[0], row[1], row[2]); found >= 0) marks[found] = 1;
    return marks;
}

}  // namespace octafield::volume::detail
