// Structures of blocks for the quads of a T-mesh, from few blocks to many.
#pragma once

#include <limits>

#include "octafield/surface/quantized_quads.hpp"
#include "tile_arcs.hpp"

namespace octafield::surface::detail {

// Whole numbers on arcs and parts of seams, and the problem whose solutions they are.
struct SizedCounts {
    ArcCounts arcs;                // of the layout's sides
    std::vector<int> part_counts;  // of seams
    double size = 0, quads = 0;
};

class CountChooser {
public:
    CountChooser(const QuadLayout& layout, const Seams& seams, const QuantizedQuadsOptions& options)
        : layout_(layout), seams_(seams), options_(options) {}

    SizedCounts at_size(const ArcProblem& problem, double size) const;
    // Sizes by the square root of what is missing, between those with too many and too few.
    SizedCounts with_quads(const ArcProblem& problem, double wanted) const;
    // As the options want it. Throws InvalidInput (kind "bad_option").
    SizedCounts wanted(const ArcProblem& problem) const;
    double first_size() const;

private:
    const QuadLayout& layout_;
    const Seams& seams_;
    const QuantizedQuadsOptions& options_;
};

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
