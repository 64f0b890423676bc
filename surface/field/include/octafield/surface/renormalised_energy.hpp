// Renormalised energies: what the positions of the critical points of an N-direction field cost in the limit of a small
// coherence length epsilon (Bethuel, Brezis, Helein 1994; Beaufort et al. 2017; thesis of P.-A. Beaufort 2019, section
// 3.6 and appendix B). Critical points are simple zeros of f, index 1/N of the direction each. For the functional of
// direction_field.hpp,
//     E = pi n |log epsilon| + W + n * core_energy + o(1),    n the number of points,
// with W depending on their positions alone: field solvers are tested against it, and it tells where points go.
#pragma once

#include <complex>
#include <span>

#include "octafield/arrays.hpp"

namespace octafield::surface {

// gamma: lim R -> infinity of min E on the disk of radius R epsilon with f = exp(i theta) on its circle, minus pi log
// R. From the radial equation rho'' + rho'/r - rho/r^2 = rho (rho^2 - 1), solved for R = 20, 40, 80.
inline constexpr double core_energy = 1.196576;

// W on the unit disk, the field tangent to its circle; with d points N = d.
//     W = -pi sum_{i != j} log|a_i - a_j| - pi sum_{i, j} log|1 - a_i conj(a_j)|
// Points: (d), |a_i| < 1 and different. Throws InvalidInput otherwise (elements: places of the points).
double disk_renormalised_energy(std::span<const std::complex<double>> points);

// The same for a regular polygon of d points at radius r in (0, 1), d >= 1:
//     W = -pi d (log d + (d - 1) log r + log(1 - r^(2 d)))
double disk_polygon_energy(int d, double r);

// The radius that makes it least: r^(2 d) = (d - 1) / (3 d - 1).
double disk_polygon_radius(int d);

// -sum over pairs i < j of log|x_i - x_j|, whatever the points: the logarithmic energy. Points: (n, 3), different.
double logarithmic_energy(const Points& points);

// W on the unit sphere for the n = 2 N points of an N-direction field (n even). Points: (n, 3) on the unit sphere,
// within 1e-6, different. Throws InvalidInput otherwise.
//     W = 2 pi * logarithmic_energy + pi n^2 (log 2 - 1/2)
// The constant is the integral of the potential sum log|x - x_i| against the sphere's curvature.
double sphere_renormalised_energy(const Points& points);

// pi n |log epsilon| + W + n * core_energy, epsilon in (0, 1).
double asymptotic_energy(int points, double renormalised_energy, double epsilon);

}  // namespace octafield::surface
