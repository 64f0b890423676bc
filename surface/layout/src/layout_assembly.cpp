#include "layout_assembly.hpp"

#include <algorithm>
#include <cmath>

#include "octafield/disjoint_sets.hpp"
#include "octafield/error.hpp"

namespace octafield::surface::detail {
namespace {

std::vector<LayoutVertex> vertices_of(const LayoutPieces& pieces, const LayoutPoints& points) {
    std::vector<LayoutVertex> result;
    std::vector<bool> straight(pieces.vertex_of_node.size(), false);
    for (std::size_t c = 0; c < pieces.turns.size(); ++c)
        if (!pieces.turns[c]) straight[pieces.cut.nodes[c]] = true;
    for (const Index node : pieces.vertex_nodes) {
        LayoutVertex vertex{LayoutVertexKind::boundary, -1, 0, pieces.cut.positions.row(node)};
        const bool is_vertex = node < static_cast<Index>(points.of_vertex.size());
        if (pieces.cut.is_crossing[node])
            vertex.kind = straight[node] ? LayoutVertexKind::t_joint : LayoutVertexKind::crossing;
        if (is_vertex && points.of_vertex[node] >= 0) {
            const LayoutPoint& point = points.points[points.of_vertex[node]];
            if (point.index_times_four != 0)
                vertex.kind = point.boundary ? LayoutVertexKind::corner : LayoutVertexKind::singular;
            else if (!point.boundary)
                vertex.kind = LayoutVertexKind::crossing;
            vertex.vertex = node;
            vertex.index_times_four = point.index_times_four;
        }
        result.push_back(vertex);
    }
    return result;
}

std::vector<LayoutSide> sides_of(const LayoutPieces& pieces) {
    std::vector<LayoutSide> result;
    for (const NodeChain& chain : pieces.chains) {
        const auto count = static_cast<Eigen::Index>(chain.nodes.size());
        LayoutSide side{pieces.vertex_of_node[chain.nodes.front().node],
                        pieces.vertex_of_node[chain.nodes.back().node],
                        chain.curve,
                        -1,
                        Points(count, 3),
                        Eigen::VectorXd(count)};
        for (Eigen::Index i = 0; i < count; ++i) {
            side.points.row(i) = pieces.cut.positions.row(chain.nodes[i].node);
            side.parameters[i] = chain.nodes[i].length;
        }
        result.push_back(std::move(side));
    }
    return result;
}

// Of the patch cut open along the curves.
int euler_characteristic(const CutSurface& cut, const std::vector<Index>& polygons) {
    std::vector<Index> points;
    int twice_sides = 0;
    for (const Index p : polygons)
        for (Index c = cut.first[p]; c < cut.first[p + 1]; ++c) {
            points.push_back(cut.points[c]);
            twice_sides += cut.is_cut[c] ? 2 : 1;
        }
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    return static_cast<int>(points.size()) - twice_sides / 2 + static_cast<int>(polygons.size());
}

PatchKind kind_of(const LayoutPatch& patch) {
    if (patch.euler_characteristic == 1) return patch.corners == 4 ? PatchKind::quad : PatchKind::polygon;
    return patch.euler_characteristic == 0 && patch.loops.size() == 2 ? PatchKind::annulus : PatchKind::other;
}

std::vector<LayoutPatch> patches_of(const LayoutPieces& pieces) {
    std::vector<LayoutPatch> result;
    for (std::size_t i = 0; i < pieces.loops.size(); ++i) {
        LayoutPatch patch{PatchKind::other, euler_characteristic(pieces.cut, pieces.patch_polygons[i]), 0, {}, {}};
        for (const auto& loop : pieces.loops[i]) {
            patch.loops.emplace_back();
            for (std::size_t j = 0; j < loop.size(); ++j) {
                if (pieces.turns[loop[j]]) {
                    ++patch.corners;
                    patch.corner_sides.push_back(static_cast<Index>(patch.loops.back().size()));
                }
                if (pieces.vertex_of_node[pieces.cut.nodes[loop[j]]] >= 0 || j == 0)
                    patch.loops.back().push_back({pieces.chain_of_side[loop[j]], !pieces.forward[loop[j]]});
            }
        }
        patch.kind = kind_of(patch);
        result.push_back(std::move(patch));
    }
    return result;
}

void require_euler(const QuadLayout& layout) {
    auto sum = static_cast<long>(layout.vertices.size());
    for (const LayoutSide& side : layout.sides) sum -= side.first >= 0;
    for (const LayoutPatch& patch : layout.patches) sum += patch.euler_characteristic;
    const int whole = euler_characteristic(layout.domain.mesh());
    if (sum != whole)
        throw GeometryError("the layout's V - E + F is " + std::to_string(sum) + ", the surface's is " +
                                std::to_string(whole) + ": curves run too near to one another; refine the mesh",
                            "bad_subdivision");
}

}  // namespace

void assemble(QuadLayout& layout, const LayoutPoints& points, std::shared_ptr<const LayoutPieces> pieces) {
    layout.vertices = vertices_of(*pieces, points);
    layout.sides = sides_of(*pieces);
    layout.patches = patches_of(*pieces);
    layout.pieces = std::move(pieces);
    require_euler(layout);
}

void add_chords(QuadLayout& layout) {
    DisjointSets sets(layout.sides.size());
    for (const LayoutPatch& patch : layout.patches) {
        if (patch.kind != PatchKind::quad) continue;
        for (int k = 0; k < 2; ++k) {
            const Index a = patch.loops[0][k].side, b = patch.loops[0][k + 2].side;
            const double la = layout.sides[a].length(), lb = layout.sides[b].length();
            layout.largest_mismatch = std::max(layout.largest_mismatch, 2 * std::abs(la - lb) / (la + lb));
            sets.join(a, b);
        }
    }
    Index count = 0;
    const std::vector<Index> chords = std::move(sets).numbers(count);
    layout.chords.resize(count, {{}, 0});
    for (std::size_t s = 0; s < chords.size(); ++s) {
        layout.sides[s].chord = chords[s];
        layout.chords[chords[s]].sides.push_back(static_cast<Index>(s));
        layout.chords[chords[s]].length += layout.sides[s].length();
    }
    for (LayoutChord& chord : layout.chords) chord.length /= static_cast<double>(chord.sides.size());
}

Index boundary_cut(const QuadLayout& layout, const LayoutPatch& patch) {
    if (patch.kind != PatchKind::annulus) return -1;
    for (const auto& loop : patch.loops) {
        if (layout.sides[loop[0].side].first >= 0) continue;
        const auto& nodes = layout.pieces->chains[loop[0].side].nodes;
        return std::min_element(nodes.begin(), nodes.end(),
                                [](const auto& a, const auto& b) { return a.node < b.node; })
            ->node;
    }
    return -1;
}

}  // namespace octafield::surface::detail
