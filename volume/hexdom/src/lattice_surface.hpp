// Which points and faces of lattice cells lie on the surface.
#pragma once

#include <vector>

#include "edge_lengths.hpp"
#include "octafield/volume/lattice_cells.hpp"
#include "octafield/volume/point_surface.hpp"
#include "octafield/volume/tet_domain.hpp"

namespace octafield::volume {

struct LatticeSurface {
    SurfacePoints points;              // on domain.surface(): those of cells, then others apart from all before
    std::vector<Index> lattice_point;  // (points) of the lattice
    Quads quads;                       // of points: faces of cells on the surface, each once
};

// lengths: others are left out within half of that there from those before.
LatticeSurface lattice_surface(const TetDomain& domain, const LatticeCells& cells, const EdgeLengths& lengths);

}  // namespace octafield::volume
