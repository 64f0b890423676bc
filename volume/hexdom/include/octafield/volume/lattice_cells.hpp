// Hexahedra of the integer lattice of a periodic map.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "octafield/cell_arrays.hpp"
#include "octafield/volume/periodic_map.hpp"

namespace octafield::volume {

// Cells whose middle is in the map and that are no hexahedra of the lattice, by the first reason that was found.
struct LostCells {
    Index outside = 0;     // a corner lies beyond the surface
    Index unusable = 0;    // on the way to a corner are tets without coordinates, or that do not fit
    Index degenerate = 0;  // two corners are one point
    Index poor = 0;        // a scaled Jacobian below the least
};

struct LatticeCells {
    Points points;                         // (p, 3)
    std::vector<Index> tet;                // (p) the lowest tet each is in
    Rows<double, 4> weights;               // (p, 4) barycentric in it; exactly 0 on triangles, edges and at vertices
    Hexahedra hexahedra;                   // (k, 8) of points
    std::vector<std::uint8_t> on_surface;  // (k) bit f: its face f (of cell_face) lies on the surface
    LostCells lost;
    bool apart = false;  // points are as far from each other as they should be; else some are left out
};

// Faces of a hexahedron, outward.
inline constexpr std::array<std::array<int, 4>, 6> cell_face{
    {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};

// min_scaled_jacobian: of the hexahedra taken. Near linear. The same at any thread count. Throws InvalidInput (kind
// "edge_length") where the map is of more than 20 million cells.
LatticeCells lattice_cells(const TetDomain& domain, const PeriodicMap& map, double min_scaled_jacobian = 0.3,
                           int threads = 0);

}  // namespace octafield::volume
