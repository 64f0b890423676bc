// A surface while it is remeshed, and distances from its patches.
#pragma once

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>

#include <memory>
#include <vector>

#include "octafield/surface/remesh.hpp"
#include "surface_mesh.hpp"

namespace octafield::surface {

using Point = Kernel::Point_3;
using Vertex = SurfaceMesh::Vertex_index;
using Edge = SurfaceMesh::Edge_index;
using Face = SurfaceMesh::Face_index;

// The mesh in CGAL's hands, with what must survive marked on it.
struct Marked {
    SurfaceMesh mesh;
    SurfaceMesh::Property_map<Edge, bool> feature;
    SurfaceMesh::Property_map<Vertex, bool> corner;
    SurfaceMesh::Property_map<Face, int> patch;  // between features
    int patches = 0;
};

// Patches are numbered by their lowest face, so splitting edges does not change the numbers.
void number_patches(Marked& marked);
// Throws GeometryError where the mesh is no oriented manifold.
Marked mark(const TriangleMesh& mesh, const FeatureGraph& features);
// Without what is no longer used, which is removed from `marked`.
RemeshResult to_arrays(Marked& marked);

// Nearest points of single patches, so that thin walls do not attract each other. Refers to the surface.
class PatchTrees {
public:
    explicit PatchTrees(const Marked& surface);
    bool empty(int patch) const { return trees_[patch]->empty(); }
    Point closest(int patch, const Point& point) const { return trees_[patch]->closest_point(point); }

private:
    using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CGAL::AABB_face_graph_triangle_primitive<SurfaceMesh>>>;
    std::vector<std::unique_ptr<Tree>> trees_;
};

// Of one of the patches that meet at a vertex.
int patch_at(const Marked& marked, Vertex v);

}  // namespace octafield::surface
