#include "tile_arcs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "octafield/disjoint_sets.hpp"

namespace octafield::surface::detail {
namespace {

constexpr double part_weight = 0.25;  // against 1 of arcs

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

// Of the pieces that arcs and parts of seams are made of, first[k] on, in the sense of the patch's border.
std::vector<Index> pieces_along(const std::vector<DirectedSide>& sides, const Seams& seams,
                                const std::vector<Index>& first, const std::vector<int>& counts) {
    const auto arcs = static_cast<Index>(seams.uses.size());
    std::vector<Index> result;
    const auto add = [&](Index k, bool forward) {
        for (Index i = 0; i < counts[k]; ++i) result.push_back(first[k] + (forward ? i : counts[k] - 1 - i));
    };
    for (const DirectedSide& s : sides) {
        auto uses = seams.uses[s.side];
        if (s.reversed) std::reverse(uses.begin(), uses.end());
        for (const SeamUse& use : uses) add(arcs + use.part, use.forward != s.reversed);
        if (uses.empty()) add(s.side, !s.reversed);
    }
    return result;
}

void add_seams(const Seams& seams, Index arcs, ArcProblem& problem) {
    const auto parts = static_cast<Index>(seams.parts.size());
    problem.least.resize(arcs + parts, 0);
    std::map<std::pair<Index, Index>, int> between;
    const auto ends = [](const Seam& seam) { return std::minmax(seam.stops.front().node, seam.stops.back().node); };
    for (const Seam& seam : seams.seams) ++between[ends(seam)];
    for (std::size_t s = 0; s < seams.seams.size(); ++s) {
        const Seam& seam = seams.seams[s];
        const auto [a, b] = ends(seam);
        problem.least.push_back(a == b ? 3 : between[{a, b}] > 1 ? 2 : 1);
        problem.sums.push_back({{arcs + parts + static_cast<Index>(s)}, {}});
        for (Index i = 0; i < seam.part_count(); ++i) problem.sums.back().right.push_back(arcs + seam.first_part + i);
    }
    for (Index a = 0; a < arcs; ++a) {
        if (seams.uses[a].empty()) continue;
        problem.sums.push_back({{a}, {}});
        for (const SeamUse& use : seams.uses[a]) problem.sums.back().right.push_back(arcs + use.part);
    }
}

}  // namespace

ArcProblem arc_problem(const QuadLayout& layout, const Seams& seams) {
    return arc_problem(std::vector<const QuadLayout*>{&layout}, seams);
}

ArcProblem arc_problem(const std::vector<const QuadLayout*>& layouts, const Seams& seams) {
    ArcProblem problem;
    for (const QuadLayout* layout : layouts) {
        const auto first = static_cast<Index>(problem.least.size());
        const auto all = [&](const std::vector<DirectedSide>& sides) {
            std::vector<Index> result = numbers(sides);
            for (Index& side : result) side += first;
            return result;
        };
        std::map<std::pair<Index, Index>, std::vector<Index>> between;
        for (std::size_t s = 0; s < layout->sides.size(); ++s)
            between[std::minmax(layout->sides[s].first, layout->sides[s].last)].push_back(static_cast<Index>(s));
        problem.least.resize(problem.least.size() + layout->sides.size(), 1);
        for (const auto& [ends, arcs] : between)
            for (const Index arc : arcs)
                problem.least[first + arc] = ends.first == ends.second ? 3 : arcs.size() > 1 ? 2 : 1;
        for (const LayoutPatch& patch : layout->patches) {
            const auto sides = four_sides(patch);
            for (int k = 0; k < 2; ++k) problem.sums.push_back({all(sides[k]), all(sides[k + 2])});
        }
    }
    add_seams(seams, static_cast<Index>(problem.least.size()), problem);
    return problem;
}

void set_size(ArcProblem& problem, const QuadLayout& layout, const Seams& seams, double size, ArcWeights weights) {
    set_size(problem, std::vector<const QuadLayout*>{&layout}, seams, size, weights);
}

void set_size(ArcProblem& problem, const std::vector<const QuadLayout*>& layouts, const Seams& seams, double size,
              ArcWeights weights) {
    problem.wanted.clear();
    problem.weights.clear();
    const auto add = [&](double length, double weight) {
        problem.wanted.push_back(length / size);
        problem.weights.push_back(weight / (weights == ArcWeights::equal ? 1 : std::max(1.0, length / size)));
    };
    for (const QuadLayout* layout : layouts)
        for (const LayoutSide& side : layout->sides) add(side.length(), 1);
    for (const SeamPart& part : seams.parts) add(part.parameters, part_weight);
    problem.wanted.resize(problem.least.size(), 1);
    problem.weights.resize(problem.least.size(), 0);
}

ArcProblem split_problem(const QuadLayout& layout, const Seams& seams, const ArcProblem& arcs,
                         const std::vector<int>& counts) {
    const auto arc_count = static_cast<Index>(layout.sides.size());
    const auto made_of_pieces = arc_count + static_cast<Index>(seams.parts.size());
    std::vector<Index> first(made_of_pieces + 1, 0);
    for (Index k = 0; k < made_of_pieces; ++k) {
        const bool on_seam = k < arc_count && !seams.uses[k].empty();
        first[k + 1] = first[k] + (on_seam ? 0 : counts[k]);
    }
    DisjointSets sets(first.back());
    for (const LayoutPatch& patch : layout.patches) {
        const auto sides = four_sides(patch);
        for (int k = 0; k < 2; ++k) {
            const auto near = pieces_along(sides[k], seams, first, counts);
            const auto far = pieces_along(sides[k + 2], seams, first, counts);
            for (std::size_t i = 0; i < near.size(); ++i) sets.join(near[i], far[far.size() - 1 - i]);
        }
    }
    Index rows = 0;
    const std::vector<Index> row_of = std::move(sets).numbers(rows);
    ArcProblem problem = arcs;
    const auto known = static_cast<Index>(arcs.least.size());
    problem.least.resize(known + rows, 1);
    std::erase_if(problem.sums,
                  [&](const EqualSums& sum) { return sum.left[0] < arc_count && sum.right[0] < arc_count; });
    for (Index k = 0; k < made_of_pieces; ++k) {
        if (k < arc_count && !seams.uses[k].empty()) continue;
        problem.sums.push_back({{k}, {}});
        for (Index i = first[k]; i < first[k + 1]; ++i) problem.sums.back().right.push_back(known + row_of[i]);
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
