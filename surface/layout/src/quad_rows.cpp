#include "quad_rows.hpp"

#include <algorithm>

#include "octafield/disjoint_sets.hpp"

namespace octafield::surface::detail {

std::array<std::vector<DirectedSide>, 4> four_sides(const LayoutPatch& patch) {
    std::array<std::vector<DirectedSide>, 4> result;
    const auto& loop = patch.loops[0];
    for (int k = 0; k < 4; ++k) {
        const Index end = k < 3 ? patch.corner_sides[k + 1] : static_cast<Index>(loop.size());
        result[k].assign(loop.begin() + patch.corner_sides[k], loop.begin() + end);
    }
    return result;
}

QuadRows::QuadRows(const QuadLayout& layout, const Seams& seams, std::vector<int> counts)
    : layout_(layout), seams_(seams), counts_(std::move(counts)), first_(counts_.size() + 1, 0) {
    for (std::size_t k = 0; k < counts_.size(); ++k)
        first_[k + 1] = first_[k] + (is_on_seams(static_cast<Index>(k)) ? 0 : counts_[k]);
    row_of_.resize(first_.back());
    for (std::size_t i = 0; i < row_of_.size(); ++i) row_of_[i] = static_cast<Index>(i);
    DisjointSets sets(row_of_.size());
    for (const LayoutPatch& patch : layout.patches) {
        const auto sides = four_sides(patch);
        for (int k = 0; k < 2; ++k) {
            const auto near = along(sides[k]), far = along(sides[k + 2]);
            for (std::size_t i = 0; i < near.size(); ++i) sets.join(near[i], far[far.size() - 1 - i]);
        }
    }
    row_of_ = std::move(sets).numbers(count_);
}

bool QuadRows::is_on_seams(Index arc_or_part) const {
    return arc_or_part < arcs() && !seams_.uses[arc_or_part].empty();
}

// In the sense of the patch's border.
std::vector<Index> QuadRows::along(const std::vector<DirectedSide>& sides) const {
    std::vector<Index> result;
    const auto add = [&](Index k, bool forward) {
        for (Index i = 0; i < counts_[k]; ++i)
            result.push_back(row_of_[first_[k] + (forward ? i : counts_[k] - 1 - i)]);
    };
    for (const DirectedSide& s : sides) {
        auto uses = seams_.uses[s.side];
        if (s.reversed) std::reverse(uses.begin(), uses.end());
        for (const SeamUse& use : uses) add(arcs() + use.part, use.forward != s.reversed);
        if (uses.empty()) add(s.side, !s.reversed);
    }
    return result;
}

std::vector<Index> QuadRows::on(Index arc_or_part) const {
    if (is_on_seams(arc_or_part)) return along({{arc_or_part, false}});
    return {row_of_.begin() + first_[arc_or_part], row_of_.begin() + first_[arc_or_part + 1]};
}

}  // namespace octafield::surface::detail
