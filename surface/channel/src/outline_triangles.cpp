#include "octafield/surface/planar_outline.hpp"
#include "outline_segments.hpp"
#include "plane_triangulation.hpp"

namespace octafield::surface {

TriangleMesh outline_triangles(const PlanarOutline& outline) {
    require_planar(outline);
    const auto made = detail::triangulate(outline.points, detail::all_segments(outline));
    const std::vector<char> inside = detail::inside_loops(made, static_cast<Index>(outline.loops.rows()));
    TriangleMesh result;
    result.vertices = Points::Zero(outline.points.rows(), 3);
    result.vertices.leftCols<2>() = outline.points;
    Index count = 0;
    for (const char in : inside) count += in != 0;
    result.triangles.resize(count, 3);
    count = 0;
    for (Eigen::Index t = 0; t < made.triangles.rows(); ++t)
        if (inside[t]) result.triangles.row(count++) = made.triangles.row(t);
    return result;
}

}  // namespace octafield::surface
