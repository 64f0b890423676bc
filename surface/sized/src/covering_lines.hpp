// Streamlines that cover a surface in both families.
#pragma once

#include "octafield/surface/size_families.hpp"
#include "streamline_tools.hpp"

namespace octafield::surface::detail {

struct CoveringLines {
    std::vector<Streamline> lines;
    Index left_out = 0;  // too near to singular points
};

// Whole streamlines at right angles to separatrices and to streamlines spread at a few times the spacing, so that every
// place of these has one within half the spacing. Fills in the defaults of the options.
CoveringLines covering_lines(const DirectionField& field, const SurfaceSingularities& singularities,
                             SizeFamilyOptions options, const Progress& progress);

}  // namespace octafield::surface::detail
