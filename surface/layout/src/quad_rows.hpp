// Rows of quads, from side to side through all patches of a T-mesh.
#pragma once

#include <array>

#include "octafield/surface/quad_layout.hpp"
#include "seams.hpp"

namespace octafield::surface::detail {

// The arcs on each of the four sides of a patch.
std::array<std::vector<DirectedSide>, 4> four_sides(const LayoutPatch& patch);

// Of the quads that there are with these counts: of arcs, then of parts of seams.
class QuadRows {
public:
    QuadRows(const QuadLayout& layout, const Seams& seams, std::vector<int> counts);

    Index count() const { return count_; }
    // Of the rows that end on an arc or on a part of a seam, each as often as it does, in its sense.
    std::vector<Index> on(Index arc_or_part) const;
    Index arcs() const { return static_cast<Index>(seams_.uses.size()); }
    Index arcs_and_parts() const { return static_cast<Index>(counts_.size()); }
    bool is_on_seams(Index arc_or_part) const;

private:
    std::vector<Index> along(const std::vector<DirectedSide>& sides) const;

    const QuadLayout& layout_;
    const Seams& seams_;
    std::vector<int> counts_;
    std::vector<Index> first_;  // piece of each arc or part; arcs on seams have none of their own
    std::vector<Index> row_of_;
    Index count_ = 0;
};

}  // namespace octafield::surface::detail
