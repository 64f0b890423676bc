// Arrays of cells beside triangles and tets, one row of vertex ids per cell, in the numbering of VTK and Gmsh. One
// array per kind rather than offsets and types: each maps onto a numpy array, has a fixed width, and cannot contradict
// itself.
#pragma once

#include "octafield/arrays.hpp"

namespace octafield {

using Quads = Rows<Index, 4>;     // (n, 4) round the quad, counter-clockwise seen from outside
using Pyramids = Rows<Index, 5>;  // (n, 5) the base round, counter-clockwise seen from the apex, then the apex
using Wedges = Rows<Index, 6>;  // (n, 6) a triangle, counter-clockwise seen from the other one, then that, each vertex
                                // joined to the one three places before it
using Hexahedra = Rows<Index, 8>;  // (n, 8) a quad, counter-clockwise seen from the one across, then that, each vertex
                                   // joined to the one four places before it

}  // namespace octafield
