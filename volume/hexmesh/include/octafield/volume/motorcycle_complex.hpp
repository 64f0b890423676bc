// Walls that cut any seamless map into blocks.
#pragma once

#include "octafield/progress.hpp"
#include "octafield/volume/seamless_map.hpp"

namespace octafield::volume {

// The map on tets that are cut along walls, so that block_complex finds boxes; walls of the given map are not used.
// From edges inside with other than four quarter turns of the parameters, from edges of the boundary with other than
// two (a box's edge has one), and from features that lie in a flat part of it, walls spread in planes of a constant
// parameter, the nearest to their source first, and end at the boundary, at such edges, and at walls that they would
// cross (the motorcycle complex; Brueckler, Gupta, Mandad, Campen 2022). Blocks that close in themselves are cut once
// more. Then walls are taken away, the smallest first, as long as boxes remain. Tets keep the parameters of the tet
// they are part of, features are split with their edges, vertices of the given mesh keep their numbers; some inside
// move with their parameters to walls that pass near them, so that no thin tets are cut. Coordinates that differ by
// less than 1e-8 of a mean tet are the same. Near linear in the tets and the triangles of walls. The same result each
// run. Progress names the phase "walls". Throws what seamless_report throws, GeometryError: kinds "flipped_tet",
// "torn_map" (tets), "unaligned_boundary" (tets with a boundary triangle without a constant parameter), "winding_edge"
// (vertices of edges with a wrong number of quarter turns that lie along no axis), "not_a_box" (blocks that no plane
// cuts), SolverError ("endless_walls": walls that wind without an end).
SeamlessMap motorcycle_complex(const SeamlessMap& map, const Progress& progress = {});

}  // namespace octafield::volume
