#include "face_layouts.hpp"

#include <numeric>

#include "arc_shortage.hpp"
#include "octafield/disjoint_sets.hpp"
#include "octafield/surface/motorcycle_graph.hpp"
#include "quad_builder.hpp"
#include "tile_arcs.hpp"

namespace octafield::surface::detail {
namespace {

// The faces by the edge lengths of the whole. Vertices keep their order, so edges of a face do, too.
void measure_alike(const SurfaceDomain& whole, const std::vector<Index>& face_of, const std::vector<Index>& set_of,
                   std::vector<Face>& faces) {
    std::vector<Eigen::VectorXd> lengths;
    for (const Face& face : faces) lengths.emplace_back(face.domain.edge_count());
    std::vector<Index> next(faces.size(), 0);
    for (Index e = 0; e < whole.edge_count(); ++e) {
        const Index f = face_of[set_of[whole.topology().edges(e, 0)]];
        lengths[f][next[f]++] = whole.edge_lengths()[e];
    }
    for (std::size_t f = 0; f < faces.size(); ++f)
        faces[f].domain = faces[f].domain.with_edge_lengths(std::move(lengths[f]));
}

}  // namespace

std::vector<Face> faces_of(const SurfaceDomain& domain, const SingularPattern& pattern,
                           const std::vector<Index>& origins) {
    const Triangles& triangles = domain.mesh().triangles;
    DisjointSets sets(domain.vertex_count());
    for (Index t = 0; t < triangles.rows(); ++t)
        for (int k = 1; k < 3; ++k) sets.join(triangles(t, 0), triangles(t, k));
    Index count = 0;
    const std::vector<Index> set_of = std::move(sets).numbers(count);
    std::vector<Index> face_of(count, -1), new_triangle(triangles.rows()), new_vertex(domain.vertex_count(), -1);
    std::vector<Face> faces;
    for (Index t = 0; t < triangles.rows(); ++t) {
        Index& f = face_of[set_of[triangles(t, 0)]];
        if (f < 0) {
            f = static_cast<Index>(faces.size());
            faces.emplace_back();
        }
        new_triangle[t] = static_cast<Index>(faces[f].triangles.size());
        faces[f].triangles.push_back(t);
    }
    for (Index v = 0; v < domain.vertex_count(); ++v) {
        if (face_of[set_of[v]] < 0) continue;  // in no triangle
        Face& face = faces[face_of[set_of[v]]];
        new_vertex[v] = static_cast<Index>(face.vertices.size());
        face.vertices.push_back(v);
        face.origins.push_back(origins[v]);
    }
    for (Face& face : faces) {
        TriangleMesh mesh{Points(face.vertices.size(), 3), Triangles(face.triangles.size(), 3)};
        for (std::size_t v = 0; v < face.vertices.size(); ++v)
            mesh.vertices.row(static_cast<Index>(v)) = domain.mesh().vertices.row(face.vertices[v]);
        for (std::size_t t = 0; t < face.triangles.size(); ++t)
            for (int k = 0; k < 3; ++k)
                mesh.triangles(static_cast<Index>(t), k) = new_vertex[triangles(face.triangles[t], k)];
        face.domain = SurfaceDomain(std::move(mesh));
    }
    if (domain.has_own_lengths()) measure_alike(domain, face_of, set_of, faces);
    for (ImposedPoint point : pattern.points) {
        Face& face = faces[face_of[set_of[triangles(point.triangle, 0)]]];
        point.triangle = new_triangle[point.triangle];
        face.pattern.points.push_back(point);
    }
    for (const CornerQuads& corner : pattern.corners)
        faces[face_of[set_of[corner.vertex]]].pattern.corners.push_back({new_vertex[corner.vertex], corner.quads});
    return faces;
}

QuadLayout traced(const Face& face, SingularPattern& pattern, const FaceTracing& tracing, const Progress& progress) {
    const ImposedField field = impose_singular_points(face.domain, pattern, tracing.imposing, progress);
    QuadLayout layout = motorcycle_graph(field, tracing.curves, progress);
    require_quads(layout);
    pattern.points = field.pattern.points;
    return layout;
}

Fit fit_of(const std::vector<Face>& faces, double size, const QuadLayout* other, std::size_t place) {
    std::vector<LayoutPart> parts;
    std::vector<const QuadLayout*> layouts;
    std::size_t sides = 0;
    for (std::size_t f = 0; f < faces.size(); ++f) {
        if (!faces[f].layout && !(other && f == place)) continue;
        layouts.push_back(other && f == place ? other : &*faces[f].layout);
        parts.push_back({layouts.back(), &faces[f].origins});
        sides += layouts.back()->sides.size();
    }
    const Seams seams = find_seams(parts);
    ArcProblem problem = arc_problem(layouts, seams);
    Fit fit{arc_shortages(problem)};
    fit.missing = std::accumulate(fit.shortages.begin(), fit.shortages.end(), 0.0);
    fit.shortages.resize(sides);
    if (fit.missing > 0) return fit;
    set_size(problem, layouts, seams, size, ArcWeights::equal);
    fit.deviation = least_deviation(problem);
    return fit;
}

}  // namespace octafield::surface::detail
