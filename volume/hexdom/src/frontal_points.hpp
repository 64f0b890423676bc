// Points of a front that begins on the surface and goes inside along the axes of a frame field.
#pragma once

#include "front_field.hpp"
#include "octafield/progress.hpp"
#include "octafield/volume/lattice_cells.hpp"

namespace octafield::volume {

// Corners; feature curves at even spacing; from there over the surface, patch by patch; from there inside (Baudouin,
// Remacle, Marchandise, Henrotte, Geuzaine 2014). frames: (n, 4) at the vertices. No hexahedra; points are apart. Near
// linear. The same at any thread count. Progress: phase "front". Throws Cancelled.
LatticeCells frontal_points(const TetDomain& domain, const Quaternions& frames, const TetAxes& of_tets, int threads,
                            const Progress& progress);

}  // namespace octafield::volume
