#include "wrap.hpp"

#include <CGAL/alpha_wrap_3.h>

#include <array>

#include "surface_mesh.hpp"
#include "triangle_tests.hpp"

namespace octafield::surface {

TriangleMesh alpha_wrap(const TriangleMesh& mesh, double alpha, double offset) {
    std::vector<Kernel::Point_3> points;
    std::vector<std::array<std::size_t, 3>> faces;
    for (const auto point : mesh.vertices.rowwise()) points.emplace_back(point[0], point[1], point[2]);
    for (Index t = 0; t < mesh.triangles.rows(); ++t)
        if (!is_degenerate(mesh, t))
            faces.push_back({static_cast<std::size_t>(mesh.triangles(t, 0)),
                             static_cast<std::size_t>(mesh.triangles(t, 1)),
                             static_cast<std::size_t>(mesh.triangles(t, 2))});
    SurfaceMesh surface;
    if (!faces.empty()) CGAL::alpha_wrap_3(points, faces, alpha, offset, surface);
    return to_triangle_mesh(surface);
}

}  // namespace octafield::surface
