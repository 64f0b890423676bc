// Integrals over a triangle of products of the basis functions of Knoeppel et al. 2013 (appendix D of its supplement,
// reconstructed): the barycentric functions, each carried straight from its vertex by a connection whose curvature is
// spread evenly.
#pragma once

#include <array>

#include "crouzeix_raviart.hpp"

namespace octafield::surface::detail {

// Of the triangle's holonomy t, radians:
Complex mass_factor(double t);       // m: 1/12 for t = 0
Complex stiffness_factor(double t);  // f1: 0 for t = 0
Complex product_factor(double t);    // f2: -1/4 for t = 0

// Mass M and stiffness D of one triangle, entries by corner. `steps`: [k] what carries a value from corner k to corner
// k + 1, of length 1; their product is exp(i holonomy). Row j, column k multiplies the value at k for the one at j.
struct TriangleMatrices {
    double holonomy;  // in (-pi, pi]
    std::array<std::array<Complex, 3>, 3> mass, stiffness;
};
// `corners`: in the plane, counter-clockwise.
TriangleMatrices triangle_matrices(const std::array<Complex, 3>& corners, const std::array<Complex, 3>& steps);

}  // namespace octafield::surface::detail
