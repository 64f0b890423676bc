// Vertices of quads at places where a seam bends though nothing has to have a vertex there: corners where two quads
// meet on either side.
#pragma once

#include "octafield/surface/quad_mesh.hpp"
#include "side_grids.hpp"

namespace octafield::surface::detail {

// Lengths along the seam where it turns by more than 45 degrees at one place.
std::vector<double> bends(const Seam& seam);

// At each of them the nearer of the two vertices beside it moves there, and is held, unless it is a node or at another
// of them; then the other one, where that leaves a quarter of the edge.
void hold_bends(const Seams& seams, QuadMesh& mesh, std::vector<SideGrids::OnSeam>& on_seams);

}  // namespace octafield::surface::detail
