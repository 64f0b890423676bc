// Edges round which the parameters of a map wind as in no hex mesh.
#pragma once

#include "octafield/volume/seamless_map.hpp"
#include "octafield/volume/triangle_table.hpp"

namespace octafield::volume::detail {

// Lower vertex first, in order: inside, edges with one quarter turn of the parameters or none, and such with other than
// four along no axis; on the boundary, edges without a quarter, and such with three or more along no axis. Tets without
// folds do not exclude them: parameters may go round an edge twice.
Edges wound_edges(const SeamlessMap& map, const TriangleTable& table);

}  // namespace octafield::volume::detail
