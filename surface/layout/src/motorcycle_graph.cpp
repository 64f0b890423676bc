#include "octafield/surface/motorcycle_graph.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "layout_assembly.hpp"
#include "octafield/error.hpp"
#include "track_race.hpp"

namespace octafield::surface {
namespace {

using detail::CutSurface;
using detail::Slot;

// Short joints come first, as what lies behind a point is not reached through it; of points side by side the one that
// is missed by less.
double price(const detail::Passing& passing) { return passing.length + 4 * std::abs(passing.offset); }

constexpr int most_rounds = 30;  // of cuts: each leaves simpler patches

struct Tracks {
    std::vector<LayoutCurve> walls;
    std::vector<detail::Track> tracks;
};

// Which separatrix of a point a near one runs along is not always told right from beside it.
std::vector<Slot> likely_slots(const detail::LayoutPoints& points, const Slot& slot) {
    const detail::LayoutPoint& point = points.points[slot.point];
    const auto count = static_cast<int>(point.slots.size());
    std::vector<Slot> result = {slot};
    for (const int step : {1, -1}) {
        const int next = slot.slot + step;
        if (!point.boundary) result.push_back({slot.point, (next + count) % count});
        if (point.boundary && next >= 0 && next < count) result.push_back({slot.point, next});
    }
    return result;
}

using Candidate = std::pair<Slot, detail::Passing>;

void sort_candidates(std::vector<Candidate>& candidates) {
    std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
        return std::tuple(price(a.second), a.first, a.second.slot) <
               std::tuple(price(b.second), b.first, b.second.slot);
    });
}

std::vector<Candidate> passed_points(const std::vector<detail::Track>& tracks) {
    std::vector<Candidate> result;
    for (const detail::Track& track : tracks)
        for (const auto& passing : track.passing) result.emplace_back(track.slot, passing);
    sort_candidates(result);
    return result;
}

// Tracks that end at a third one from its two sides at nearly the same place: each would come to the other's point.
// Left as they are, they bound strips next to nothing wide, for which there may be no whole numbers.
std::vector<Candidate> opposite_ends(const std::vector<detail::Track>& tracks, const detail::SeparatrixTracer& tracer) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < tracks.size(); ++i)
        if (tracks[i].stopped_by >= 0) order.push_back(i);
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return std::tuple(tracks[a].stopped_by, tracks[a].stopped_at, a) <
               std::tuple(tracks[b].stopped_by, tracks[b].stopped_at, b);
    });
    std::vector<Candidate> result;
    for (std::size_t i = 0; i < order.size(); ++i)
        for (std::size_t j = i + 1; j < order.size(); ++j) {
            const detail::Track &a = tracks[order[i]], &b = tracks[order[j]];
            const double apart = b.stopped_at - a.stopped_at;
            if (b.stopped_by != a.stopped_by || apart > tracer.tolerance(a.slot)) break;
            if (a.from_left != b.from_left)
                result.push_back({a.slot, {b.slot, a.length + b.length, a.from_left ? apart : -apart}});
        }
    sort_candidates(result);
    return result;
}

// Joins what passes a point until nothing more does; what is joined is there from the start of the next race.
Tracks joined_tracks(const detail::LayoutInput& input, const Progress& progress) {
    const detail::SeparatrixTracer tracer(input.local, input.points, input.end_tolerance, input.max_length);
    using Pair = std::pair<Slot, Slot>;
    Tracks result;
    std::set<Slot> taken;
    std::set<Pair> refused;
    detail::KnownWalks known;
    while (true) {
        report_or_throw(progress, "trace", 0.5, NAN);
        std::vector<Slot> slots;
        for (Index p = 0; p < static_cast<Index>(input.points.points.size()); ++p)
            for (int s = 0; s < static_cast<int>(input.points.points[p].slots.size()); ++s)
                if (!taken.contains({p, s})) slots.push_back({p, s});
        result.tracks = detail::race(input.local, tracer, result.walls, slots, input.max_length, known);
        std::size_t before = result.walls.size();
        for (const auto& candidates : {passed_points(result.tracks), opposite_ends(result.tracks, tracer)}) {
            if (result.walls.size() > before) break;
            for (const auto& [from, to] : candidates) {
                if (taken.contains(from) || refused.contains({from, to.slot})) continue;
                bool joined = false;
                for (const Slot& slot : likely_slots(input.points, to.slot)) {
                    if (from == slot || taken.contains(slot)) continue;
                    auto curve = tracer.joined(from, {slot, to.length, to.offset});
                    if (!curve) continue;
                    taken.insert({from, slot});
                    result.walls.push_back(std::move(*curve));
                    joined = true;
                    break;
                }
                if (!joined) refused.insert({from, to.slot});
            }
        }
        if (result.walls.size() == before) return result;
    }
}

// Where each track ends: in its last triangle, where it crosses the curve that stops it.
std::vector<std::size_t> ends(const CutSurface& cut, const Tracks& found) {
    std::vector<std::vector<Index>> curves_at(cut.is_crossing.size());
    for (std::size_t c = 0; c < cut.curves.size(); ++c)
        for (const detail::CurveNode& at : cut.curves[c])
            if (cut.is_crossing[at.node]) curves_at[at.node].push_back(static_cast<Index>(c));
    std::vector<std::size_t> result;
    for (std::size_t c = 0; c < cut.curves.size(); ++c) {
        const auto& nodes = cut.curves[c];
        result.push_back(nodes.size() - 1);
        if (c < found.walls.size()) continue;
        const detail::Track& track = found.tracks[c - found.walls.size()];
        if (track.stopped_by < 0) continue;
        std::size_t at = nodes.size() - 1;
        while (cut.is_crossing[nodes[at - 1].node]) --at;
        const auto stops = [&](const detail::CurveNode& n) {
            const auto& curves = curves_at[n.node];
            if (track.stopped_by == static_cast<Index>(c)) return curves.size() == 2 && curves[0] == curves[1];
            return std::find(curves.begin(), curves.end(), track.stopped_by) != curves.end();
        };
        while (at < nodes.size() && !stops(nodes[at])) ++at;
        if (at == nodes.size())
            throw GeometryError("a track of the layout from vertex " + std::to_string(track.curve.first_vertex) +
                                    " loses what it ends at; refine the mesh",
                                "bad_subdivision");
        result[c] = at;
    }
    return result;
}

