// A surface drawn anew through given points: the surface of a hex-dominant mesh.
#pragma once

#include <cstdint>
#include <vector>

#include "octafield/cell_arrays.hpp"
#include "octafield/surface/features.hpp"

namespace octafield::volume {

// Places on a triangle mesh. A weight of exactly 0 puts a point on the opposite edge; two, at a vertex.
struct SurfacePoints {
    std::vector<Index> triangle;  // (p)
    Points weights;               // (p, 3) barycentric in it, >= 0, sum 1
};

struct PointSurface {
    surface::TriangleMesh mesh;     // the points first, in their order; then vertices of the old surface that had to stay
    std::vector<Index> source;      // (V) vertex of the old surface at this place, or -1
    std::vector<Index> triangle;    // (F) a triangle of the old surface of the same group, near
    surface::FeatureGraph features; // the old features' curves, along edges of the new surface; corners stay
    std::vector<std::uint8_t> quad_found;  // (q) 1: its four edges and one diagonal are edges, and two triangles fill it
};

// mesh: may have edges of three triangles or more (interfaces); its features hold the curves to be kept. groups: (F) a
// number per triangle; edges between groups, of one triangle, or of three and more are kept as features are. quads: (q)
// of points, round each; made of two triangles where that is possible without a fold. Vertices of the old surface are
// taken out (edges collapsed) where the new triangles turn by less than 60 degrees from those they replace and no edge
// gets longer than 1.6 edge_length; none is needed where points are dense. Near linear.
PointSurface point_surface(const surface::TriangleMesh& mesh, const surface::FeatureGraph& features,
                           const std::vector<Index>& groups, const SurfacePoints& points, const Quads& quads,
                           double edge_length);

}  // namespace octafield::volume
