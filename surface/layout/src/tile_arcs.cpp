#include "tile_arcs.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "held_bends.hpp"

namespace octafield::surface::detail {
namespace {

constexpr double part_weight = 0.25;  // against 1 of arcs

std::vector<Index> numbers(const std::vector<DirectedSide>& sides) {
    std::vector<Index> result;
    for (const DirectedSide& s : sides) result.push_back(s.side);
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

void require_bends(ArcProblem& problem, const QuadLayout& layout, const Seams& seams, double size) {
    const std::size_t first = layout.sides.size() + seams.parts.size();
    for (std::size_t s = 0; s < seams.seams.size(); ++s)
        if (seams.seams[s].length >= size && !bends(seams.seams[s]).empty())
            problem.least[first + s] = std::max(problem.least[first + s], 2);
}

ArcProblem split_problem(const QuadRows& rows, const ArcProblem& arcs) {
    ArcProblem problem = arcs;
    const auto known = static_cast<Index>(arcs.least.size());
    for (Index k = 0; k < rows.arcs(); ++k)
        problem.least[k] = std::min(problem.least[k], static_cast<int>(rows.on(k).size()));  // tracks that became one
    problem.least.resize(known + rows.count(), 1);
    std::erase_if(problem.sums,
                  [&](const EqualSums& sum) { return sum.left[0] < rows.arcs() && sum.right[0] < rows.arcs(); });
    for (Index k = 0; k < rows.arcs_and_parts(); ++k) {
        if (rows.is_on_seams(k)) continue;
        problem.sums.push_back({{k}, {}});
        for (const Index row : rows.on(k)) problem.sums.back().right.push_back(known + row);
    }
    return problem;
}

namespace {

// Of each patch: quads along its first two sides, and the mean of opposite lengths.
struct TileGrid {
    double counts[2] = {0, 0}, lengths[2] = {0, 0};
};

TileGrid grid_of(const QuadLayout& layout, const LayoutPatch& patch, const std::vector<int>& counts) {
    TileGrid result;
    const auto sides = four_sides(patch);
    for (int k = 0; k < 4; ++k)
        for (const DirectedSide& s : sides[k]) {
            result.lengths[k % 2] += layout.sides[s.side].length() / 2;
            if (k < 2) result.counts[k] += counts[s.side];
        }
    return result;
}

}  // namespace

double total_quads(const QuadLayout& layout, const std::vector<int>& counts) {
    double sum = 0;
    for (const LayoutPatch& patch : layout.patches) {
        const TileGrid grid = grid_of(layout, patch, counts);
        sum += grid.counts[0] * grid.counts[1];
    }
    return sum;
}

QuadsNear quads_near(const QuadLayout& layout, const std::vector<int>& counts) {
    QuadsNear result{std::vector<double>(layout.sides.size(), 0), 0};
    for (const LayoutPatch& patch : layout.patches) {
        const TileGrid grid = grid_of(layout, patch, counts);
        const auto sides = four_sides(patch);
        for (int k = 0; k < 2; ++k)
            for (const DirectedSide& s : sides[k]) result.factors[s.side] += grid.counts[1 - k];
        result.constant -= grid.counts[0] * grid.counts[1];
    }
    return result;
}

double unevenness(const QuadLayout& layout, const std::vector<int>& counts, double size) {
    double sum = 0, quads = 0;
    for (const LayoutPatch& patch : layout.patches) {
        const TileGrid grid = grid_of(layout, patch, counts);
        const double here = grid.counts[0] * grid.counts[1];
        quads += here;
        for (int k = 0; k < 2 && here > 0; ++k) {
            const double ratio = std::log(grid.lengths[k] / (grid.counts[k] * size));
            sum += here * ratio * ratio / 2;
        }
    }
    return std::sqrt(sum / std::max(1.0, quads));
}

}  // namespace octafield::surface::detail
