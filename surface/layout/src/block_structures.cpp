#include "block_structures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "octafield/error.hpp"
#include "quad_builder.hpp"

namespace octafield::surface::detail {
namespace {

constexpr double most_quads = 1e8;
constexpr int most_sizes = 6;                    // tried for a number of quads
constexpr double near_enough = 0.02;             // of that
constexpr double coarser = std::numbers::sqrt2;  // from size to size
constexpr std::size_t most_structures = 4;       // beside the finest

Index blocks_of(const QuadLayout& layout, const Seams& seams, const SizedCounts& chosen) {
    QuadBuilder builder(layout, seamed_grids(layout, seams, chosen.arcs.counts, chosen.part_counts));
    for (Index p = 0; p < static_cast<Index>(layout.patches.size()); ++p) builder.add_grid(p);
    return static_cast<Index>(base_complex(std::move(builder).result().mesh).block_sizes.rows());
}

SizedCounts counts_of(const QuadLayout& layout, const Seams& seams, ArcCounts arcs, double size) {
    SizedCounts result{std::move(arcs), {}, size, 0};
    result.part_counts.assign(result.arcs.counts.begin() + static_cast<std::ptrdiff_t>(layout.sides.size()),
                              result.arcs.counts.end());
    result.part_counts.resize(seams.parts.size());
    result.arcs.counts.resize(layout.sides.size());
    result.quads = total_quads(layout, result.arcs.counts);
    return result;
}

// Few of them, from the one of the fewest blocks to the one of the most.
std::vector<BlockStructure> spread(std::vector<BlockStructure> structures) {
    if (structures.size() <= most_structures) return structures;
    std::vector<BlockStructure> result;
    for (std::size_t i = 0; i < most_structures; ++i)
        result.push_back(std::move(structures[i * (structures.size() - 1) / (most_structures - 1)]));
    return result;
}

}  // namespace

SizedCounts CountChooser::at_size(const ArcProblem& sums, double size) const {
    ArcProblem problem = sums;
    set_size(problem, layout_, seams_, size, options_.weights);
    const double most = *std::max_element(problem.wanted.begin(), problem.wanted.end());
    if (!(most * most <= most_quads))
        throw InvalidInput("the edge length would give more than 1e8 quads", "bad_option");
    return counts_of(layout_, seams_, integer_counts(problem, options_.most_nodes), size);
}

SizedCounts CountChooser::with_quads(const ArcProblem& problem, double wanted) const {
    SizedCounts best;
    double low = 0, high = std::numeric_limits<double>::infinity();
    double size = std::sqrt(layout_.curves.parameter_area / wanted);
    for (int i = 0; i < most_sizes; ++i) {
        SizedCounts found = at_size(problem, size);
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

SizedCounts CountChooser::wanted(const ArcProblem& problem) const {
    SizedCounts result = options_.quad_count > 0 ? with_quads(problem, static_cast<double>(options_.quad_count))
                                                 : at_size(problem, options_.edge_length);
    if (!(result.quads <= most_quads)) throw InvalidInput("the size would give more than 1e8 quads", "bad_option");
    return result;
}

double CountChooser::first_size() const {
    if (options_.quad_count <= 0) return options_.edge_length;
    return std::sqrt(layout_.curves.parameter_area / static_cast<double>(options_.quad_count));
}

std::vector<BlockStructure> block_structures(const QuadLayout& layout, const Seams& seams,
                                             const QuantizedQuadsOptions& options) {
    const ArcProblem sums = arc_problem(layout, seams);
    const CountChooser chooser(layout, seams, options);
    std::vector<BlockStructure> result;
    const double longest = std::max_element(layout.sides.begin(), layout.sides.end(), [](const auto& a, const auto& b) {
                               return a.length() < b.length();
                           })->length();
    std::set<std::vector<int>> known;
    // Structures whose blocks cannot be told, or numbers that are not found in so many nodes, are left out.
    const auto add = [&](const SizedCounts& found) {
        std::vector<int> all = found.arcs.counts;
        all.insert(all.end(), found.part_counts.begin(), found.part_counts.end());
        if (!known.insert(all).second) return;
        try {
            result.push_back({split_problem(layout, seams, sums, all), blocks_of(layout, seams, found)});
        } catch (const GeometryError&) {
        }
    };
    if (options.blocks == Blocks::few) {
        for (double size = chooser.first_size() * coarser; size < longest * coarser; size *= coarser) try {
                add(chooser.at_size(sums, size));
            } catch (const SolverError&) {
            }
        ArcProblem coarsest = sums;
        coarsest.wanted.assign(sums.least.size(), 0);
        coarsest.weights.assign(sums.least.size(), 1);
        add(counts_of(layout, seams, integer_counts(coarsest, options.most_nodes), longest));
        std::stable_sort(result.begin(), result.end(),
                         [](const BlockStructure& a, const BlockStructure& b) { return a.blocks < b.blocks; });
        // Of as many blocks, the first are nearest to the lengths.
        result.erase(std::unique(result.begin(), result.end(),
                                 [](const auto& a, const auto& b) { return a.blocks == b.blocks; }),
                     result.end());
        result = spread(std::move(result));
    }
    result.push_back({sums, BlockStructure::finest});
    return result;
}

}  // namespace octafield::surface::detail
