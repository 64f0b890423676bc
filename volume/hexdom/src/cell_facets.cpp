#include "cell_facets.hpp"

#include <algorithm>

namespace octafield::volume::detail {
namespace {

// Triangles of the cell's faces, where the search for its tets ends.
struct Barrier {
    Index triangle, inside;
    std::uint8_t facet, pair;
    bool hit;
};

struct Barriers {
    std::array<Barrier, 24> all;
    int count = 0;

    Barrier* find(Index triangle) {
        for (int i = 0; i < count; ++i)
            if (all[i].triangle == triangle) return &all[i];
        return nullptr;
    }
    // False where a triangle is there already.
    bool add(const TetTopology& topology, Index triangle, const std::array<Index, 3>& corners, int facet, int pair) {
        if (find(triangle)) return false;
        all[count++] = {triangle, topology.tet_inside(triangle, corners[0], corners[1], corners[2]),
                        static_cast<std::uint8_t>(facet), static_cast<std::uint8_t>(pair), false};
        return true;
    }
};

bool all_in(const Index* four, const Index* ids, int count) {
    return std::all_of(four, four + 4, [&](Index v) { return std::find(ids, ids + count, v) != ids + count; });
}

bool add_barriers(const TetTopology& topology, const CellFacets& facets, int faces, Barriers& barriers) {
    for (int f = 0; f < faces; ++f) {
        const CellFacet& facet = facets[f];
        if (facet.corners == 3) {
            if (!barriers.add(topology, facet.pairs[0][0], {facet.round[0], facet.round[1], facet.round[2]}, f, 0))
                return false;
            continue;
        }
        for (int k = 0; k < 2; ++k)
            for (int h = 0; h < 2; ++h)
                if (facet.pairs[k][0] >= 0 && !barriers.add(topology, facet.pairs[k][h], facet.half(k, h), f, k))
                    return false;
    }
    return true;
}

// A tet inside: at a face with one pair, or behind the flat tet where all have two.
Index seed_tet(const Tets& tets, const CellFacets& facets, int faces, const Barriers& barriers) {
    for (int i = 0; i < barriers.count; ++i) {
        const CellFacet& facet = facets[barriers.all[i].facet];
        if (facet.corners == 3 || facet.pairs[0][0] < 0 || facet.pairs[1][0] < 0) return barriers.all[i].inside;
    }
    if (faces == 0 || barriers.count == 0 || barriers.all[0].inside < 0) return -1;
    const bool outer = all_in(tets.row(barriers.all[0].inside).data(), facets[0].round.data(), 4);
    return barriers.all[outer ? 2 : 0].inside;
}

// Exactly one pair of each face was met, both halves.
bool set_inner(CellFacets& facets, int faces, const Barriers& barriers) {
    std::array<std::array<int, 2>, 6> met{};
    for (int i = 0; i < barriers.count; ++i) met[barriers.all[i].facet][barriers.all[i].pair] += barriers.all[i].hit;
    for (int f = 0; f < faces; ++f) {
        const int halves = facets[f].corners == 3 ? 1 : 2;
        const auto& [first, second] = met[f];
        if (!((first == halves && second == 0) || (first == 0 && second == halves))) return false;
        facets[f].inner = first == halves ? 0 : 1;
    }
    return true;
}

}  // namespace

std::optional<CellFacet> quad_facet(const TetTopology& topology, const std::array<Index, 4>& round) {
    const auto& [a, b, c, d] = round;
    const auto pair = [&](Index from, Index to, Index first, Index second) -> std::array<Index, 2> {
        const Index edge = topology.edge(from, to), one = topology.triangle_at(edge, first),
                    other = one < 0 ? -1 : topology.triangle_at(edge, second);
        return other < 0 ? std::array<Index, 2>{-1, -1} : std::array<Index, 2>{one, other};
    };
    const CellFacet facet{4, round, {pair(a, c, b, d), pair(b, d, c, a)}};
    if (facet.pairs[0][0] < 0 && facet.pairs[1][0] < 0) return std::nullopt;
    return facet;
}

std::optional<CellFacets> cell_facets(const TetTopology& topology, const CellShape& shape, const Index* ids) {
    CellFacets facets;
    for (std::size_t f = 0; f < shape.faces.size(); ++f) {
        const CellFace& face = shape.faces[f];
        std::array<Index, 4> round{-1, -1, -1, -1};
        for (int k = 0; k < face.corners; ++k) round[k] = ids[face.local[k]];
        if (face.corners == 4) {
            const std::optional<CellFacet> quad = quad_facet(topology, round);
            if (!quad) return std::nullopt;
            facets[f] = *quad;
            continue;
        }
        facets[f] = {3, round, {{{topology.triangle(round[0], round[1], round[2]), -1}, {-1, -1}}}};
        if (facets[f].pairs[0][0] < 0) return std::nullopt;
    }
    return facets;
}

bool find_inner_tets(const TetTopology& topology, const Tets& tets, const CellShape& shape, const Index* ids,
                     const std::vector<std::uint8_t>& taken, const std::vector<std::uint8_t>& walls, CellFacets& facets,
                     InnerTets& found) {
    const int faces = static_cast<int>(shape.faces.size());
    Barriers barriers;
    found.count = 0;
    if (!add_barriers(topology, facets, faces, barriers)) return false;
    const Index seed = seed_tet(tets, facets, faces, barriers);
    if (seed < 0) return false;
    found.tets[found.count++] = seed;
    for (int next = 0; next < found.count; ++next) {
        const Index tet = found.tets[next];
        if ((!taken.empty() && taken[tet]) || !all_in(tets.row(tet).data(), ids, shape.vertices)) return false;
        for (const Index triangle : topology.tet_triangles[tet]) {
            if (Barrier* barrier = barriers.find(triangle)) {
                barrier->hit = true;
                continue;
            }
            const auto& sides = topology.triangle_tets[triangle];
            const Index across = sides[0] == tet ? sides[1] : sides[0];
            if (across < 0 || (!walls.empty() && walls[triangle])) return false;
            const auto end = found.tets.begin() + found.count;
            if (std::find(found.tets.begin(), end, across) != end) continue;
            if (found.count == most_inner_tets) return false;
            found.tets[found.count++] = across;
        }
    }
    return set_inner(facets, faces, barriers);
}

Index flat_tet_outside(const TetTopology& topology, const CellFacet& facet) {
    if (facet.corners == 3 || facet.pairs[0][0] < 0 || facet.pairs[1][0] < 0) return -1;
    const auto outside = [&](int h) {
        const auto [a, b, c] = facet.half(facet.inner, h);
        return topology.tet_outside(facet.pairs[facet.inner][h], a, b, c);
    };
    return outside(0) == outside(1) ? outside(0) : -1;
}

}  // namespace octafield::volume::detail
