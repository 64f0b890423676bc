// The sizes that a direction field's quads can have.
#pragma once

#include "octafield/surface/direction_field.hpp"

namespace octafield::surface {

struct ReachedSizes {
    // (V) ln sigma of mean 0 over each connected part: the least squares solution of d alpha = U_x dy - U_y dx
    // (wanted_sizes.hpp), alpha the field's angle. 0 in no triangle.
    Eigen::VectorXd log_sizes;
    // In [0, 1]: the part of the field's rotation that no size explains, the root of int |grad alpha - J grad U|^2 /
    // int |grad alpha|^2, without the triangles of singular points. 0 where the field is parallel, and to rounding
    // where its quads can be squares everywhere, as imposed fields' are.
    double misfit = 0;
};

// On a domain with edge lengths of its own the sizes are in its metric. P1 elements; one Poisson problem, its
// right-hand side the field's turn round each vertex. Throws InvalidInput where values do not fit the domain,
// SolverError (kind "thin_triangles").
ReachedSizes reached_sizes(const DirectionField& field);

// (V) exp(log_sizes) over `wanted`, after the one factor per connected part that makes the area-weighted geometric mean
// 1: above 1 quads are too large. Throws InvalidInput as wanted_sizes.
Eigen::VectorXd size_ratios(const SurfaceDomain& domain, const ReachedSizes& reached, const Eigen::VectorXd& wanted);

}  // namespace octafield::surface
