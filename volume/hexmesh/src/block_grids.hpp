// Whole-number places of the corners of patches in the grids of blocks.
#pragma once

#include <map>
#include <vector>

#include "octafield/volume/block_complex.hpp"

namespace octafield::volume::detail {

using Vector3i = Eigen::Vector3i;

struct BlockGrids {
    std::vector<Vector3i> sizes;       // edges along each parameter, per block
    std::map<Index, Vector3i> places;  // of block vertices at corners of patches, from the low corner
};

// Edges along the first and second parameter of a patch.
std::array<int, 2> patch_size(const BlockPatch& patch, const std::vector<int>& numbers);

// Throws GeometryError (kind "not_a_box", elements: blocks) where sums on opposite sides differ or patches of a block
// do not hang together.
BlockGrids block_grids(const BlockComplex& blocks, const std::vector<int>& numbers);

}  // namespace octafield::volume::detail
