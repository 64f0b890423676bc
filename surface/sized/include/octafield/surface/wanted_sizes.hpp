// Sizes that quads are to have, and how they turn a cross field.
//
// A cross field of angle alpha has quads of edge length sigma where, with U = ln sigma,
//     d alpha = U_x dy - U_y dx
// (L. Simons, "Size-driven all-quad meshing for geographic data", UC Davis 2024, (4.3) and (4.4); his (4.5) and (4.6)
// have the opposite signs, which his own example contradicts). It is parallel in the metric sigma^-2 g, in which all
// quads have unit edges; the holonomy of that metric in a region is the curvature plus the integral of Laplace U.
#pragma once

#include "octafield/surface/surface_domain.hpp"

namespace octafield::surface {

struct WantedSizes {
    Eigen::VectorXd lengths;  // (V) sigma, input unit, > 0
    // (E) radians: the integral of d alpha along each edge from its lower to its higher vertex, which the directions of
    // a field that has these sizes turn against parallel transport on the surface.
    Eigen::VectorXd turns;
};

// ln sigma linear in each triangle. Its gradient jumps at edges; the mean of both sides counts, so that the jump, which
// is Laplace ln sigma there, goes to both triangles in equal parts. Exact for linear ln sigma.
// Throws InvalidInput: kinds "wrong_size", "bad_size" (elements: vertices) for lengths that are not finite and > 0,
// "own_lengths" where the domain has edge lengths of its own.
WantedSizes wanted_sizes(const SurfaceDomain& domain, const Eigen::VectorXd& lengths);

// ln sigma quadratic in each triangle, from `middles`, (E) sigma at the midpoints of edges, too: exact where it is
// quadratic, as linear and quadratic ln sigma in the plane are.
WantedSizes wanted_sizes(const SurfaceDomain& domain, const Eigen::VectorXd& lengths, const Eigen::VectorXd& middles);

// (E, 3): where `middles` are wanted.
Points edge_midpoints(const SurfaceDomain& domain);

// The surface measured by unit edges of the quads: edge lengths over the geometric mean of sigma at both ends, times
// one factor that keeps the area. What takes lengths from a domain (direction_field) then sees the metric sigma^-2 g.
// Throws GeometryError (kind "no_triangle", elements) where sizes change too fast for the triangles; InvalidInput as
// wanted_sizes.
SurfaceDomain sized_domain(const SurfaceDomain& domain, const Eigen::VectorXd& lengths);

struct BoundarySizeOptions {
    double growth = 0.2;  // of the size per distance, >= 0
    double largest = 0;   // input unit; 0: no limit
};

// (V): the length of the boundary's edges at the nearest place of the mesh boundary, linear between the means at its
// vertices, plus growth times the distance to it, straight through space. Throws InvalidInput: kinds "no_boundary",
// "bad_option".
Eigen::VectorXd boundary_sizes(const SurfaceDomain& domain, const BoundarySizeOptions& options = {});

}  // namespace octafield::surface
