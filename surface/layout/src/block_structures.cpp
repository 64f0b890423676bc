#include "block_structures.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>

#include "merged_vertices.hpp"
#include "octafield/error.hpp"
#include "quad_builder.hpp"
#include "zero_arcs.hpp"

namespace octafield::surface::detail {
namespace {

constexpr double coarser = std::numbers::sqrt2;  // from size to size
constexpr int structure_nodes = 50;
constexpr std::size_t most_structures = 6;  // beside the finest
constexpr int most_rounds = 20;             // of numbers that merge what must not be one

// Few of them, from the one of the fewest blocks to the one of the most.
std::vector<BlockStructure> spread(std::vector<BlockStructure> structures) {
    if (structures.size() <= most_structures) return structures;
    std::vector<BlockStructure> result;
    for (std::size_t i = 0; i < most_structures; ++i)
        result.push_back(std::move(structures[i * (structures.size() - 1) / (most_structures - 1)]));
    return result;
}

// Any numbers that fit do for a structure.
QuantizedQuadsOptions with_few_nodes(QuantizedQuadsOptions options) {
    options.most_nodes = std::min(options.most_nodes, structure_nodes);
    return options;
}

ArcProblem problem_of(const QuadLayout& layout, const Seams& seams, const QuantizedQuadsOptions& options) {
    ArcProblem result = arc_problem(layout, seams);
    result.even = options.measure == ArcMeasure::lengths;
    if (options.measure == ArcMeasure::lengths)
        require_bends(result, layout, seams, CountChooser(layout, seams, options).first_size());
    return result;
}

// Structures that whole numbers for large quads make.
class Finder {
public:
    Finder(const QuadLayout& layout, const Seams& seams, const QuantizedQuadsOptions& options)
        : layout_(layout),
          seams_(seams),
          options_(with_few_nodes(options)),
          sums_(problem_of(layout, seams, options)),
          merging_(sums_),
          chooser_(layout, seams, options_) {
        const auto arcs = static_cast<Index>(layout.sides.size());
        for (Index a = 0; a < arcs; ++a)
            if (layout.sides[a].first != layout.sides[a].last) merging_.least[a] = 0;
    }

    void find() {
        double longest = 0;
        for (const LayoutSide& side : layout_.sides) longest = std::max(longest, side.length());
        for (double size = chooser_.first_size() * coarser; size < longest * coarser; size *= coarser)
            add([&](const ArcProblem& problem) { return chooser_.at_size(problem, size); });
        add([&](ArcProblem coarsest) {
            coarsest.wanted.assign(coarsest.least.size(), 0);
            coarsest.weights.assign(coarsest.least.size(), 1);
            return counts_of(layout_, seams_, integer_counts(coarsest, options_.most_nodes), longest);
        });
    }
    // Of the size wanted, where tracks between which less than half a quad would be become one. What must not be one is
    // found with numbers for one size in each round, before sizes are tried for the number of quads.
    void find_merged() {
        double size = chooser_.first_size();
        std::optional<SizedCounts> found = merged([&](const ArcProblem& problem) {
            SizedCounts counts = chooser_.at_size(problem, size);
            size = chooser_.next_size(counts);
            return counts;
        });
        if (found) found = merged([&](const ArcProblem& problem) { return chooser_.wanted(problem, size); });
        if (found) add(chooser_.nearer(merging_, std::move(*found)));
    }
    const ArcProblem& sums() const { return sums_; }
    std::vector<BlockStructure> result() && { return std::move(result_); }

private:
    // With a quad at least on each arc, and without, until nothing becomes one that must not.
    template <class Counts>
    void add(const Counts& counts) {
        // No numbers, or none found in so many nodes, or blocks that cannot be told: there are other structures.
        try {
            add(counts(sums_));
        } catch (const GeometryError&) {
        } catch (const SolverError&) {
        }
        if (const auto found = merged(counts)) add(*found);
    }

    // None where there are none, or too many rounds are needed.
    template <class Counts>
    std::optional<SizedCounts> merged(const Counts& counts) {
        try {
            for (int round = 0; round < most_rounds; ++round) {
                SizedCounts found = counts(merging_);
                const auto wrong = wrongly_merged(layout_, seams_, found.arcs.counts, found.part_counts);
                if (wrong.empty()) return found;
                for (const std::vector<Index>& way : wrong) {
                    merging_.sums.push_back({{static_cast<Index>(merging_.least.size())}, way});
                    merging_.least.push_back(1);
                }
            }
        } catch (const GeometryError&) {
        } catch (const SolverError&) {
        }
        return {};
    }

    void add(const SizedCounts& found) {
        std::vector<int> counts = found.arcs.counts;
        counts.insert(counts.end(), found.part_counts.begin(), found.part_counts.end());
        if (!known_.insert(counts).second) return;
        SideGrids grids = seamed_grids(layout_, seams_, found.arcs.counts, found.part_counts);
        auto on_seams = grids.on_seams;
        QuadBuilder builder(layout_, std::move(grids));
        for (Index p = 0; p < static_cast<Index>(layout_.patches.size()); ++p) builder.add_grid(p);
        const auto same = builder.same();
        const auto held = builder.held();
        QuadMesh mesh = std::move(builder).result().mesh;
        if (!is_as_expected(mesh.quads, same, held, static_cast<Index>(seams_.nodes.size()),
                            static_cast<Index>(mesh.vertices.rows())))
            return;
        merge_vertices(seams_, same, held, mesh, on_seams);
        const auto blocks = static_cast<Index>(base_complex(mesh).block_sizes.rows());
        result_.push_back({split_problem(QuadRows(layout_, seams_, counts), sums_), blocks});
    }

    const QuadLayout& layout_;
    const Seams& seams_;
    const QuantizedQuadsOptions options_;
    const ArcProblem sums_;
    ArcProblem merging_;
    CountChooser chooser_;
    std::set<std::vector<int>> known_;
    std::vector<BlockStructure> result_;
};

}  // namespace

std::vector<BlockStructure> block_structures(const QuadLayout& layout, const Seams& seams,
                                             const QuantizedQuadsOptions& options) {
    Finder finder(layout, seams, options);
    const ArcProblem finest = finder.sums();
    std::vector<BlockStructure> result;
    if (options.blocks == Blocks::few) {
        finder.find();
        result = std::move(finder).result();
        std::stable_sort(result.begin(), result.end(),
                         [](const BlockStructure& a, const BlockStructure& b) { return a.blocks < b.blocks; });
        // Of as many blocks, the first are nearest to the lengths.
        result.erase(std::unique(result.begin(), result.end(),
                                 [](const auto& a, const auto& b) { return a.blocks == b.blocks; }),
                     result.end());
        result = spread(std::move(result));
    }
    if (options.blocks == Blocks::fine && options.measure == ArcMeasure::lengths) {
        finder.find_merged();
        result = std::move(finder).result();
    }
    result.push_back({finest});
    return result;
}

}  // namespace octafield::surface::detail
