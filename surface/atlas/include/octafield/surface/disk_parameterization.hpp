// One-to-one maps of a piece of surface to the unit disk by mean value coordinates (Floater 2003; holes as in
// Beaufort's thesis, chapter 2).
#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "octafield/surface/plane_points.hpp"
#include "octafield/surface/surface_domain.hpp"

namespace octafield::surface {

// Weights lambda_ij = (tan(theta/2) + tan(theta'/2)) / l_ij, (V, V), rows i, in the two triangles beside edge ij, with
// their angles at i and lengths; at the boundary of the one triangle there. All positive; not symmetric; the diagonal
// is empty. A map is sum_j lambda_ij (u_i - u_j) = 0. 1 / input unit.
Eigen::SparseMatrix<double, Eigen::RowMajor> mean_value_weights(const SurfaceDomain& domain);

// Boundary curves, surface on the left, the longest first and each from its lowest vertex. Throws GeometryError (kind
// "non_manifold_vertex", elements: vertices) where two of them touch.
std::vector<std::vector<Index>> boundary_loops(const SurfaceDomain& domain);

struct DiskOptions {
    // Triangles with a vertex in the middle are imagined in each hole, isosceles ones whose angles there sum up to a
    // whole turn; false: holes are free, and their images convex, with nearly flat triangles where they are not.
    bool fill_holes = true;
};

struct DiskParameterization {
    PlanePoints uv;                         // (V, 2) in the closed unit disk
    std::vector<std::vector<Index>> loops;  // boundary_loops; the first one is on the circle
};

// The longest boundary curve goes to the circle, spaced by its lengths, its first vertex to (1, 0); all other vertices
// are weighted means of their neighbours. Every triangle of the result is positive in exact arithmetic. Close to
// linear. Throws GeometryError: kinds "not_connected" (elements: a triangle of each part), "closed" (no boundary),
// "not_planar" (handles: genus above 0), "non_manifold_vertex", "not_one_to_one" (elements: triangles that doubles do
// not show as positive; the map is too uneven there and the surface is to be cut or split, as octafield::surface::atlas
// does).
DiskParameterization parameterize_disk(const SurfaceDomain& domain, const DiskOptions& options = {});

// Triangles that are not positive (flat or turned over), in exact arithmetic, ascending. uv: a row per vertex id.
std::vector<Index> not_positive(const PlanePoints& uv, const Triangles& triangles);

// What a map of each triangle to the plane does to it.
struct MapDistortion {
    PlanePoints singular_values;  // (F, 2) of J, lengths on the surface over lengths in the plane; the larger first;
                                  // infinite and 0 where the plane's triangle is flat
    Eigen::VectorXd conformity;   // (F) second over first: 1 where circles stay circles
};

// uv_triangles: (F, 3) rows of uv for the corners of each triangle, so that a vertex may have several. Throws
// InvalidInput (kind "bad_shape", "index_out_of_range").
MapDistortion map_distortion(const SurfaceDomain& domain, const PlanePoints& uv, const Triangles& uv_triangles);

// (F, 3) entries uu, uv, vv of J^T J / h^2 of each triangle: the metric of the plane in which lengths are those on the
// surface, over h. It is what a mesher of the plane takes for edges of length h on the surface.
Rows<double, 3> plane_metric(const SurfaceDomain& domain, const PlanePoints& uv, const Triangles& uv_triangles,
                             double h);

}  // namespace octafield::surface
