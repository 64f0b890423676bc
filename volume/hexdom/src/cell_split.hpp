// One cell filled with tets on its own vertices.
#pragma once

#include <vector>

#include "cell_complex.hpp"

namespace octafield::volume::detail {

// Tets whose quality is at least `least`; on quads that meet two triangles, with their diagonal, on others with
// whichever gives a solution first. Empty where there is none, or the search has seen 200 000 states.
std::vector<std::array<Index, 4>> split_into_tets(const CellComplex& complex, Index cell, double least);

}  // namespace octafield::volume::detail
