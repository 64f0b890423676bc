// The size field on its background, for remeshing.
#pragma once

#include "background.hpp"

namespace octafield::surface {

// With all bounds, before the number of cells is looked at.
Background planned_ground(const TriangleMesh& mesh, const FeatureGraph& features, const SizeFieldOptions& options);
// Multiplies the lengths so that at most so many cells are to be expected; with what is to be said.
SizeField fitted(Background& ground, const TriangleMesh& mesh, double max_cells);
std::string range_of(const Background& ground);  // for notes
double fitting_scale(const Background& ground, double volume, double max_cells);

}  // namespace octafield::surface
