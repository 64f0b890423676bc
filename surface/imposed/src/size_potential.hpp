// H, the logarithm of the size of quads, and how its conjugate turns.
#pragma once

#include "structure.hpp"

namespace octafield::surface::detail {

// (V) what the vertices have beside their share of a flat, regular surface: 2 pi - (angles) - 2 pi t/4, pi instead of 2
// pi on the boundary. 0 at vertices in no triangle. `indices`: (V) t.
Eigen::VectorXd loads(const Structure& structure, const std::vector<int>& indices);

// L H = loads, with the mean of exp(-2 H) over each component's area 1. The loads of a component must sum to 0.
Eigen::VectorXd size_potential(const SurfaceDomain& domain, const Structure& structure, const Eigen::VectorXd& loads);

// (3F) by how much the conjugate of u turns from the midpoint of the first edge of each corner to that of the second
// (see crouzeix_raviart.hpp): with w = n x grad u, w . (half the opposite side) = -(L_T u)_k.
std::vector<double> conjugate_turns(const SurfaceDomain& domain, const Eigen::VectorXd& u);

}  // namespace octafield::surface::detail
