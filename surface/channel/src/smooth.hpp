// Vertices moved for quads of less cost.
#pragma once

#include "plane_quads.hpp"

namespace octafield::surface::detail {

// Of the vertices that may move and have a quad that may be exchanged: each in turn to the mean of its neighbours, or a
// part of its edges' length in one of eight directions, while the sum of the costs round it falls. Ends when nothing
// moves. Returns the vertices that moved, ascending.
std::vector<Index> smooth(PlaneQuads& quads, int sweeps);

}  // namespace octafield::surface::detail
