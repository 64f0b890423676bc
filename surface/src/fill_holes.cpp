#include "fill_holes.hpp"

#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>

#include <algorithm>
#include <iterator>

#include "surface_mesh.hpp"

namespace octafield::surface {

namespace {

// CGAL's triangulation is not defined where boundary loops pass a vertex twice or two vertices coincide.
bool is_fillable(const SurfaceMesh& surface, SurfaceMesh::Halfedge_index hole, const std::vector<int>& passes,
                 int max_edges) {
    std::vector<Kernel::Point_3> points;
    bool pinched = false, one_triangle = true;  // the rim of a single triangle is no hole
    const auto face_beyond = [&](SurfaceMesh::Halfedge_index side) { return surface.face(surface.opposite(side)); };
    for (const auto side : CGAL::halfedges_around_face(hole, surface)) {
        points.push_back(surface.point(surface.target(side)));
        if (passes[surface.target(side)] > 1) pinched = true;
        if (face_beyond(side) != face_beyond(hole)) one_triangle = false;
    }
    if (pinched || one_triangle || points.size() > static_cast<std::size_t>(std::max(max_edges, 0))) return false;
    std::ranges::sort(points);
    return std::ranges::adjacent_find(points) == points.end();
}

}  // namespace

HoleFilling fill_holes(const TriangleMesh& mesh, int max_edges) {
    namespace pmp = CGAL::Polygon_mesh_processing;
    HoleFilling result;
    SurfaceMesh surface;
    if (!to_surface_mesh(mesh, surface)) return result;
    std::vector<SurfaceMesh::Halfedge_index> holes;
    pmp::extract_boundary_cycles(surface, std::back_inserter(holes));
    std::vector<int> passes(mesh.vertices.rows(), 0);
    for (const auto side : surface.halfedges())
        if (surface.is_border(side)) ++passes[surface.target(side)];
    for (const auto hole : holes) {
        std::vector<SurfaceMesh::Face_index> faces;
        if (is_fillable(surface, hole, passes, max_edges))
            pmp::triangulate_hole(surface, hole, std::back_inserter(faces));
        ++(faces.empty() ? result.left : result.filled);
        for (const auto face : faces) {
            Eigen::Matrix<Index, 3, 1> triangle;
            int k = 0;
            for (const auto v : CGAL::vertices_around_face(surface.halfedge(face), surface))
                triangle[k++] = static_cast<Index>(v);
            result.triangles.push_back(triangle);
        }
    }
    return result;
}

}  // namespace octafield::surface
