// A surface drawn anew through given points: the surface of a hex-dominant mesh.
#pragma once

#include <cstdint>
#include <vector>

#include "octafield/cell_arrays.hpp"
#include "octafield/surface/features.hpp"

namespace octafield::volume {

// Places on a triangle mesh. A weight of exactly 0 puts a point on the opposite edge; two, at a vertex. Weights below
// 1e-9 count as 0.
struct SurfacePoints {
    std::vector<Index> triangle;  // (p)
    Points weights;               // (p, 3) barycentric in it, >= 0, sum 1
};

struct PointSurface {
    surface::TriangleMesh mesh;   // the points first, in their order; then vertices of the old surface that had to stay
    std::vector<Index> source;    // (V) vertex of the old surface at this place, or -1
    std::vector<Index> triangle;  // (F) a triangle of the old surface of the same group, near
    surface::FeatureGraph features;        // the old features' curves, along edges of the new surface; corners stay
    std::vector<std::uint8_t> quad_found;  // (q) 1: its four edges and one diagonal are edges, and two triangles fill
                                           // it; the diagonal is no feature
};

// The surface of `mesh` with the points as vertices, and as few of the old ones as can be. Topology stays: components,
// holes, genus, how triangles meet at edges.
//
// mesh: may have edges of three triangles or more (interfaces). features: its curves to be kept; between two points, or
// old vertices that stay, they become straight edges. groups: (F) a number per triangle; edges between groups, of one
// triangle, of three and more, and of two that run it alike, are kept as features are. quads: (q) of points, round
// each; made of two triangles where that is possible without a fold. edge_length: of the lattice, in the mesh's unit.
//
// Old vertices are taken out (edges collapsed, Hoppe et al. 1993) where new triangles turn by less than 60 degrees from
// the old ones beneath them and no edge gets longer than 1.6 edge_length, or than the diagonals of the quads at its
// ends, or than one there was round the vertex; 1.5 times that where the vertex would stay within edge_length / 4 of
// another. Corners of `features` stay, and vertices where kept edges end, meet, change their kind, or turn by more than
// 60 degrees where one triangle ends or three and more meet. Nothing else bounds how far the new surface lies from the
// old one: about edge_length^2 / 4 times the curvature, as between any points so far apart. Walls thinner than that may
// cross: nobody looks here.
//
// stays: (V) 1: this old vertex is not taken out; none given: none such. Where all stay, no edge is changed: the
// surface is the old one with the points inserted, and crosses nothing the old one does not.
//
// lengths: (V) of the lattice at the vertices of `mesh`, above 0, where it is not edge_length everywhere.
//
// Throws InvalidInput, whose elements are the ids concerned: "wrong_size", "index_out_of_range", "not_an_edge"
// (features), "not_finite", "invalid_weights", "repeated_vertex" (of a quad), "coincident_points", "invalid_option";
// GeometryError: "degenerate_triangle". Near linear.
PointSurface point_surface(const surface::TriangleMesh& mesh, const surface::FeatureGraph& features,
                           const std::vector<Index>& groups, const SurfacePoints& points, const Quads& quads,
                           double edge_length, const std::vector<std::uint8_t>& stays = {},
                           const Eigen::VectorXd& lengths = {});

}  // namespace octafield::volume
