// The boundary in quad coordinates.
#pragma once

#include <functional>

#include "cut_surface.hpp"
#include "layout_points.hpp"

namespace octafield::surface::detail {

// The nodes along each boundary curve, surface on the left, with the length in parameters, int exp(-H), up to each;
// from a node where `starts` holds, if there is one. The first node is also the last.
std::vector<std::vector<CurveNode>> boundary_nodes(const ImposedField& field, const Charts& charts,
                                                   const LayoutPoints& points, const CutSurface& cut,
                                                   const std::function<bool(Index)>& starts);

}  // namespace octafield::surface::detail
