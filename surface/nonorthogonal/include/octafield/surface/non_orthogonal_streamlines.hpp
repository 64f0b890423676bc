// Curves along the lines of a non-orthogonal field, by the tracer of streamlines.hpp: between vertices the power sums
// of the lines are linear.
#pragma once

#include "octafield/surface/non_orthogonal_field.hpp"
#include "octafield/surface/streamlines.hpp"

namespace octafield::surface {

// One curve per seed, along the one of the four directions nearest to the seed's. Throws as streamlines of a
// DirectionField.
std::vector<Streamline> streamlines(const NonOrthogonalField& field, const SurfaceSingularities& singularities,
                                    const std::vector<StreamlineSeed>& seeds, const StreamlineOptions& options = {});

// From every singular point of index t / 4 in a triangle the 4 - t curves that leave it straight (3 for t = 1, 5 for t
// = -1), from one at a boundary vertex the lines strictly between its two boundary edges (v - 1 at a corner of v
// quads). Points in the order of `singularities`, each one's curves counter-clockwise. Throws InvalidInput, Cancelled.
std::vector<Streamline> separatrices(const NonOrthogonalField& field, const SurfaceSingularities& singularities,
                                     const StreamlineOptions& options = {}, const Progress& progress = {});

}  // namespace octafield::surface
