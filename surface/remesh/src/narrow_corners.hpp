// Feature curves that meet at angles in which no triangle of good shape fits.
#pragma once

#include "background.hpp"

namespace octafield::surface {

// Of two feature curves that meet at less than 12 degrees, the one along which the surface bends less is taken away,
// from where they meet to where they are a quarter of the length wanted, or `most` (input unit), apart. Rims stay.
// Patches are numbered anew. How often that was done.
int let_go_narrow_corners(Background& ground, double most);

}  // namespace octafield::surface
