#include "octafield/surface/quantized_quads.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "arc_shortage.hpp"
#include "octafield/error.hpp"
#include "quad_builder.hpp"
#include "quad_smoother.hpp"
#include "tile_arcs.hpp"

namespace octafield::surface {
namespace {

constexpr double most_quads = 1e8;
constexpr int most_sizes = 6;         // tried for a number of quads
constexpr double near_enough = 0.02;  // of that

struct Chosen {
    detail::ArcCounts arcs;
    std::vector<int> part_counts{};
    double size = 0, quads = 0;
};

class Chooser {
public:
    Chooser(const QuadLayout& layout, const detail::Seams& seams, const QuantizedQuadsOptions& options)
        : layout_(layout), seams_(seams), options_(options), problem_(detail::arc_problem(layout, seams)) {
        if (!options.coarsest) return;
        detail::ArcProblem fewest = problem_;
        fewest.wanted.assign(problem_.least.size(), 0);
        fewest.weights.assign(problem_.least.size(), 1);
        problem_ =
            detail::split_problem(layout, seams, problem_, detail::integer_counts(fewest, options.most_nodes).counts);
    }

    Chosen at_size(double size) const {
        detail::ArcProblem problem = problem_;
        detail::set_size(problem, layout_, seams_, size, options_.weights);
        const double most = *std::max_element(problem.wanted.begin(), problem.wanted.end());
        if (!(most * most <= most_quads))
            throw InvalidInput("the edge length would give more than 1e8 quads", "bad_option");
        Chosen result{detail::integer_counts(problem, options_.most_nodes), {}, size, 0};
        result.part_counts.assign(result.arcs.counts.begin() + static_cast<std::ptrdiff_t>(layout_.sides.size()),
                                  result.arcs.counts.end());
        result.part_counts.resize(seams_.parts.size());
        result.arcs.counts.resize(layout_.sides.size());
        result.quads = detail::total_quads(layout_, result.arcs.counts);
        return result;
    }

    // Sizes by the square root of what is missing, between those with too many and too few.
    Chosen with_quads(double wanted) const {
        Chosen best;
        double low = 0, high = std::numeric_limits<double>::infinity();
        double size = std::sqrt(layout_.curves.parameter_area / wanted);
        for (int i = 0; i < most_sizes; ++i) {
            Chosen found = at_size(size);
            const double quads = found.quads;
            if (i == 0 || std::abs(quads - wanted) < std::abs(best.quads - wanted)) best = std::move(found);
            if (std::abs(quads - wanted) <= near_enough * wanted) break;
            (quads > wanted ? low : high) = size;
            size *= std::sqrt(quads / wanted);
            if (size <= low || size >= high)
                size = std::isinf(high) ? 1.5 * low : low > 0 ? std::sqrt(low * high) : high / 1.5;
        }
        return best;
    }

private:
    const QuadLayout& layout_;
    const detail::Seams& seams_;
    const QuantizedQuadsOptions& options_;
    detail::ArcProblem problem_;
};

Chosen choose(const QuadLayout& layout, const detail::Seams& seams, const QuantizedQuadsOptions& options) {
    const bool by_length = options.edge_length > 0 && std::isfinite(options.edge_length);
    if (by_length == (options.quad_count > 0) || !(options.edge_length >= 0) || options.quad_count < 0)
        throw InvalidInput("give either an edge length or a number of quads, > 0", "bad_option");
    if (options.smoothing < 0) throw InvalidInput("the number of rounds of smoothing is >= 0", "bad_option");
    if (options.most_nodes < 1) throw InvalidInput("branch and bound needs a node at least", "bad_option");
    const Chooser chooser(layout, seams, options);
    return by_length ? chooser.at_size(options.edge_length)
                     : chooser.with_quads(static_cast<double>(options.quad_count));
}

// Without any, each vertex is its own.
std::vector<Index> origins_of(const QuadLayout& layout, const std::vector<Index>& origins) {
    if (!origins.empty()) return origins;
    std::vector<Index> result(layout.domain.vertex_count());
    std::iota(result.begin(), result.end(), 0);
    return result;
}

void set_blocks(QuantizedQuads& result) {
    result.tiles = std::move(result.patches);
    BaseComplex complex = base_complex(result.mesh);
    result.patches = std::move(complex.blocks);
    result.patch_sizes = complex.block_sizes;
    result.patch_chords = complex.block_chords;
    result.chord_counts = std::move(complex.chord_counts);
    result.irregular = std::move(complex.irregular);
}

}  // namespace

QuantizedQuads quantized_quads(const QuadLayout& layout, const QuantizedQuadsOptions& options,
                               const Progress& progress) {
    if (!layout.pieces || layout.patches.empty()) throw InvalidInput("the layout has no patches", "bad_option");
    detail::require_quads(layout);
    report_or_throw(progress, "integers", 0, NAN);
    const detail::Seams seams = detail::find_seams(layout, origins_of(layout, options.origins));
    Chosen chosen = choose(layout, seams, options);
    if (!(chosen.quads <= most_quads)) throw InvalidInput("the size would give more than 1e8 quads", "bad_option");
    detail::SideGrids grids = detail::seamed_grids(layout, seams, chosen.arcs.counts, chosen.part_counts);
    const auto on_seams = grids.on_seams;
    detail::QuadBuilder builder(layout, std::move(grids));
    for (Index p = 0; p < static_cast<Index>(layout.patches.size()); ++p) {
        report_or_throw(progress, "map", 0.8 * p / static_cast<double>(layout.patches.size()), NAN);
        builder.add_patch(p);
    }
    QuantizedQuads result;
    static_cast<LayoutQuads&>(result) = std::move(builder).result();
    set_blocks(result);
    report_or_throw(progress, "smooth", 0.8, NAN);
    const detail::SmootherInput on_surface{
        layout, seams, on_seams, result.tiles, result.irregular, options.release_points};
    if (options.smoothing > 0) detail::smooth(on_surface, options.smoothing, result.mesh);
    detail::require_convex(result);
    if (const auto away = detail::facing_away(on_surface, result.mesh); !away.empty())
        throw SolverError("quads " + first_few(away) + " face against the surface; ask for smaller ones",
                          "inverted_quads", away);
    require_valid(result.mesh, false);
    for (const LayoutVertex& vertex : layout.vertices) result.t_joints += vertex.kind == LayoutVertexKind::t_joint;
    result.arc_counts = std::move(chosen.arcs.counts);
    result.size = chosen.size;
    result.deviation = chosen.arcs.deviation;
    result.bound = chosen.arcs.bound;
    result.optimal = chosen.arcs.optimal;
    return result;
}

std::vector<double> arc_shortages(const QuadLayout& layout, const std::vector<Index>& origins) {
    if (!layout.pieces || layout.patches.empty()) throw InvalidInput("the layout has no patches", "bad_option");
    detail::require_quads(layout);
    const detail::Seams seams = detail::find_seams(layout, origins_of(layout, origins));
    std::vector<double> result = detail::arc_shortages(detail::arc_problem(layout, seams));
    result.resize(layout.sides.size());
    return result;
}

}  // namespace octafield::surface
