// The map of a layout's surface to the grid of whole numbers that its arcs have.
#pragma once

#include "unfolded_map.hpp"

namespace octafield::surface::detail {

struct GridMap {
    ChartedMesh mesh;
    GridValues values;
    UnfoldedMap found;
    Vector2 place(Index corner) const { return values.place(corner, found.values); }
};

// From the tiles' own maps, which tiles without quads fold. size: as of SizedCounts. The caller looks at found.folded.
// Throws GeometryError (kind "bad_subdivision"), Cancelled.
GridMap grid_map(const QuadLayout& layout, const Seams& seams, const GridCounts& counts, double size,
                 const Progress& progress = {});

}  // namespace octafield::surface::detail
