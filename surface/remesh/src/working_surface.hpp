// A marked surface whose vertices know the length of edges there; the steps that change its triangles.
#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "marked_surface.hpp"

namespace octafield::surface {

using HalfEdgeOf = SurfaceMesh::Halfedge_index;

// Where on the input a vertex is: on a triangle, on a feature segment (a row of the features' edges) or at a vertex.
struct Carrier {
    enum class On : std::uint8_t { triangle, segment, vertex };
    On on = On::triangle;
    Index id = -1;  // -1: not told
};

// Handles of CGAL's properties refer to the mesh they were made for: it is never copied or moved.
struct Working {
    Working(const TriangleMesh& mesh, const FeatureGraph& features);
    Working(const Working&) = delete;
    Working& operator=(const Working&) = delete;

    Eigen::Vector3d at(Vertex v) const {
        const Point& p = marked.mesh.point(v);
        return {p.x(), p.y(), p.z()};
    }
    double edge_length(Edge e) const { return (at(marked.mesh.vertex(e, 0)) - at(marked.mesh.vertex(e, 1))).norm(); }
    double wanted(Vertex a, Vertex b) const { return (length[a] + length[b]) / 2; }
    double ratio(Edge e) const { return edge_length(e) / wanted(marked.mesh.vertex(e, 0), marked.mesh.vertex(e, 1)); }

    Marked marked;
    SurfaceMesh::Property_map<Vertex, double> length;
    SurfaceMesh::Property_map<Vertex, bool> pinned;      // stays where it is, as corners do
    SurfaceMesh::Property_map<Face, double> bend;        // curvature
    SurfaceMesh::Property_map<Vertex, Carrier> carrier;  // for those who walk on the input
    SurfaceMesh::Property_map<Edge, int> curve;          // of the input's feature curves; -1: none, or not told
};

// At the edge's middle. Halves of triangles keep patch and curvature, halves of feature edges are features.
Vertex split(Working& work, Edge edge);
// Splits edges of more than `most` times their wanted length, the worst first. split_one(edge) gives the new vertex, or
// none where it leaves the edge whole.
template <class SplitOne>
void split_long(Working& work, double most, const SplitOne& split_one);

}  // namespace octafield::surface

#include <queue>

namespace octafield::surface {

template <class SplitOne>
void split_long(Working& work, double most, const SplitOne& split_one) {
    std::priority_queue<std::pair<double, std::uint32_t>> longest;
    const auto look = [&](Edge e) {
        if (const double ratio = work.ratio(e); ratio > most) longest.emplace(ratio, static_cast<std::uint32_t>(e));
    };
    for (const Edge e : work.marked.mesh.edges()) look(e);
    while (!longest.empty()) {
        const auto [ratio, id] = longest.top();
        longest.pop();
        if (work.ratio(Edge(id)) != ratio) continue;  // it was split in the meantime
        const std::optional<Vertex> v = split_one(Edge(id));
        if (!v) continue;
        for (const HalfEdgeOf h : CGAL::halfedges_around_target(*v, work.marked.mesh)) look(work.marked.mesh.edge(h));
    }
}

}  // namespace octafield::surface
