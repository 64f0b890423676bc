// Points put into a surface: its triangles cut so that each point is a vertex.
#pragma once

#include "octafield/volume/point_surface.hpp"
#include "triangle_complex.hpp"

namespace octafield::volume::detail {

struct PlacedPoints {
    TriangleComplex complex;       // vertices: the points, then old vertices in use where no point is
    std::vector<Index> source;     // (V) old vertex at this place, or -1
    std::vector<Index> vertex_of;  // (old V) the vertex there, -1: in no triangle
};

// Throws InvalidInput and GeometryError as point_surface does.
void require_usable(const surface::TriangleMesh& mesh, const std::vector<Index>& groups, const SurfacePoints& points,
                    const Quads& quads, double edge_length);
// Throws InvalidInput (kind "coincident_points") where two points are at one place.
PlacedPoints place_points(const surface::TriangleMesh& mesh, const surface::FeatureGraph& features,
                          const std::vector<Index>& groups, const SurfacePoints& points);

}  // namespace octafield::volume::detail
