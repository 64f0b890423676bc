// Singular points of an N-direction field: where the direction turns by a multiple of 2 pi / N round a point.
#pragma once

#include <vector>

#include "octafield/surface/direction_field.hpp"

namespace octafield::surface {

struct SurfaceSingularity {
    Eigen::Vector3d position;  // in `triangle`, or at `vertex`
    int index_times_symmetry;  // N * index: +1 is index +1/N
    double index;              // turns of the direction round the point: +1/4 for valence 3 when N = 4
    Index triangle;            // that holds position; -1 when at a vertex
    Index vertex;              // -1 when in a triangle
    bool boundary;             // at a vertex of the mesh boundary
};

struct SurfaceSingularities {
    std::vector<SurfaceSingularity> points;  // those in triangles by triangle, then those at vertices by vertex
    double index_sum = 0;                    // of all points
    int euler_characteristic = 0;            // where parts of the surface only touch, each has its own vertex
    bool agree = true;                       // index_sum is the Euler characteristic (Poincare, Hopf)
    // Largest angle, radians in [0, pi / N], between an edge of the mesh boundary and the nearest of the N directions
    // at its midpoint; 0 for a field aligned with the boundary and for closed surfaces. Where alignment is weak it
    // comes near pi / N at points on the boundary; if it does without any, the field does not follow the boundary.
    double boundary_deviation = 0;
};

// All triangles and vertices with non-zero index. A triangle and one of its vertices with opposite indices cancel: the
// field is not continuous at vertices, and the mesh cannot tell such a pair from none.
//
// Which triangles and vertices turn the field is exact, but tells the place of a point only to half an edge. So a point
// inside goes to where the angles within two or three edges fit a single vortex best, at most an edge length away, and
// `triangle` is the one that holds that place; a tenth of an edge is what is left for fields that are smooth round it
// (see docs/surface.md). It stays at the zero of the linear interpolant, or at the vertex, where the fit says nothing
// (other points near, a coarse mesh), and at vertices on creases, tips of cones and edges that the field follows.
//
// On the mesh boundary the index counts how often another of the N directions becomes the one that follows the boundary
// (for odd N the boundary is run with the surface on its left). Where the field is aligned, that is its turn against
// the boundary's; where alignment is weak or there is none, the turn is no multiple of 1/N at a single vertex, but the
// count is, and both have the same sum along each closed boundary curve. Two changes to and fro, between which the
// field stays nearer to the worst angle pi / N than to the boundary, are none.
//
// Throws InvalidInput where there is not one value per edge (kind "wrong_size"), or where values are not finite (kind
// "not_finite", elements: edges).
SurfaceSingularities surface_singularities(const DirectionField& field);

}  // namespace octafield::surface
