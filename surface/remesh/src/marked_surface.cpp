#include "marked_surface.hpp"

#include <CGAL/Polygon_mesh_processing/connected_components.h>

#include <algorithm>

#include "octafield/error.hpp"

namespace octafield::surface {

namespace pmp = CGAL::Polygon_mesh_processing;

void number_patches(Marked& marked) {
    marked.patches = static_cast<int>(pmp::connected_components(
        marked.mesh, marked.patch, CGAL::parameters::edge_is_constrained_map(marked.feature)));
}

Marked mark(const TriangleMesh& mesh, const FeatureGraph& features) {
    Marked marked;
    if (!to_surface_mesh(mesh, marked.mesh))
        throw GeometryError("the surface is not an oriented manifold; validate and repair it first",
                            "non_manifold_edge");
    marked.feature = marked.mesh.add_property_map<Edge, bool>("e:feature", false).first;
    marked.corner = marked.mesh.add_property_map<Vertex, bool>("v:corner", false).first;
    marked.patch = marked.mesh.add_property_map<Face, int>("f:patch", 0).first;
    for (const auto edge : features.edges.rowwise())
        marked.feature[marked.mesh.edge(marked.mesh.halfedge(Vertex(edge[0]), Vertex(edge[1])))] = true;
    for (const Edge edge : marked.mesh.edges())
        if (marked.mesh.is_border(edge)) marked.feature[edge] = true;
    for (const Index v : features.corners) marked.corner[Vertex(v)] = true;
    number_patches(marked);
    return marked;
}

RemeshResult to_arrays(Marked& marked) {
    for (const Vertex v : marked.mesh.vertices())
        if (marked.mesh.is_isolated(v)) marked.mesh.remove_vertex(v);
    marked.mesh.collect_garbage();
    const SurfaceMesh& mesh = marked.mesh;
    RemeshResult result;
    result.mesh.vertices.resize(mesh.number_of_vertices(), 3);
    result.mesh.triangles.resize(mesh.number_of_faces(), 3);
    for (const Vertex v : mesh.vertices()) {
        const Point& point = mesh.point(v);
        result.mesh.vertices.row(static_cast<Index>(v)) << point.x(), point.y(), point.z();
        if (marked.corner[v]) result.features.corners.push_back(static_cast<Index>(v));
    }
    for (const Face face : mesh.faces()) {
        int k = 0;
        for (const Vertex v : CGAL::vertices_around_face(mesh.halfedge(face), mesh))
            result.mesh.triangles(static_cast<Index>(face), k++) = static_cast<Index>(v);
    }
    std::vector<std::pair<Index, Index>> edges;
    for (const Edge edge : mesh.edges())
        if (marked.feature[edge])
            edges.push_back(
                std::minmax(static_cast<Index>(mesh.vertex(edge, 0)), static_cast<Index>(mesh.vertex(edge, 1))));
    std::ranges::sort(edges);
    result.features.edges.resize(edges.size(), 2);
    for (std::size_t i = 0; i < edges.size(); ++i) result.features.edges.row(i) << edges[i].first, edges[i].second;
    return result;
}

PatchTrees::PatchTrees(const Marked& surface) {
    std::vector<std::vector<Face>> faces(surface.patches);
    for (const Face face : surface.mesh.faces()) faces[surface.patch[face]].push_back(face);
    for (const auto& of_patch : faces)
        trees_.push_back(std::make_unique<Tree>(of_patch.begin(), of_patch.end(), surface.mesh));
}

int patch_at(const Marked& marked, Vertex v) {
    const auto half_edge = marked.mesh.halfedge(v);
    const bool border = marked.mesh.is_border(half_edge);
    return marked.patch[marked.mesh.face(border ? marked.mesh.opposite(half_edge) : half_edge)];
}

}  // namespace octafield::surface
