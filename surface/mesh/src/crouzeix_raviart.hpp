// Crouzeix-Raviart elements for one complex unknown per edge, each in its own edge's frame.
//
// Everything is written per corner. Corner 3t + k of triangle t lies between edge k, which leaves it counter-clockwise
// first, and edge k + 2, the interior angle a further on. With g_e the value of edge e seen along the direction that
// leaves the corner (g = f, or (-1)^N f where that is high to low), the two values agree in the triangle's plane when
// g_first = g_second exp(i N a).
#pragma once

#include <array>
#include <complex>
#include <vector>

#include "octafield/surface/surface_domain.hpp"

namespace octafield::surface::detail {

using Complex = std::complex<double>;

struct CornerLink {
    Index first, second;  // edges
    double angle;         // a, in (0, pi)
    double weight;        // 2 cot a: four times the P1 stiffness, as the shape functions have twice the P1 gradients
    Complex first_sign;   // g = sign * f: 1, or (-1)^N
    Complex second_turn;  // sign * exp(i N a)
};

// Links of all corners, (3F), corner 3t + k at place 3t + k.
std::vector<CornerLink> corner_links(const SurfaceDomain& domain, int symmetry);

// Diagonal of the mass matrix, (E): a third of the areas of the adjacent triangles.
Eigen::VectorXd edge_masses(const SurfaceDomain& domain);

// Unit values; where f = 0, exactly as in the middle of a symmetric mesh, any direction does.
Eigen::VectorXcd unit_values(const Eigen::VectorXcd& values);

// How far the direction's N-fold angle turns from the first edge of the corner to the second, in (-pi, pi], against the
// triangle's plane.
double turn(const CornerLink& link, const Eigen::VectorXcd& values);

// F of the three edges of triangle t in one frame: angles are from the direction, lower to higher vertex id, of its
// edge 0.
std::array<Complex, 3> local_values(const std::vector<CornerLink>& links, const Eigen::VectorXcd& values, Index t);

// 1/2 int |grad f|^2.
double dirichlet_energy(const std::vector<CornerLink>& links, const Eigen::VectorXcd& values);

// K f, K the stiffness matrix.
Eigen::VectorXcd apply_stiffness(const std::vector<CornerLink>& links, const Eigen::VectorXcd& values);

}  // namespace octafield::surface::detail
