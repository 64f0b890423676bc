// Integrals over the unit sphere, exact for polynomials: Gauss-Legendre in z times equispaced azimuths.
#pragma once

#include <vector>

namespace octafield::frames {

// Extended precision, so that tables computed with it are correct to the last digit of a double where the platform has
// a longer type.
struct SphereNode {
    long double x, y, z, weight;  // the weights add to 4 pi
};

// Exact for polynomials of degree at most 2 points - 1: 2 points^2 nodes.
std::vector<SphereNode> sphere_quadrature(int points);

}  // namespace octafield::frames
