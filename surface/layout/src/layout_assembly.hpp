// A layout from the surface cut into pieces.
#pragma once

#include "layout_pieces.hpp"
#include "octafield/surface/quad_layout.hpp"

namespace octafield::surface::detail {

// Vertices, sides and patches of a layout whose curves and domain are there. Throws GeometryError (kind
// "bad_subdivision") where V - E + F is not the surface's.
void assemble(QuadLayout& layout, const LayoutPoints& points, std::shared_ptr<const LayoutPieces> pieces);
// Needs patches without T-joints.
void add_chords(QuadLayout& layout);
// Where a patch is to be cut that is an annulus with a closed curve of the boundary; -1: it is none.
Index boundary_cut(const QuadLayout& layout, const LayoutPatch& patch);

}  // namespace octafield::surface::detail
