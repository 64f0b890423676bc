#include "octafield/surface/fixed_boundary_quads.hpp"

#include <algorithm>
#include <cmath>

#include "cover.hpp"
#include "even_regions.hpp"
#include "octafield/error.hpp"
#include "outline_segments.hpp"
#include "reform.hpp"
#include "smooth.hpp"

namespace octafield::surface {
namespace {

using namespace detail;

constexpr int sweeps_between = 4, sweeps_at_last = 40;

void require_options(const FixedBoundaryOptions& options) {
    const auto refuse = [](const char* what) { throw InvalidInput(what, "bad_option"); };
    if (!(options.edge_length >= 0) || std::isinf(options.edge_length)) refuse("edge_length is a number >= 0");
    if (!std::isfinite(options.rotation) || !std::isfinite(options.offset_x) || !std::isfinite(options.offset_y))
        refuse("rotation and offsets are finite numbers");
    if (!(options.clearance > 0.8) || std::isinf(options.clearance)) refuse("clearance is a number > 0.8");
    if (options.rounds < 0) refuse("rounds is a number >= 0");
}

double mean_segment(const PlanarOutline& outline) {
    double sum = 0;
    for (Index s = 0; s < outline.loops.rows(); ++s)
        sum += (outline.points.row(outline.loops(s, 1)) - outline.points.row(outline.loops(s, 0))).norm();
    return sum / static_cast<double>(outline.loops.rows());
}

Index improve(PlaneQuads& quads, const PatchFiller& filler, int rounds, const Progress& progress) {
    Reformer reformer(quads, filler);
    Index reformed = 0;
    for (int round = 0; round < rounds; ++round) {
        const auto ask = [&] {
            report_or_throw(progress, "forming quads anew", static_cast<double>(round) / rounds, reformed);
        };
        ask();
        const std::vector<Index> moved = smooth(quads, sweeps_between);
        for (const Index v : moved)
            for (const Index q : quads.quads_round(v)) reformer.touch(q);
        const Index exchanged = reformer.round(ask);
        reformed += exchanged;
        if (exchanged == 0) break;
    }
    if (rounds > 0) smooth(quads, sweeps_at_last);
    return reformed;
}

// Vertices without a quad go; those of the outline come first, in their order.
FixedBoundaryQuads gathered(const PlaneQuads& quads) {
    FixedBoundaryQuads result;
    std::vector<Index> name(quads.vertex_count(), -1), vertices, alive;
    for (Index v = 0; v < quads.vertex_count(); ++v)
        if (!quads.quads_round(v).empty() || quads.hold(v) == Hold::fixed) {
            name[v] = static_cast<Index>(vertices.size());
            vertices.push_back(v);
        }
    for (Index q = 0; q < quads.quad_slots(); ++q)
        if (quads.alive(q)) {
            if (quads.kept(q)) result.interior.push_back(static_cast<Index>(alive.size()));
            alive.push_back(q);
        }
    result.mesh.vertices = Points::Zero(static_cast<Eigen::Index>(vertices.size()), 3);
    for (std::size_t i = 0; i < vertices.size(); ++i)
        result.mesh.vertices.row(i).head<2>() = quads.point(vertices[i]).transpose();
    result.mesh.quads.resize(static_cast<Eigen::Index>(alive.size()), 4);
    for (std::size_t i = 0; i < alive.size(); ++i)
        for (int k = 0; k < 4; ++k) result.mesh.quads(i, k) = name[quads.quad(alive[i])[k]];
    return result;
}

void require_convex(const QuadMesh& mesh) {
    std::vector<Index> bad;
    for (Index q = 0; q < mesh.quads.rows(); ++q) {
        std::array<Vector2, 4> corners;
        for (int k = 0; k < 4; ++k) corners[k] = mesh.vertices.row(mesh.quads(q, k)).head<2>().transpose();
        if (deviation(corners) >= 1) bad.push_back(q);
    }
    if (bad.empty()) return;
    std::string where;
    for (int k = 0; k < 2; ++k) where += (k ? ", " : "") + std::to_string(mesh.vertices(mesh.quads(bad[0], 0), k));
    throw SolverError(
        std::to_string(bad.size()) + " quads are not convex, the first near (" + where +
            "): the outline leaves no room there, or bends too sharply. Divide its segments there, or try "
            "quads of another size inside, or in another place",
        "inverted_quads", bad);
}

}  // namespace

FixedBoundaryQuads fixed_boundary_quads(const PlanarOutline& outline, const QuadMesh& inside,
                                        const FixedBoundaryOptions& options, const Progress& progress) {
    require_options(options);
    require_planar(outline);
    report_or_throw(progress, "covering the channel", 0, std::nan(""));
    const Outline whole{outline.points, all_segments(outline), static_cast<Index>(outline.loops.rows())};
    const double edge_length = options.edge_length > 0 ? options.edge_length : mean_segment(outline);
    const InsideMesh given =
        inside.face_count() > 0 ? plane_quads_of(inside) : squares(outline.points, edge_length, options);
    const InsideMesh kept = trimmed(given, whole, options.clearance);
    const EvenOutline even = make_even(whole, kept, options.odd_loops);
    static const PatchFiller filler;
    PlaneQuads quads = covered(even, kept, filler);
    const Index reformed = improve(quads, filler, options.rounds, progress);
    FixedBoundaryQuads result = gathered(quads);
    require_convex(result.mesh);
    result.reformed = reformed;
    result.split = even.split;
    result.boundary = even.segments.topRows(even.loops);
    result.lines = even.segments.bottomRows(even.segments.rows() - even.loops);
    return result;
}

}  // namespace octafield::surface
