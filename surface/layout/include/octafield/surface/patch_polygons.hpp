// The patches of a quad layout as regions of the surface, for pictures and files.
#pragma once

#include "octafield/surface/quad_layout.hpp"

namespace octafield::surface {

// The triangles of the surface cut along the layout's curves: convex polygons, each in one triangle, that tile it.
struct PatchPolygons {
    Points points;               // (n, 3) input unit
    std::vector<Index> first;    // (p + 1) of `corners`: polygon i has those from first[i] to first[i + 1], exclusive
    std::vector<Index> corners;  // ids of points, counter-clockwise
    std::vector<Index> patches;  // (p) place in QuadLayout::patches
};

// Throws InvalidInput (kind "bad_option") for a layout that quad_layout has not made.
PatchPolygons patch_polygons(const QuadLayout& layout);

}  // namespace octafield::surface
