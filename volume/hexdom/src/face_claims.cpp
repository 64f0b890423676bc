#include "face_claims.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace octafield::volume::detail {
namespace {

FaceKey key_of(const std::array<Index, 4>& round, int corners) {
    FaceKey key{round, -1, 0};
    if (corners == 3) key.sorted[3] = -1;
    const auto lowest = std::min_element(round.begin(), round.begin() + corners) - round.begin();
    if (corners == 4) key.across = round[(lowest + 2) % 4];
    for (int k = 1; k < corners; ++k)  // std::sort makes GCC 12 see bounds that are not there
        for (int j = k; j > 0 && key.sorted[j] < key.sorted[j - 1]; --j) std::swap(key.sorted[j], key.sorted[j - 1]);
    return key;
}

// Pairs of corners.
const std::vector<std::array<int, 2>>& shape_edges(const CellShape& shape) {
    const auto edges = [](const CellShape& of) {
        std::vector<std::array<int, 2>> pairs;
        for (const CellFace& face : of.faces)
            for (int k = 0; k < face.corners; ++k) {
                const int a = face.local[k], b = face.local[(k + 1) % face.corners];
                if (a < b) pairs.push_back({a, b});  // the other face at the edge has it the other way round
            }
        return pairs;
    };
    static const std::vector<std::array<int, 2>> hexahedron = edges(hexahedron_shape), wedge = edges(wedge_shape);
    return &shape == &wedge_shape ? wedge : hexahedron;
}

}  // namespace

TetSurroundings::TetSurroundings(const MixedMesh& mesh, const TetTopology& topology, const Edges& kept,
                                 const std::vector<std::uint8_t>& walls, double max_fold)
    : mesh_(mesh),
      topology_(topology),
      least_cosine_(std::cos(max_fold)),
      outside_(topology.triangle_count(), Outside::tets),
      fixed_edges_(topology.edge_count(), 0),
      fixed_diagonals_(topology.edge_count(), -1),
      kept_(topology.edge_count(), 0) {
    for (Eigen::Index e = 0; e < kept.rows(); ++e) {
        const Index edge = topology.edge(kept(e, 0), kept(e, 1));
        if (edge >= 0) kept_[edge] = 1;
    }
    for (Index t = 0; t < topology.triangle_count(); ++t)
        if (topology.triangle_tets[t][0] < 0 || topology.triangle_tets[t][1] < 0) outside_[t] = Outside::boundary;
    if (!walls.empty()) {
        walls_at_.assign(topology.edge_count(), 0);
        for (Index edge = 0; edge < topology.edge_count(); ++edge)
            for (Index i = topology.link_start[edge]; i < topology.link_start[edge + 1]; ++i)
                walls_at_[edge] += walls[topology.link_triangles[i]];
        for (Index t = 0; t < topology.triangle_count(); ++t)
            if (walls[t] && outside_[t] == Outside::tets) outside_[t] = Outside::wall;
    }
    for_each_cell(mesh, [&](const Cell& cell) {
        if (&cell.shape != &tet_shape) add_fixed_faces(cell);
    });
}

void TetSurroundings::add_fixed_faces(const Cell& cell) {
    for (const CellFace& local : cell.shape.faces) {
        std::array<Index, 4> round{-1, -1, -1, -1};
        for (int k = 0; k < local.corners; ++k) round[k] = cell.ids[local.local[k]];
        for (int k = 0; k < local.corners; ++k) {
            const Index edge = topology_.edge(round[k], round[(k + 1) % local.corners]);
            if (edge >= 0) fixed_edges_[edge] = 1;
        }
        if (!add_fixed_face(round, local.corners) || local.corners == 3) continue;
        const std::optional<CellFacet> facet = quad_facet(topology_, round);
        if (!facet) continue;  // of a quad that meets other cells
        // Outside is within for the tets: a flat tet has its other diagonal beyond.
        const Index number = static_cast<Index>(fixed_.size()) - 1;
        for (int k = 0; k < 2; ++k) {
            if (facet->pairs[k][0] < 0 || outside_[facet->pairs[k][0]] != number) continue;
            CellFacet from_here = *facet;
            from_here.inner = k;
            const int outermost = flat_tet_outside(topology_, from_here) < 0 ? k : 1 - k;
            fixed_diagonals_[topology_.edge(round[outermost], round[outermost + 2])] = number;
        }
    }
}

// Sets outside_ of the triangles that lie against the face. False where there are none.
bool TetSurroundings::add_fixed_face(const std::array<Index, 4>& round, int corners) {
    bool any = false;
    for (int without = corners == 3 ? 3 : 0; without < 4; ++without) {
        const Index a = round[without == 0 ? 1 : 0], b = round[without <= 1 ? 2 : 1], c = round[without <= 2 ? 3 : 2];
        const Index triangle = topology_.triangle(a, b, c);
        // The tet there has it the other way round.
        if (triangle < 0 || outside_[triangle] != Outside::boundary || topology_.tet_outside(triangle, a, b, c) < 0)
            continue;
        outside_[triangle] = static_cast<Index>(fixed_.size());
        any = true;
    }
    if (any) fixed_.push_back(key_of(round, corners));
    return any;
}

