// Repairs that only look at which triangles share which vertices. Each returns how many triangles it concerned.
#pragma once

#include <vector>

#include "octafield/surface/triangle_mesh.hpp"

namespace octafield::surface {

std::size_t drop_repeating_a_vertex(Triangles& triangles);

// Of triangles on the same three vertices the first stays; pairs of opposite ones go both where the edges have two
// triangles or none without them (a wall inside, as between two cubes).
std::size_t drop_repeated(Triangles& triangles);

// A triangle hanging on an edge of three or more by one side, its other two free, bounds nothing.
std::size_t drop_fins(Triangles& triangles);

// Open connected pieces whose bounding box's diagonal is below `size`, unless nothing else is left.
std::size_t drop_tiny_open_pieces(TriangleMesh& mesh, double size);

// The fewest reversals that orient each piece alike across its two-sided edges. Pieces that cannot be oriented stay as
// they are.
std::size_t orient_alike(Triangles& triangles);

// Reverses closed shells that face the wrong way, where all triangles are oriented alike.
std::size_t orient_outward(TriangleMesh& mesh);

// Number of vertices dropped.
std::size_t drop_unused_vertices(TriangleMesh& mesh);

}  // namespace octafield::surface
