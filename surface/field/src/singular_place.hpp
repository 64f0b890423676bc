// Where inside its surroundings a singular point is, to a small part of an edge.
#pragma once

#include <functional>
#include <optional>

#include "charted_field.hpp"

namespace octafield::surface::detail {

// A point of triangle t, in its chart.
struct SurfacePlace {
    Index triangle;
    Complex at;
};

// Least-squares fit of the angles of F at the edge midpoints within two to three edges of `start`, in the plane into
// which the triangles there unfold, to
//     k arg(z - a) + c + Re(p z + q z^2),  k = index_times_symmetry:
// a vortex at a in a smooth (harmonic) surrounding. The values of one triangle, which place a point in it only to half
// an edge, depend on how it lies; those of some fifty do not. Edges for which `is_barrier` holds are not crossed.
// Nothing where the fit does not converge, leaves angles unexplained (other points near, a coarse mesh), has few
// values, or moves the point by more than an edge length or over a barrier.
std::optional<SurfacePlace> fitted_place(const ChartedField& field, const std::function<bool(Index)>& is_barrier,
                                         SurfacePlace start, int index_times_symmetry);

}  // namespace octafield::surface::detail
