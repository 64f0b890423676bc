// Every tet cut into eight.
#pragma once

#include "octafield/volume/tet_domain.hpp"

namespace octafield::volume {

struct RefinedDomain {
    TetDomain domain;  // vertices of the old mesh first, in their order; tets 8 t to 8 t + 7 are those of tet t
    Edges parents;     // (n) the two old vertices that each lies half-way between; twice its own number for old ones
};

// Edges halved, four tets cut off at the corners, the octahedron left cut along its shortest diagonal (Bey 1995). Regions
// and features go on; the surface is the same set of points. Linear. Throws what TetDomain throws.
RefinedDomain refine_uniformly(const TetDomain& domain);

}  // namespace octafield::volume
