#include "octafield/surface/quantized_quads.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <numeric>

#include "arc_shortage.hpp"
#include "block_structures.hpp"
#include "even_sides.hpp"
#include "held_bends.hpp"
#include "merged_vertices.hpp"
#include "octafield/error.hpp"
#include "quad_builder.hpp"
#include "quad_smoother.hpp"
#include "tile_arcs.hpp"

namespace octafield::surface {
namespace {

constexpr double as_bad = 0.8;           // of the best least scaled Jacobian, where all are bad
constexpr double most_inverted = 0.04;   // of the quads, before smoothing
constexpr double most_left = 0.01;       // after all were moved at once
constexpr std::size_t most_rescued = 2;  // unless all of these have inverted quads

void check(const QuantizedQuadsOptions& options, Index edges) {
    const bool by_length = options.edge_length > 0 && std::isfinite(options.edge_length);
    if (by_length == (options.quad_count > 0) || !(options.edge_length >= 0) || options.quad_count < 0)
        throw InvalidInput("give either an edge length or a number of quads, > 0", "bad_option");
    if (!(options.least_jacobian >= 0 && options.least_jacobian <= 1))
        throw InvalidInput("the least scaled Jacobian wanted lies between 0 and 1", "bad_option");
    if (options.smoothing < 0) throw InvalidInput("the number of rounds of smoothing is >= 0", "bad_option");
    if (options.most_nodes < 1) throw InvalidInput("branch and bound needs a node at least", "bad_option");
    if (options.follow.size() == 0) return;
    if (options.measure != ArcMeasure::lengths || options.smoothing == 0)
        throw InvalidInput("a field is followed by quads that are measured by lengths and smoothed", "bad_option");
    if (options.follow.size() != edges || !options.follow.allFinite())
        throw InvalidInput("the field to follow has a finite value for each edge of the layout's surface",
                           "bad_option");
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

// Other quads may do better: not where the caller is to blame, or stops.
bool is_of_quads(const Error& error) {
    return dynamic_cast<const SolverError*>(&error) || dynamic_cast<const GeometryError*>(&error);
}

// Quads of one structure of blocks.
struct Attempt {
    QuantizedQuads quads{};
    std::vector<detail::SideGrids::OnSeam> on_seams{};
    bool rescued = false;
    bool fair = false;  // no bad quads, but for angles of features
    double least = 0;   // scaled Jacobian
    double margin = 0;  // of the least scaled Jacobian over the one wanted, where the angles of features allow that
};

double inverted_share(const Attempt& attempt) {
    return (scaled_jacobians(attempt.quads.mesh).array() <= 0).cast<double>().mean();
}

class Maker {
public:
    Maker(const QuadLayout& layout, const detail::Seams& seams, const QuantizedQuadsOptions& options,
          const Progress& progress)
        : layout_(layout), seams_(seams), options_(options), progress_(progress), parts_(layout) {}

    // The fewest blocks with quads as good as wanted; else the fewest with quads nearly as good as the best.
    QuantizedQuads fewest_of(const std::vector<detail::BlockStructure>& structures) {
        const auto first_rescue = options_.blocks == Blocks::few            ? detail::Rescue::where_few
                                  : options_.measure == ArcMeasure::lengths ? detail::Rescue::near_them
                                                                            : detail::Rescue::everywhere;
        std::vector<Attempt> attempts;
        std::exception_ptr finest_error;
        for (const detail::BlockStructure& structure : structures) {
            try {
                attempts.push_back(made(structure, first_rescue));
                if (structure.blocks == detail::BlockStructure::finest) break;
                if (attempts.back().margin >= 0 && is_valid(attempts.back())) return std::move(attempts.back().quads);
            } catch (const Error& error) {
                if (!is_of_quads(error)) throw;
                error_ = std::current_exception();
                if (structure.blocks == detail::BlockStructure::finest) finest_error = error_;
            }
        }
        rescue_best(attempts, structures.back());
        // Of tracks that have to become one for numbers to fit, only good quads are worth having: other points do
        // better.
        if (finest_error && std::none_of(attempts.begin(), attempts.end(), [](const Attempt& a) { return a.fair; }))
            std::rethrow_exception(finest_error);
        return best_of(std::move(attempts));
    }

    // Of each quad.
    std::vector<Index> faces_of(const QuantizedQuads& quads) const {
        std::vector<Index> result;
        for (const Index tile : quads.tiles) result.push_back(parts_.part_of(layout_.patches[tile]));
        return result;
    }

private:
    Attempt made(const detail::BlockStructure& structure, detail::Rescue rescue) const {
        const detail::CountChooser chooser(layout_, seams_, options_);
        detail::SizedCounts chosen =
            chooser.nearer(structure.problem, chooser.wanted(structure.problem, chooser.first_size()));
        detail::SideGrids grids = detail::seamed_grids(layout_, seams_, chosen.arcs.counts, chosen.part_counts);
        Attempt result;
        result.on_seams = grids.on_seams;
        detail::QuadBuilder builder(layout_, std::move(grids));
        for (Index p = 0; p < static_cast<Index>(layout_.patches.size()); ++p) {
            report_or_throw(progress_, "map", 0.8 * p / static_cast<double>(layout_.patches.size()), NAN);
            builder.add_patch(p);
        }
        QuantizedQuads& quads = result.quads;
        const auto same = builder.same();
        const auto held = builder.held();
        static_cast<LayoutQuads&>(quads) = std::move(builder).result();
        if (!same.empty()) detail::merge_vertices(seams_, same, held, quads.mesh, result.on_seams);
        if (options_.measure == ArcMeasure::lengths) detail::hold_bends(seams_, quads.mesh, result.on_seams);
        set_blocks(quads);
        quads.arc_counts = std::move(chosen.arcs.counts);
        quads.part_counts = std::move(chosen.part_counts);
        quads.size = chosen.size;
        quads.deviation = chosen.arcs.deviation;
        quads.bound = chosen.arcs.bound;
        quads.optimal = chosen.arcs.optimal;
        smooth(result, rescue, !same.empty(), structure.blocks == detail::BlockStructure::finest);
        return result;
    }

    detail::SmootherInput input_of(Attempt& attempt) const {
        return {layout_,
                parts_,
                seams_,
                attempt.on_seams,
                attempt.quads.tiles,
                attempt.quads.irregular,
                options_.release_points,
                {layout_.domain, options_.follow}};
    }

    // From where the maps have the vertices (not where some were merged: that is too far from where they belong), or
    // from there for sizes as well, and where that leaves bad quads from where they are when relaxed, or all moved at
    // once. The best is kept.
    void smooth(Attempt& attempt, detail::Rescue rescue, bool merged, bool finest) const {
        report_or_throw(progress_, "smooth", 0.8, NAN);
        if (options_.smoothing == 0) return judge(attempt);
        const Attempt start = attempt;
        attempt.margin = -std::numeric_limits<double>::infinity();
        for (const detail::Start from : starts(merged, finest)) {
            if (from == detail::Start::held && attempt.margin > -detail::bad) return;  // none is inverted
            Attempt other = start;
            detail::prepare(input_of(other), from, other.quads.mesh);
            const double most = from == detail::Start::untangled ? most_left : most_inverted;
            if (!finest && inverted_share(other) > most) continue;
            smooth_further(other, rescue);
            if (other.margin > attempt.margin) attempt = std::move(other);
            if (attempt.margin >= 0) return;
        }
        if (std::isinf(attempt.margin))
            throw SolverError("the structure of blocks inverts too many quads", "inverted_quads");
    }

    std::vector<detail::Start> starts(bool merged, bool finest) const {
        using detail::Start;
        if (options_.measure == ArcMeasure::lengths) return {Start::evened, Start::held};
        if (finest) return {Start::mapped};
        std::vector<Start> result = {Start::relaxed, Start::untangled};
        if (!merged) result.insert(result.begin(), Start::mapped);
        if (options_.release_points) result.push_back(Start::freed);
        return result;
    }

    void smooth_further(Attempt& attempt, detail::Rescue rescue) const {
        attempt.rescued = detail::smooth(input_of(attempt), options_.smoothing, rescue, attempt.quads.mesh);
        judge(attempt);
    }

    void judge(Attempt& attempt) const {
        const detail::SmootherInput input = input_of(attempt);
        attempt.margin = detail::least_margin(input, options_.least_jacobian, attempt.quads.mesh);
        attempt.fair = attempt.margin >= 0 || detail::least_margin(input, detail::bad, attempt.quads.mesh) >= 0;
        attempt.least = scaled_jacobians(attempt.quads.mesh).minCoeff();
    }

    bool is_valid(Attempt& attempt) {
        try {
            detail::require_convex(attempt.quads);
            if (const auto away = detail::facing_away(input_of(attempt), attempt.quads.mesh); !away.empty())
                throw SolverError("quads " + first_few(away) + " face against the surface; ask for smaller ones",
                                  "inverted_quads", away);
            require_valid(attempt.quads.mesh, false);
        } catch (const Error&) {
            error_ = std::current_exception();
            return false;
        }
        return true;
    }

    // The two with the best quads, more if all are inverted; and if none is fair, what `fine` makes: everything is
    // moved once more where quads are bad.
    void rescue_best(std::vector<Attempt>& attempts, const detail::BlockStructure& finest) {
        std::vector<Attempt*> order;
        for (Attempt& attempt : attempts) order.push_back(&attempt);
        std::stable_sort(order.begin(), order.end(),
                         [](const auto* a, const auto* b) { return a->margin > b->margin; });
        bool any_fair = false;
        double best = -1;
        for (std::size_t i = 0; i < order.size() && (i < most_rescued ? !any_fair : best <= 0); ++i) {
            if (!order[i]->rescued && !order[i]->fair) smooth_further(*order[i], detail::Rescue::near_them);
            any_fair |= order[i]->fair;
            best = std::max(best, order[i]->least);
        }
        if (!any_fair && options_.blocks == Blocks::few) try {
                attempts.push_back(made(finest, detail::Rescue::everywhere));
            } catch (const Error& error) {
                if (!is_of_quads(error)) throw;
                error_ = std::current_exception();
            }
        if (!attempts.empty() && attempts.back().least <= 0)
            smooth_further(attempts.back(), detail::Rescue::everywhere);
    }

    QuantizedQuads best_of(std::vector<Attempt> attempts) {
        bool any_fair = false;
        double best = -1;
        for (const Attempt& attempt : attempts) any_fair |= attempt.fair;
        for (const Attempt& attempt : attempts)
            if (attempt.fair >= any_fair) best = std::max(best, attempt.least);
        const double needed = best < detail::bad ? as_bad * best : detail::bad;
        std::stable_sort(attempts.begin(), attempts.end(), [](const Attempt& a, const Attempt& b) {
            return a.quads.patch_sizes.rows() < b.quads.patch_sizes.rows();
        });
        for (Attempt& attempt : attempts)
            if (attempt.fair >= any_fair && attempt.least >= needed && is_valid(attempt))
                return std::move(attempt.quads);
        std::stable_sort(attempts.begin(), attempts.end(),
                         [](const Attempt& a, const Attempt& b) { return a.least > b.least; });
        for (Attempt& attempt : attempts)
            if (is_valid(attempt)) return std::move(attempt.quads);
        std::rethrow_exception(error_);
    }

    const QuadLayout& layout_;
    const detail::Seams& seams_;
    const QuantizedQuadsOptions& options_;
    const Progress& progress_;
    detail::SurfaceParts parts_;
    std::exception_ptr error_;  // the last one
};

}  // namespace

QuantizedQuads quantized_quads(const QuadLayout& given, const QuantizedQuadsOptions& options,
                               const Progress& progress) {
    if (!given.pieces || given.patches.empty()) throw InvalidInput("the layout has no patches", "bad_option");
    detail::require_quads(given);
    check(options, given.domain.edge_count());
    report_or_throw(progress, "integers", 0, NAN);
    const QuadLayout layout =
        options.measure == ArcMeasure::lengths ? detail::with_lengths_for_parameters(given) : given;
    const detail::Seams seams = detail::find_seams(layout, origins_of(layout, options.origins));
    const auto structures = detail::block_structures(layout, seams, options);
    Maker maker(layout, seams, options, progress);
    QuantizedQuads result = maker.fewest_of(structures);
    result.fewest_blocks = fewest_blocks(result.mesh, maker.faces_of(result));
    result.coarsest_blocks = std::min(structures.front().blocks, static_cast<Index>(result.patch_sizes.rows()));
    for (const LayoutVertex& vertex : layout.vertices) result.t_joints += vertex.kind == LayoutVertexKind::t_joint;
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
