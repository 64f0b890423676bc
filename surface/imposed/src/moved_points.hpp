// Moving singular points until the conditions of a field hold.
#pragma once

#include "built_field.hpp"
#include "octafield/surface/imposed_field.hpp"

namespace octafield::surface::detail {

struct MovedPoints {
    BuiltField built;
    int steps;
    double largest_move;
};

// The first `count` places of `imposed` move, those on the boundary excepted. Newton's method with steps of least norm:
// with P the energies of the forms u_l, the rotations change by -2 pi P^-1 sum_j t_j / 4 (n x grad u_l)(x_j) . dx_j.
// Throws SolverError (kind "move_failed", elements: the two places that ran into one another, if that is why).
MovedPoints moved_points(const SurfaceDomain& input, Imposed& imposed, std::size_t count, BuiltField built,
                         const ImposedFieldOptions& options, const Progress& progress);

}  // namespace octafield::surface::detail
