#include "working_surface.hpp"

#include <CGAL/boost/graph/Euler_operations.h>

namespace octafield::surface {

Working::Working(const TriangleMesh& mesh, const FeatureGraph& features) : marked(mark(mesh, features)) {
    length = marked.mesh.add_property_map<Vertex, double>("v:length", 0).first;
    pinned = marked.mesh.add_property_map<Vertex, bool>("v:pinned", false).first;
    carrier = marked.mesh.add_property_map<Vertex, Carrier>("v:carrier", {}).first;
    curve = marked.mesh.add_property_map<Edge, int>("e:curve", -1).first;
    bend = marked.mesh.add_property_map<Face, double>("f:bend", 0).first;
}

Vertex split(Working& work, Edge edge) {
    SurfaceMesh& mesh = work.marked.mesh;
    const HalfEdgeOf h = mesh.halfedge(edge);
    const Vertex a = mesh.source(h), b = mesh.target(h);
    const bool feature = work.marked.feature[edge];
    const int curve = work.curve[edge];
    const Eigen::Vector3d middle = (work.at(a) + work.at(b)) / 2;
    const HalfEdgeOf first = CGAL::Euler::split_edge(h, mesh);  // a to the new vertex; h goes on to b
    const Vertex v = mesh.target(first);
    mesh.point(v) = Point(middle[0], middle[1], middle[2]);
    work.length[v] = (work.length[a] + work.length[b]) / 2;
    work.marked.corner[v] = work.pinned[v] = false;
    work.marked.feature[mesh.edge(first)] = work.marked.feature[mesh.edge(h)] = feature;
    work.curve[mesh.edge(first)] = work.curve[mesh.edge(h)] = curve;
    work.carrier[v] = {};
    const auto halve = [&](HalfEdgeOf into) {
        if (mesh.is_border(into)) return;
        const Face old = mesh.face(into);
        const HalfEdgeOf between = CGAL::Euler::split_face(into, mesh.next(mesh.next(into)), mesh);
        work.marked.feature[mesh.edge(between)] = false;
        work.curve[mesh.edge(between)] = -1;
        for (const Face face : {mesh.face(between), mesh.face(mesh.opposite(between))}) {
            work.marked.patch[face] = work.marked.patch[old];
            work.bend[face] = work.bend[old];
        }
    };
    halve(first);
    halve(mesh.opposite(h));
    return v;
}

}  // namespace octafield::surface
