// Arcs of a T-mesh with no quads: tracks that run side by side become one.
#pragma once

#include "octafield/surface/quad_layout.hpp"
#include "seams.hpp"

namespace octafield::surface::detail {

// What must not be: singular points, corners and nodes of seams that become one, or seams that do. Of each, the arcs
// and parts of seams (counted on from the arcs) on a way between the two, one of which has to have a quad. Counts: of
// arcs and of parts of seams.
std::vector<std::vector<Index>> wrongly_merged(const QuadLayout& layout, const Seams& seams,
                                               const std::vector<int>& counts, const std::vector<int>& part_counts);

}  // namespace octafield::surface::detail
