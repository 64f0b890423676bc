// Tangent planes of vertices: angles round each vertex, how directions pass along edges from one vertex to the next,
// into triangles and into space.
#pragma once

#include <vector>

#include "charts.hpp"

namespace octafield::surface::detail {

// Angle 0 of a vertex is the first edge of its fan: at a boundary vertex the boundary edge that leaves it with the
// surface on its left. Round a vertex inside, angles are scaled so that the whole is 2 pi (polar map; Knoeppel et al.
// 2013); at the boundary they are those of the triangles. In the plane everything here is exact.
class VertexCharts {
public:
    // Throws GeometryError (kind "non_manifold_vertex", elements vertices) where parts of the surface touch at a vertex
    // only.
    explicit VertexCharts(const SurfaceDomain& domain);

    bool used(Index vertex) const { return fan_[vertex] >= 0; }
    bool on_boundary(Index vertex) const { return used(vertex) && !fan(vertex).closed; }
    const VertexFans::Fan& fan(Index vertex) const { return domain_.fans().fans[fan_[vertex]]; }
    double total(Index vertex) const { return total_[vertex]; }  // of the triangles' angles, unscaled
    double scale(Index vertex) const { return scale_[vertex]; }
    // Angle at which side k of triangle t leaves its first corner, corner = 3t + k.
    double leaving(Index corner) const { return leaving_[corner]; }
    // What a direction's angle grows by along edge e, from its lower to its higher vertex: in [-pi, pi].
    double transport(Index e) const { return transport_[e]; }
    // What an angle at the vertex of a corner grows by to be one in the chart of the corner's triangle.
    double into_triangle(const Charts& charts, Index corner) const;
    // Unit vector of a direction, orthogonal to the vertex normal, and back.
    Eigen::RowVector3d lifted(Index vertex, double angle) const;
    double lowered(Index vertex, const Eigen::RowVector3d& vector) const;

private:
    void measure_fans();
    void measure_edges();
    void find_axes();

    SurfaceDomain domain_;
    std::vector<Index> fan_;  // (V), -1: in no triangle
    std::vector<double> total_, scale_, leaving_, transport_;
    Points x_, y_;  // of the tangent planes
};

}  // namespace octafield::surface::detail
