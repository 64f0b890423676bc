// What walls bound: blocks that close in themselves, walls that blocks can do without.
#pragma once

#include <vector>

#include "wall_spread.hpp"

namespace octafield::volume::detail {

// A block whose tets do not fit into one chart, as ways in it lead round.
struct Winding {
    Index block;
    std::vector<int> axes;  // of the block's chart: planes of these cut the ways
};

struct CutBlocks {
    std::vector<Index> of;           // the block of each tet
    std::vector<Transition> charts;  // from the parameters of each tet to those of its block's first
    Index count = 0;
    std::vector<Winding> windings;  // one for each block that closes in itself
};

CutBlocks cut_blocks(const CutTets& tets);

// Takes walls away between blocks that are a box together, where no wall is left without support at its edges. No block
// may close in itself.
void remove_walls(CutTets& tets);

}  // namespace octafield::volume::detail
