// The directions that run straight away from a singular point.
#pragma once

#include <vector>

#include "direction_tracer.hpp"

namespace octafield::surface::detail {

// Where tracing begins, and the straight way there from the singular point: points[0] is the singular point, the last
// one lies at `place`; segment i is in triangles[i].
struct SeparatrixStart {
    std::vector<Eigen::Vector3d> points;
    std::vector<Index> triangles;
    Place place;
};

// Of a point inside a triangle, counter-clockwise; none if its index_times_symmetry is N or more.
std::vector<SeparatrixStart> starts_in_triangle(const ChartedField& field, const SurfaceSingularity& point,
                                                const DirectionTracer& tracer);

// The same at a vertex with one fan round it; without the directions along features and boundary edges.
std::vector<SeparatrixStart> starts_at_vertex(const ChartedField& field, const std::vector<CornerLink>& links,
                                              const Eigen::VectorXcd& values, const VertexFans::Fan& fan,
                                              const DirectionTracer& tracer);

// From the vertex at a corner (3 t + k) of triangle t, `angle` (radians, in the triangle's plane) from the corner's
// first side, kept off both sides, halfway to the side opposite. `width`: the corner's angle.
SeparatrixStart start_in_corner(const Charts& charts, Index corner, double width, double angle);

}  // namespace octafield::surface::detail
