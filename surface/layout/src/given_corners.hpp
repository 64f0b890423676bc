#pragma once

#include <map>
#include <vector>

#include "quad_untangler.hpp"

namespace octafield::surface::detail {

// Corners of quads between two edges on seams at a vertex that stays: the surface gives their angles. By quad, those
// that have any.
std::map<Index, std::vector<int>> given_corners(const QuadMesh& mesh, const Movable& movable);

}  // namespace octafield::surface::detail
