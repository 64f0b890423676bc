#include "layout_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "boundary_lengths.hpp"
#include "octafield/error.hpp"

namespace octafield::surface::detail {
namespace {

// Splits at vertices of the layout; a closed list without any stays whole.
void add_chains(LayoutPieces& pieces, Index curve, const std::vector<CurveNode>& nodes) {
    NodeChain chain{curve, {nodes.front()}};
    for (std::size_t i = 1; i < nodes.size(); ++i) {
        chain.nodes.push_back(nodes[i]);
        if (pieces.vertex_of_node[nodes[i].node] < 0 && i + 1 < nodes.size()) continue;
        chain.closed = pieces.vertex_of_node[nodes[i].node] < 0;
        pieces.chains.push_back(chain);
        chain.nodes = {nodes[i]};
    }
    for (NodeChain& c : pieces.chains) {
        const double start = c.nodes.front().length;
        for (CurveNode& node : c.nodes) node.length -= start;
    }
}

void mark_vertices(LayoutPieces& pieces, const LayoutPoints& points) {
    const CutSurface& cut = pieces.cut;
    std::vector<bool> marked = cut.is_crossing;
    for (const LayoutPoint& point : points.points) marked[point.vertex] = true;
    for (const auto& curve : cut.curves) marked[curve.back().node] = true;
    pieces.vertex_of_node.assign(marked.size(), -1);
    for (std::size_t n = 0; n < marked.size(); ++n) {
        if (!marked[n]) continue;
        pieces.vertex_of_node[n] = static_cast<Index>(pieces.vertex_nodes.size());
        pieces.vertex_nodes.push_back(static_cast<Index>(n));
    }
}

void find_parts(LayoutPieces& pieces) {
    struct Part {
        Index low, high, chain, part;
        bool up;  // from the lower to the higher node
    };
    std::vector<Part> parts;
    for (Index c = 0; c < static_cast<Index>(pieces.chains.size()); ++c) {
        const auto& nodes = pieces.chains[c].nodes;
        for (Index i = 0; i + 1 < static_cast<Index>(nodes.size()); ++i)
            parts.push_back({std::min(nodes[i].node, nodes[i + 1].node), std::max(nodes[i].node, nodes[i + 1].node), c,
                             i, nodes[i].node < nodes[i + 1].node});
    }
    const auto before = [](const Part& a, const Part& b) { return std::tie(a.low, a.high) < std::tie(b.low, b.high); };
    std::sort(parts.begin(), parts.end(), before);
    const CutSurface& cut = pieces.cut;
    pieces.chain_of_side.assign(cut.nodes.size(), -1);
    pieces.part_of_side.assign(cut.nodes.size(), -1);
    pieces.forward.assign(cut.nodes.size(), false);
    for (Index p = 0; p < cut.polygon_count(); ++p)
        for (Index c = cut.first[p]; c < cut.first[p + 1]; ++c) {
            if (!cut.is_cut[c]) continue;
            const Index a = cut.nodes[c], b = cut.nodes[cut.next(p, c)];
            const Part key{std::min(a, b), std::max(a, b), 0, 0, a < b};
            const auto found = std::lower_bound(parts.begin(), parts.end(), key, before);
            if (found == parts.end() || found->low != key.low || found->high != key.high)
                throw GeometryError("a side of a patch belongs to no curve", "bad_subdivision");
            pieces.chain_of_side[c] = found->chain;
            pieces.part_of_side[c] = found->part;
            pieces.forward[c] = found->up == key.up;
        }
}

// Where a curve ends at another one, the patch on that one's other side goes straight on.
void find_turns(LayoutPieces& pieces) {
    const CutSurface& cut = pieces.cut;
    std::vector<int> corners(cut.point_count, 0);
    for (const Index point : cut.points) ++corners[point];
    pieces.turns.resize(cut.nodes.size());
    for (std::size_t c = 0; c < cut.nodes.size(); ++c) {
        const Index node = cut.nodes[c];
        const int count = cut.is_crossing[node] ? corners[cut.points[c]] : 1;  // of the four at a crossing
        pieces.turns[c] = pieces.vertex_of_node[node] >= 0 && count == 1;
        if (count > 2) throw GeometryError("a curve of the layout ends at no other", "bad_subdivision");
    }
}

void walk_patches(LayoutPieces& pieces) {
    const CutSurface& cut = pieces.cut;
    pieces.patch_polygons.resize(cut.patch_count);
    std::vector<Index> out(cut.point_count, -1), after(cut.nodes.size());
    std::vector<std::vector<Index>> sides(cut.patch_count);
    for (Index p = 0; p < cut.polygon_count(); ++p) {
        pieces.patch_polygons[cut.patches[p]].push_back(p);
        for (Index c = cut.first[p]; c < cut.first[p + 1]; ++c) {
            after[c] = cut.next(p, c);
            if (!cut.is_cut[c]) continue;
            if (out[cut.points[c]] >= 0)
                throw GeometryError("patches of the layout touch themselves", "bad_subdivision");
            out[cut.points[c]] = c;
            sides[cut.patches[p]].push_back(c);
        }
    }
    pieces.loops.resize(cut.patch_count);
    std::vector<bool> done(cut.nodes.size(), false);
    for (Index patch = 0; patch < cut.patch_count; ++patch) {
        // From corners first, then from other vertices of the layout.
        const auto rank = [&](Index c) {
            return pieces.turns[c] ? 0 : pieces.vertex_of_node[cut.nodes[c]] >= 0 ? 1 : 2;
        };
        std::stable_sort(sides[patch].begin(), sides[patch].end(), [&](Index a, Index b) { return rank(a) < rank(b); });
        for (const Index start : sides[patch]) {
            if (done[start]) continue;
            std::vector<Index> loop;
            for (Index c = start; !done[c]; c = out[cut.points[after[c]]]) {
                done[c] = true;
                loop.push_back(c);
                if (out[cut.points[after[c]]] < 0)
                    throw GeometryError("the boundary of a patch of the layout is open", "bad_subdivision");
            }
            pieces.loops[patch].push_back(std::move(loop));
        }
    }
}

}  // namespace

LayoutPieces layout_pieces(const ImposedField& field, const LocalField& local, const LayoutPoints& points,
                           const std::vector<LayoutCurve>& curves, const CurveEnds& ends) {
    const Charts& charts = local.charts();
    LayoutPieces pieces;
    pieces.steps.resize(charts.mesh().triangles.rows(), 3);
    for (Index t = 0; t < pieces.steps.rows(); ++t)
        pieces.steps.row(t) = charts.lift_vector(t, local.velocity({t, charts.centroid(t), 0}));
    pieces.cut = cut_surface(charts, curves, ends);
    mark_vertices(pieces, points);
    for (Index c = 0; c < static_cast<Index>(curves.size()); ++c) add_chains(pieces, c, pieces.cut.curves[c]);
    const auto starts = [&](Index node) { return pieces.vertex_of_node[node] >= 0; };
    for (const auto& nodes : boundary_nodes(field, charts, points, pieces.cut, starts)) add_chains(pieces, -1, nodes);
    find_parts(pieces);
    find_turns(pieces);
    walk_patches(pieces);
    return pieces;
}

}  // namespace octafield::surface::detail
