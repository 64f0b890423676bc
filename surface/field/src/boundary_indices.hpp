// Indices of a direction field at the vertices of the mesh boundary.
#pragma once

#include <vector>

#include "crouzeix_raviart.hpp"
#include "octafield/surface/direction_field.hpp"

namespace octafield::surface::detail {

// Angle of f at a boundary edge from the boundary's own sense, surface on its left: N times the direction's deviation,
// in (-pi, pi].
double boundary_deviation(const EdgeTopology& topology, int symmetry, Index edge, Complex value);

// Pairs of opposite indices along the boundary are taken out where the field between them comes no nearer to the
// boundary than half way from the worst angle: `indices` holds N times the index of each fan (0 for closed ones are
// left alone), `deviations` (E) the above at boundary edges. The sum stays as it is.
void cancel_boundary_pairs(const std::vector<CornerLink>& links, const VertexFans& fans,
                           const Eigen::VectorXd& deviations, std::vector<int>& indices);

}  // namespace octafield::surface::detail
