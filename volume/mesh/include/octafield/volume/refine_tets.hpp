// Tets cut into eight, all of them or some, and their neighbours so that they still meet face to face.
#pragma once

#include <cstdint>
#include <vector>

#include "octafield/volume/tet_domain.hpp"

namespace octafield::volume {

struct RefinedDomain {
    TetDomain domain;  // vertices of the old mesh first, in their order
    Edges parents;     // (n) the two old vertices that each lies half-way between; twice its own number for old ones
    std::vector<Index> parent;  // (m) old tet that each is part of, ascending
};

// marked: (m) 1 for tets to be cut: edges halved, four tets cut off at the corners, the octahedron left cut along its
// shortest diagonal (Bey 1995). Of their neighbours those with one halved edge, or the three of a triangle, are cut in
// two or four (green); others into eight. Regions and features go on; the surface is the same set of points. Near
// linear. Throws InvalidInput (number of marks), and what TetDomain throws.
RefinedDomain refine_tets(const TetDomain& domain, std::vector<std::uint8_t> marked);

}  // namespace octafield::volume
