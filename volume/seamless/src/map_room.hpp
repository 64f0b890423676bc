// Room for a seamless map: tets, triangles and edges that its constraints would flatten are split.
#pragma once

#include "curve_split.hpp"

namespace octafield::volume::detail {

// Per triangle of the surface: 0, 1, 2, the axis of the tet behind it that is nearest to its normal.
std::vector<std::uint8_t> normal_axes(const MatchedField& field);

// Edges that a map takes to straight lines: singular ones, features, and those of the surface across which another axis
// is normal. Lower vertex first, in order.
Edges straight_edges(const MatchedField& field);

// Splits what is opposite to curves in their tets, and what joins straight edges, or the surface, without being part of
// them, so that every tet may have a volume.
MatchedField make_room(const MatchedField& field);

// Splits the edges of these tets but for straight ones: a map that they stop gets room there.
MatchedField split_round(const MatchedField& field, const std::vector<Index>& tets);

}  // namespace octafield::volume::detail
