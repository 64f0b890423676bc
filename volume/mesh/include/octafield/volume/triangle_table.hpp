// Every triangle of a tet mesh once, with the tets on its sides.
#pragma once

#include <array>

#include "octafield/volume/tet_mesh.hpp"

namespace octafield::volume {

// Corners of the triangle opposite corner k of a positively oriented tet, counter-clockwise seen from outside the tet.
inline constexpr std::array<std::array<int, 3>, 4> tet_face{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

struct TriangleTable {
    Triangles triangles;  // (t, 3), vertex ids ascending in each row, rows in lexicographic order
    Edges sides;          // (t, 2), 4 tet + (corner opposite the triangle); lower first; -1: none (a boundary triangle)
    Tets tet_triangles;   // (m, 4), column k: the triangle opposite corner k
};

// Near linear: bucketed by lowest vertex, then sorted inside the buckets. Ids must be in range. Throws GeometryError
// (kind "non_manifold_face") where three tets share a triangle, and (kinds "folded_tet", "inverted_tet") where two lie
// on the same side of one, see folded_tets.hpp. The same result at any thread count.
TriangleTable triangle_table(const TetMesh& mesh, int threads = 0);

}  // namespace octafield::volume
