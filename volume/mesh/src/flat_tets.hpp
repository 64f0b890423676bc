// Tets whose volume is no more than rounding: a field's weights in them are without bound, or are no numbers.
#pragma once

#include <vector>

#include "octafield/volume/tet_mesh.hpp"

namespace octafield::volume {

// Six volumes over the cube of the longest edge: below the first the sign of a volume is chance, below the second TetGen
// is asked again. Published meshes go down to 1e-7.
constexpr double rounding_of_volumes = 1e-15, flat_for_tetgen = 1e-11;

// Of which that ratio is not above `least`: inverted ones too. In ascending order.
std::vector<Index> flat_tets(const TetMesh& mesh, double least);

}  // namespace octafield::volume
