// Frames made even where matchings are given.
#pragma once

#include <vector>

#include "edge_matchings.hpp"

namespace octafield::volume::detail {

// Frames of the vertices given and of some rings round them become means of what their neighbours say by the matchings,
// vertex by vertex, some times; on the surface the axis along the normal stays, features stay as they are.
void smooth_matched(const TetDomain& domain, const EdgeMatchings& matchings, const std::vector<Index>& vertices,
                    Quaternions& frames);

}  // namespace octafield::volume::detail
