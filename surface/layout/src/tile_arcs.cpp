#include "tile_arcs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

#include "octafield/disjoint_sets.hpp"

namespace octafield::surface::detail {
namespace {

std::array<std::vector<DirectedSide>, 4> four_sides(const LayoutPatch& patch) {
    std::array<std::vector<DirectedSide>, 4> result;
    const auto& loop = patch.loops[0];
    for (int k = 0; k < 4; ++k) {
        const Index end = k < 3 ? patch.corner_sides[k + 1] : static_cast<Index>(loop.size());
        result[k].assign(loop.begin() + patch.corner_sides[k], loop.begin() + end);
    }
    return result;
}

std::vector<Index> numbers(const std::vector<DirectedSide>& sides) {
    std::vector<Index> result;
    for (const DirectedSide& s : sides) result.push_back(s.side);
    return result;
}

// Of the pieces along each arc, from first[arc] on, in the sense of the patch's border.
std::vector<Index> pieces_along(const std::vector<DirectedSide>& sides, const std::vector<Index>& first,
                                const std::vector<int>& counts) {
    std::vector<Index> result;
    for (const DirectedSide& s : sides)
        for (Index i = 0; i < counts[s.side]; ++i)
            result.push_back(first[s.side] + (s.reversed ? counts[s.side] - 1 - i : i));
    return result;
}

}  // namespace

ArcProblem arc_problem(const QuadLayout& layout) {
    ArcProblem problem;
    problem.least.assign(layout.sides.size(), 1);
    std::map<std::pair<Index, Index>, std::vector<Index>> between;
    for (std::size_t s = 0; s < layout.sides.size(); ++s)
        between[std::minmax(layout.sides[s].first, layout.sides[s].last)].push_back(static_cast<Index>(s));
    for (const auto& [ends, arcs] : between)
        for (const Index arc : arcs) problem.least[arc] = ends.first == ends.second ? 3 : arcs.size() > 1 ? 2 : 1;
    for (const LayoutPatch& patch : layout.patches) {
        const auto sides = four_sides(patch);
        for (int k = 0; k < 2; ++k) problem.sums.push_back({numbers(sides[k]), numbers(sides[k + 2])});
    }
    return problem;
}

void set_size(ArcProblem& problem, const QuadLayout& layout, double size, ArcWeights weights) {
    problem.wanted.clear();
    problem.weights.clear();
    for (const LayoutSide& side : layout.sides) {
        problem.wanted.push_back(side.length() / size);
        problem.weights.push_back(weights == ArcWeights::equal ? 1 : 1 / std::max(1.0, problem.wanted.back()));
    }
}

ArcProblem split_problem(const QuadLayout& layout, const ArcProblem& arcs, const std::vector<int>& counts) {
    std::vector<Index> first(counts.size() + 1, 0);
    std::partial_sum(counts.begin(), counts.end(), first.begin() + 1);
    DisjointSets sets(first.back());
    for (const LayoutPatch& patch : layout.patches) {
        const auto sides = four_sides(patch);
        for (int k = 0; k < 2; ++k) {
            const auto near = pieces_along(sides[k], first, counts), far = pieces_along(sides[k + 2], first, counts);
            for (std::size_t i = 0; i < near.size(); ++i) sets.join(near[i], far[far.size() - 1 - i]);
        }
    }
    Index rows = 0;
    const std::vector<Index> row_of = std::move(sets).numbers(rows);
    ArcProblem problem = arcs;
    problem.sums.clear();
    const auto arc_count = static_cast<Index>(counts.size());
    problem.wanted.resize(arc_count + rows, 1);
    problem.weights.resize(arc_count + rows, 0);
    problem.least.resize(arc_count + rows, 1);
    for (Index a = 0; a < arc_count; ++a) {
        problem.sums.push_back({{a}, {}});
        for (Index i = first[a]; i < first[a + 1]; ++i) problem.sums.back().right.push_back(arc_count + row_of[i]);
    }
    return problem;
}

double total_quads(const QuadLayout& layout, const std::vector<int>& counts) {
    double sum = 0;
    for (const LayoutPatch& patch : layout.patches) {
        const auto sides = four_sides(patch);
        double along[2] = {0, 0};
        for (int k = 0; k < 2; ++k)
            for (const DirectedSide& s : sides[k]) along[k] += counts[s.side];
        sum += along[0] * along[1];
    }
    return sum;
}

}  // namespace octafield::surface::detail