std::optional<CellClaims> TetSurroundings::claims(const CellShape& shape, const Index* ids,
                                                  unsigned inner_pairs) const {
    std::optional<CellFacets> facets = cell_facets(topology_, shape, ids);
    CellClaims claims{{}, static_cast<int>(shape.faces.size()), {}, 0};
    for (int f = 0; f < claims.count; ++f) {
        (*facets)[f].inner = inner_pairs >> f & 1u;
        const std::optional<FaceClaim> of_face = claim((*facets)[f]);
        if (!of_face) return std::nullopt;
        claims.faces[f] = *of_face;
    }
    for (const auto& [a, b] : shape_edges(shape)) {
        const Index edge = topology_.edge(ids[a], ids[b]);
        if (fixed_diagonals_[edge] >= 0) return std::nullopt;
        claims.edges[claims.edge_count++] = edge;
    }
    return claims;
}

std::optional<FaceClaim> TetSurroundings::claim(const CellFacet& facet) const {
    FaceClaim claim{key_of(facet.round, facet.corners), {-1, -1, -1, -1}, 1, -1, -1};
    if (facet.corners == 3) {
        claim.triangles[0] = facet.pairs[0][0];
        return claim;  // on half of a quad that stays, its edges would be that quad's diagonal: see claims()
    }
    const auto& inner = facet.pairs[facet.inner];
    const auto& other = facet.pairs[1 - facet.inner];
    claim.flat = flat_tet_outside(topology_, facet);
    if (!walls_at_.empty() && !fits_walls(facet, claim.flat)) return std::nullopt;
    claim.count = other[0] < 0 ? 2 : 4;
    claim.triangles = {inner[0], inner[1], other[0], other[1]};
    const int outermost = claim.flat < 0 ? facet.inner : 1 - facet.inner;
    const auto& [first, second] = facet.pairs[outermost];
    const bool closed = outside_[first] >= Outside::boundary;
    if (closed != (outside_[second] >= Outside::boundary)) return std::nullopt;
    if (closed && !may_close(facet, outermost)) return std::nullopt;
    if (!closed) {
        claim.diagonal = topology_.edge(facet.round[outermost], facet.round[outermost + 2]);
        if (fixed_edges_[claim.diagonal] || fixed_diagonals_[claim.diagonal] >= 0) return std::nullopt;
    }
    if (claim.count == 4 && claim.flat < 0) {
        // What lies between the two pairs must not come between two quads of the same vertices.
        if (outside_[other[0]] >= 0 || outside_[other[1]] >= 0) return std::nullopt;
        const Index lowest = claim.key.sorted[0];
        claim.key.variant = facet.round[facet.inner] == lowest || facet.round[facet.inner + 2] == lowest ? 1 : 2;
    }
    return claim;
}

bool TetSurroundings::may_close(const CellFacet& facet, int pair) const {
    const Index beyond = outside_[facet.pairs[pair][0]];
    if (beyond != outside_[facet.pairs[pair][1]]) return false;
    if (beyond >= 0) return true;  // both on one face: it is this quad
    return may_be_quad(facet, pair);
}

bool TetSurroundings::may_be_quad(const CellFacet& facet, int pair) const {
    const auto& round = facet.round;
    if (kept_[topology_.edge(round[pair], round[pair + 2])]) return false;
    const auto normal = [&](const std::array<Index, 3>& t) -> Eigen::Vector3d {
        const Eigen::Vector3d a = mesh_.vertices.row(t[0]), b = mesh_.vertices.row(t[1]), c = mesh_.vertices.row(t[2]);
        return (b - a).cross(c - a).normalized();
    };
    return normal(facet.half(pair, 0)).dot(normal(facet.half(pair, 1))) >= least_cosine_;
}

TetSurroundings::Lies TetSurroundings::on_wall(const CellFacet& facet, int pair) const {
    const int halves = facet.pairs[pair][0] < 0 ? 0
                                                : (outside_[facet.pairs[pair][0]] == Outside::wall) +
                                                      (outside_[facet.pairs[pair][1]] == Outside::wall);
    return halves == 2 ? Lies::on : halves == 1 ? Lies::half : Lies::off;
}

// On a wall with one pair and all of it, or on none. The wall keeps its edges but for the diagonal of that pair: others
// would be lost with the tets round the diagonal.
bool TetSurroundings::fits_walls(const CellFacet& facet, Index flat) const {
    for (int k = 0; k < 2; ++k) {
        const Lies lies = on_wall(facet, k);
        if (lies == Lies::half) return false;
        const Index diagonal = topology_.edge(facet.round[k], facet.round[k + 2]);
        if (lies == Lies::on && (walls_at_[diagonal] != 2 || !may_be_quad(facet, k))) return false;
        const bool goes = facet.pairs[k][0] >= 0 && (k == facet.inner || flat >= 0);
        if (lies == Lies::off && goes && walls_at_[diagonal] > 0 && outside_[facet.pairs[k][0]] < 0) return false;
    }
    const int beyond = 1 - facet.inner;
    if (on_wall(facet, beyond) == Lies::on) return flat >= 0 && on_wall(facet, facet.inner) == Lies::off;
    // A flat tet between a wall and the boundary or a cell that stays is all there is of its region.
    return on_wall(facet, facet.inner) == Lies::off || facet.pairs[beyond][0] < 0 ||
           outside_[facet.pairs[beyond][0]] == Outside::tets;
}

}  // namespace octafield::volume::detail
