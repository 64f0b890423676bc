// Hexahedra of the integer lattice of a periodic map.
#pragma once

#include <vector>

#include "octafield/cell_arrays.hpp"
#include "octafield/volume/periodic_map.hpp"

namespace octafield::volume {

// Cells whose middle is in the map and that are no hexahedra of the lattice, by the first reason that was found.
struct LostCells {
    Index outside = 0;      // a corner is not reached: beyond the surface, or tets between are not usable
    Index degenerate = 0;   // two corners are one point
    Index poor = 0;         // a scaled Jacobian below the least
    Index overlapping = 0;  // in the way of a better one
};

struct LatticeCells {
    Points points;             // (p, 3), those of cells first come first
    std::vector<Index> tet;    // (p) the lowest tet each is in
    Rows<double, 4> weights;   // (p, 4) barycentric in it; exactly 0 on triangles, edges and at vertices
    Hexahedra hexahedra;       // (k, 8) of points
    LostCells lost;
};

// min_scaled_jacobian: of the hexahedra taken. Near linear. The same at any thread count.
LatticeCells lattice_cells(const TetDomain& domain, const PeriodicMap& map, double min_scaled_jacobian = 0.3,
                           int threads = 0);

}  // namespace octafield::volume
