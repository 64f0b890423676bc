// Structures of blocks for the quads of a T-mesh, from few blocks to many.
#pragma once

#include <limits>

#include "count_chooser.hpp"

namespace octafield::surface::detail {

struct BlockStructure {
    static constexpr Index finest = std::numeric_limits<Index>::max();
    ArcProblem problem;
    Index blocks = finest;  // `finest`: not counted
};

// By blocks, ascending. Whole numbers for large quads are a structure: its rows are split to get quads of the size
// wanted, and its blocks stay. Arcs may have no quads there, so that tracks become one. Of `fine` only that for the
// size wanted, which is the last one else, with a quad at least on each arc.
std::vector<BlockStructure> block_structures(const QuadLayout& layout, const Seams& seams,
                                             const QuantizedQuadsOptions& options);

}  // namespace octafield::surface::detail
