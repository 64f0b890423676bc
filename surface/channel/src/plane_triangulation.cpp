#include "plane_triangulation.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <unordered_map>

#include "plane_quads.hpp"

namespace octafield::surface::detail {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vertex = CGAL::Triangulation_vertex_base_with_info_2<Index, Kernel>;
using Face =
    CGAL::Constrained_triangulation_face_base_2<Kernel, CGAL::Triangulation_face_base_with_info_2<Index, Kernel>>;
using Structure = CGAL::Triangulation_data_structure_2<Vertex, Face>;
using Constrained = CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure>;

}  // namespace

PlaneTriangulation triangulate(const PlanePoints& points, const Edges& segments) {
    std::vector<std::pair<Kernel::Point_2, Index>> places;
    for (Index i = 0; i < points.rows(); ++i) places.push_back({{points(i, 0), points(i, 1)}, i});
    Constrained made;
    made.insert(places.begin(), places.end());
    std::vector<Constrained::Vertex_handle> vertex(points.rows());
    for (const auto v : made.finite_vertex_handles()) vertex[v->info()] = v;
    std::unordered_map<std::uint64_t, Index> segment_of;
    for (Index s = 0; s < segments.rows(); ++s) {
        made.insert_constraint(vertex[segments(s, 0)], vertex[segments(s, 1)]);
        segment_of[edge_key(segments(s, 0), segments(s, 1))] = s;
    }
    PlaneTriangulation result;
    const Index count = static_cast<Index>(made.number_of_faces());
    for (Triangles* each : {&result.triangles, &result.neighbours, &result.segments}) each->resize(count, 3);
    for (const auto face : made.all_face_handles()) face->info() = -1;
    Index next = 0;
    for (const auto face : made.finite_face_handles()) face->info() = next++;
    for (const auto face : made.finite_face_handles())
        for (int k = 0; k < 3; ++k) {
            const Index t = face->info();
            const Index a = face->vertex((k + 1) % 3)->info(), b = face->vertex((k + 2) % 3)->info();
            result.triangles(t, k) = face->vertex(k)->info();
            result.neighbours(t, k) = face->neighbor(k)->info();
            const auto found = segment_of.find(edge_key(a, b));
            result.segments(t, k) = found == segment_of.end() ? -1 : found->second;
        }
    return result;
}

std::vector<char> inside_loops(const PlaneTriangulation& made, Index loops) {
    const Index count = static_cast<Index>(made.triangles.rows());
    std::vector<char> inside(count, 2);  // 2: not known
    std::vector<Index> open;
    const auto is_loop = [&](Index t, int k) { return made.segments(t, k) >= 0 && made.segments(t, k) < loops; };
    const auto reach = [&](Index t, bool value) {
        if (inside[t] != 2) return;
        inside[t] = value;
        open.push_back(t);
    };
    for (Index t = 0; t < count; ++t)
        for (int k = 0; k < 3; ++k)
            if (made.neighbours(t, k) < 0) reach(t, is_loop(t, k));
    while (!open.empty()) {
        const Index t = open.back();
        open.pop_back();
        for (int k = 0; k < 3; ++k)
            if (made.neighbours(t, k) >= 0) reach(made.neighbours(t, k), (inside[t] != 0) != is_loop(t, k));
    }
    return inside;
}

std::vector<Index> parts_of(const PlaneTriangulation& made, const std::vector<char>& wanted, Index& count) {
    std::vector<Index> part(made.triangles.rows(), -1), open;
    count = 0;
    for (Index first = 0; first < static_cast<Index>(part.size()); ++first) {
        if (!wanted[first] || part[first] >= 0) continue;
        part[first] = count++;
        open.assign(1, first);
        while (!open.empty()) {
            const Index t = open.back();
            open.pop_back();
            for (int k = 0; k < 3; ++k) {
                const Index next = made.neighbours(t, k);
                if (next < 0 || made.segments(t, k) >= 0 || !wanted[next] || part[next] >= 0) continue;
                part[next] = part[first];
                open.push_back(next);
            }
        }
    }
    return part;
}

std::vector<Index> triangles_at(const PlaneTriangulation& made, const PlanePoints& points,
                                const Eigen::Vector2d& place) {
    const auto at = [&](Index v) { return Kernel::Point_2(points(v, 0), points(v, 1)); };
    const Kernel::Point_2 here(place[0], place[1]);
    std::vector<Index> result;
    for (Index t = 0; t < made.triangles.rows(); ++t) {
        bool holds = true;
        for (int k = 0; k < 3 && holds; ++k)
            holds = CGAL::orientation(at(made.triangles(t, k)), at(made.triangles(t, (k + 1) % 3)), here) !=
                    CGAL::RIGHT_TURN;
        if (holds) result.push_back(t);
    }
    return result;
}

}  // namespace octafield::surface::detail
