// Tets that overlap the neighbours they share a triangle with.
#pragma once

#include "octafield/volume/triangle_table.hpp"

namespace octafield::volume {

// Throws GeometryError (kind "folded_tet") where both tets of a triangle lie on the same side of it, though every tet has
// positive volume; elements: of each connected part, the tets on the side of the fewer. A mesh whose tets are ordered
// against each other without that: kind "inverted_tet". Linear time. mesh: ids in range.
void require_unfolded(const TetMesh& mesh, const TriangleTable& table);

}  // namespace octafield::volume