double mismatch(const QuadLayout& layout) {
    double worst = 0;
    for (const LayoutPatch& patch : layout.patches) {
        if (patch.kind != PatchKind::quad) continue;
        std::array<double, 4> sums{};
        const auto& loop = patch.loops[0];
        for (std::size_t i = 0, k = 0; i < loop.size(); ++i) {
            while (k < 3 && patch.corner_sides[k + 1] <= static_cast<Index>(i)) ++k;
            sums[k] += layout.sides[loop[i].side].length();
        }
        for (int k = 0; k < 2; ++k)
            worst = std::max(worst, 2 * std::abs(sums[k] - sums[k + 2]) / (sums[k] + sums[k + 2]));
    }
    return worst;
}

QuadLayout graph_with(const detail::LayoutInput& input, const Progress& progress) {
    QuadLayout layout;
    layout.curves = input.no_curves();
    layout.domain = layout.curves.domain;
    Tracks found = joined_tracks(input, progress);
    std::vector<Index> unended;
    std::vector<LayoutCurve>& curves = layout.curves.curves;
    curves = found.walls;
    for (const detail::Track& track : found.tracks) {
        if (!track.ended) unended.push_back(track.curve.first_vertex);
        curves.push_back(track.curve);
    }
    detail::require_short(unended, input.max_length);
    layout.curves.traced = static_cast<Index>(2 * found.walls.size() + found.tracks.size());
    for (LayoutCurve& curve : curves) detail::tighten(curve, input.local.charts());
    report_or_throw(progress, "cut", 0.9, NAN);
    detail::assemble(
        layout, input.points,
        std::make_shared<detail::LayoutPieces>(detail::layout_pieces(
            input.field, input.local, input.points, curves, [&](const CutSurface& cut) { return ends(cut, found); })));
    layout.largest_mismatch = mismatch(layout);
    return layout;
}

// For each patch that is no disk, a vertex of the surface to cut it from: on the boundary, or inside and apart from
// points, if there is one.
std::vector<Index> cuts_for(const QuadLayout& layout, const detail::LayoutInput& input) {
    std::vector<Index> result;
    const CutSurface& cut = layout.pieces->cut;
    const EdgeTopology& topology = layout.domain.topology();
    std::vector<bool> blocked(layout.domain.vertex_count(), false);
    const auto& is_point = input.points.of_vertex;
    for (Index e = 0; e < topology.edges.rows(); ++e)
        for (int k = 0; k < 2; ++k)
            if (is_point[topology.edges(e, k)] >= 0) blocked[topology.edges(e, 1 - k)] = true;
    for (std::size_t c = 0; c < cut.nodes.size(); ++c)
        if (cut.is_cut[c] && cut.nodes[c] < static_cast<Index>(blocked.size())) blocked[cut.nodes[c]] = true;
    for (std::size_t p = 0; p < layout.patches.size(); ++p) {
        if (layout.patches[p].euler_characteristic == 1) continue;
        const Index on_boundary = detail::boundary_cut(layout, layout.patches[p]);
        if (on_boundary >= 0) {
            result.push_back(on_boundary);
            continue;
        }
        Index lowest = layout.domain.vertex_count();
        for (const Index polygon : layout.pieces->patch_polygons[p])
            for (Index c = cut.first[polygon]; c < cut.first[polygon + 1]; ++c)
                if (cut.nodes[c] < lowest && !blocked[cut.nodes[c]] && is_point[cut.nodes[c]] < 0)
                    lowest = cut.nodes[c];
        if (lowest < layout.domain.vertex_count()) result.push_back(lowest);
    }
    return result;
}

QuadLayout graph_of_disks(const ImposedField& field, const LayoutCurveOptions& options, bool near,
                          const Progress& progress) {
    LayoutCurveOptions with_cuts = options;
    for (int round = 0;; ++round) {
        detail::LayoutInput input(field, with_cuts, true);
        input.points.near = near;
        QuadLayout layout = graph_with(input, progress);
        const std::vector<Index> cuts = cuts_for(layout, input);
        if (cuts.empty() || round == most_rounds) return layout;
        with_cuts.cut_vertices.insert(with_cuts.cut_vertices.end(), cuts.begin(), cuts.end());
    }
}

}  // namespace

// Separatrices of near points that face one another are joined only where they would cross otherwise.
QuadLayout motorcycle_graph(const ImposedField& field, const LayoutCurveOptions& options, const Progress& progress) {
    const auto all_quads = [](const QuadLayout& layout) {
        return std::all_of(layout.patches.begin(), layout.patches.end(),
                           [](const LayoutPatch& patch) { return patch.kind == PatchKind::quad; });
    };
    QuadLayout layout = graph_of_disks(field, options, false, progress);
    if (all_quads(layout)) return layout;
    QuadLayout other = graph_of_disks(field, options, true, progress);
    return all_quads(other) ? other : layout;
}

}  // namespace octafield::surface
