#include <algorithm>
#include <string>

#include "arc_counts.hpp"
#include "block_grids.hpp"
#include "octafield/error.hpp"
#include "octafield/volume/all_hex.hpp"

namespace octafield::volume {

ArcNumbers arc_numbers(const BlockComplex& blocks, double scale, const std::vector<int>& least, int most_nodes) {
    if (least.size() != blocks.arcs.size())
        throw InvalidInput("least: " + std::to_string(least.size()) + " numbers for " +
                               std::to_string(blocks.arcs.size()) + " arcs; give one for each",
                           "wrong_size");
    surface::detail::ArcProblem problem;
    problem.least = least;
    problem.preprocess = false;
    for (const BlockArc& arc : blocks.arcs) {
        problem.wanted.push_back(scale * arc.length());
        problem.weights.push_back(1 / std::max(problem.wanted.back(), 0.5));
    }
    const auto arcs_of = [](const std::vector<SideArc>& side) {
        std::vector<Index> arcs;
        for (const SideArc& part : side) arcs.push_back(part.arc);
        return arcs;
    };
    for (const BlockPatch& patch : blocks.patches)
        for (const int s : {0, 2}) problem.sums.push_back({arcs_of(patch.sides[s]), arcs_of(patch.sides[s + 1])});
    const surface::detail::ArcCounts found = surface::detail::integer_counts(problem, most_nodes);
    ArcNumbers result{found.counts, found.deviation, found.bound, 0};
    for (const detail::Vector3i& size : detail::block_grids(blocks, result.numbers).sizes)
        result.hexahedra += size.cast<std::int64_t>().prod();
    return result;
}

}  // namespace octafield::volume
