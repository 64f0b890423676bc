// CGAL's halfedge mesh, for the sources that hand a mesh to CGAL's mesh algorithms.
#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/iterator.h>

#include "octafield/surface/triangle_mesh.hpp"

namespace octafield::surface {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;

// Vertices and faces in the order of the arrays, so that CGAL's indices are ours. False where CGAL refuses a triangle
// (not a manifold, or not consistently oriented).
inline bool to_surface_mesh(const TriangleMesh& mesh, SurfaceMesh& result) {
    using Vertex = SurfaceMesh::Vertex_index;
    result.clear();
    result.reserve(mesh.vertices.rows(), 3 * mesh.triangles.rows() / 2, mesh.triangles.rows());
    for (const auto point : mesh.vertices.rowwise()) result.add_vertex(Kernel::Point_3(point[0], point[1], point[2]));
    for (const auto triangle : mesh.triangles.rowwise())
        if (result.add_face(Vertex(triangle[0]), Vertex(triangle[1]), Vertex(triangle[2])) == SurfaceMesh::null_face())
            return false;
    return true;
}

// Removed elements and isolated vertices are left out; the others keep their order.
inline TriangleMesh to_triangle_mesh(SurfaceMesh& surface) {
    for (const auto v : surface.vertices())
        if (surface.is_isolated(v)) surface.remove_vertex(v);
    surface.collect_garbage();
    TriangleMesh mesh;
    mesh.vertices.resize(surface.number_of_vertices(), 3);
    mesh.triangles.resize(surface.number_of_faces(), 3);
    for (const auto v : surface.vertices()) {
        const auto& point = surface.point(v);
        mesh.vertices.row(static_cast<Index>(v)) << point.x(), point.y(), point.z();
    }
    for (const auto face : surface.faces()) {
        int k = 0;
        for (const auto v : CGAL::vertices_around_face(surface.halfedge(face), surface))
            mesh.triangles(static_cast<Index>(face), k++) = static_cast<Index>(v);
    }
    return mesh;
}

}  // namespace octafield::surface
