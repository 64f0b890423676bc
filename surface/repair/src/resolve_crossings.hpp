// Surfaces that cross themselves made surfaces that do not.
#pragma once

#include "octafield/surface/triangle_mesh.hpp"

namespace octafield::surface {

// Unites closed pieces that cross each other, each of which encloses a volume and does not cross itself: what lies
// inside another goes, the outside stays (CGAL's corefinement, exact predicates). Number of pieces that went into
// others; 0 leaves the mesh alone. Requires an oriented manifold.
std::size_t unite_crossing_pieces(TriangleMesh& mesh);

// Triangles that cross, and some round them, are smoothed, or cut out and filled anew (CGAL's
// remove_self_intersections; the mesh is refined along the crossings where that is not enough). Returns false and
// leaves the mesh alone where crossings remain. Requires an oriented manifold. Never throws for geometry.
bool remove_crossings(TriangleMesh& mesh);

}  // namespace octafield::surface
