#include <CGAL/Polygon_mesh_processing/repair_self_intersections.h>

#include "resolve_crossings.hpp"
#include "surface_mesh.hpp"
#include "triangle_tests.hpp"

namespace octafield::surface {

bool remove_crossings(TriangleMesh& mesh) {
    namespace pmp = CGAL::Polygon_mesh_processing;
    // First without changing the topology; then handles may be cut, as where two bars of one piece cross.
    for (const bool keep_genus : {true, false}) {
        try {
            SurfaceMesh surface;
            if (!to_surface_mesh(mesh, surface)) return false;
            if (!pmp::experimental::remove_self_intersections(surface, CGAL::parameters::preserve_genus(keep_genus)))
                continue;
            TriangleMesh result = to_triangle_mesh(surface);
            if (result.triangles.rows() == 0 || !intersecting_triangles(result).empty()) continue;
            mesh = std::move(result);
            return true;
        } catch (const CGAL::Failure_exception&) {  // of its parts: the next way
        }
    }
    return false;
}

}  // namespace octafield::surface
