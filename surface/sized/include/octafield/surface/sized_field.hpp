// Direction fields for quads of given sizes: globally optimal direction fields (Knoeppel, Crane, Pinkall, Schroeder
// 2013) with the connection of the metric sigma^-2 g (L. Simons, UC Davis 2024, chapter 3, its signs corrected;
// wanted_sizes.hpp).
//
// Unknown: one complex number u_v = r exp(i N theta_v) per vertex, theta_v the angle of a direction in the vertex's
// tangent plane (polar map). It is carried along an edge by parallel transport and by what the sizes turn it. In each
// triangle the holonomy that is left is spread evenly, and mass and energy are integrated exactly.
#pragma once

#include <cstdint>

#include "octafield/progress.hpp"
#include "octafield/surface/direction_field.hpp"
#include "octafield/surface/wanted_sizes.hpp"

namespace octafield::surface {

struct SizedFieldOptions {
    int symmetry = 4;  // N, 1 to largest_symmetry
    // s in [-1, 1]: between the antiholomorphic (-1) and the holomorphic (1) energy; 0: Dirichlet.
    double s = 0;
    // The mesh boundary and features, at their vertices: strong: held; weak: given with weight 1, as `directions`. A
    // vertex whose edges contradict each other by more than `corner_tolerance` of the worst, pi / N, is left free.
    Alignment boundary_alignment = Alignment::strong;
    Alignment feature_alignment = Alignment::strong;
    double corner_tolerance = 0.6;  // in [0, 1]
    // Directions given at vertices: (V, 3), of which the part in the tangent plane counts, or (0, 3). They go before
    // the boundary and features.
    Points directions{0, 3};
    // (V), >= 0, or (0): 1 everywhere. 0: none there (the direction may be zero); infinity: held; between: the
    // right-hand side of (A - shift M) u = M q (Knoeppel et al. 2013, section 3.3).
    Eigen::VectorXd weights{};
    // lambda_t there, 1 / input unit^2: the lower, the nearer to what is given; below the least eigenvalue. Used where
    // something is given.
    double shift = 0;
    int max_iterations = 1000;  // of the inverse iteration, where nothing is given
    double tolerance = 1e-10;   // change of the eigenvalue's estimate, relative, at which it stops
    std::uint64_t seed = 0;     // of its start
};

struct SizedField {
    // On the edges, |f| = 1, for all that takes a direction field. Edges followed strongly at both ends have f = 1.
    DirectionField field;
    // (V) u, by the angle from the first edge of the vertex's fan (domain.fans(); at the boundary the edge that leaves
    // with the surface on its left), scaled to 2 pi round vertices inside. 0 in no triangle.
    Eigen::VectorXcd values;
    Points directions;  // (V, 3) unit, one of the N, orthogonal to vertex_normals; 0 in no triangle
    // Of u, with no shift: u* A u / u* M u. Where nothing is given, the least eigenvalue (of all parts of the surface
    // together the largest); 1 / input unit^2.
    double eigenvalue = 0;
    int iterations = 0;
    bool converged = true;
    // (F) radians: what a direction carried round each triangle turns by in the metric of the sizes, times N; what is
    // not a multiple of 2 pi cannot be avoided there.
    Eigen::VectorXd holonomy;
    // Triangles where that is pi or more: too large for the sizes, so that the energy takes it for less.
    std::vector<Index> unresolved;
    std::vector<int> triangle_indices;  // (F) N times the index of u: -1, 0 or 1, more only in unresolved ones
    double least_length = 0;            // min |u| / max |u|
};

// Singular points: surface_singularities of `field`. The field has no alignment of its own where no edge is a feature
// and the alignments are none; then it is the eigenvector of the least eigenvalue, one per connected part.
//
// Throws InvalidInput: kinds "bad_option", "wrong_size", "not_finite" (elements: vertices), "bad_turns" (elements:
// edges), "not_tangent" (elements: vertices), "odd_symmetry" (elements: vertices) where features inside are to be
// followed by an odd N, "own_lengths"; GeometryError: "empty", "non_manifold_vertex"; SolverError: "shift_too_large",
// "thin_triangles" (elements). Cancelled: with nothing given, the best state is returned (converged = false).
SizedField sized_field(const SurfaceDomain& domain, const WantedSizes& sizes, const SizedFieldOptions& options = {},
                       const Progress& progress = {});

}  // namespace octafield::surface
