#include <CGAL/Polygon_mesh_processing/corefinement.h>

#include <algorithm>
#include <numeric>

#include "half_edges.hpp"
#include "resolve_crossings.hpp"
#include "shells.hpp"
#include "surface_mesh.hpp"
#include "triangle_tests.hpp"

namespace octafield::surface {
namespace {

TriangleMesh compact(const TriangleMesh& mesh, const std::vector<Index>& chosen) {
    std::vector<Index> new_id(mesh.vertices.rows(), -1);
    TriangleMesh part{Points(mesh.vertices.rows(), 3), Triangles(static_cast<Eigen::Index>(chosen.size()), 3)};
    Index count = 0;
    for (std::size_t t = 0; t < chosen.size(); ++t)
        for (int k = 0; k < 3; ++k) {
            const Index v = mesh.triangles(chosen[t], k);
            if (new_id[v] < 0) {
                new_id[v] = count;
                part.vertices.row(count++) = mesh.vertices.row(v);
            }
            part.triangles(static_cast<Index>(t), k) = new_id[v];
        }
    part.vertices.conservativeResize(count, 3);
    return part;
}

TriangleMesh joined(const TriangleMesh& a, const TriangleMesh& b) {
    TriangleMesh both{Points(a.vertices.rows() + b.vertices.rows(), 3),
                      Triangles(a.triangles.rows() + b.triangles.rows(), 3)};
    both.vertices << a.vertices, b.vertices;
    both.triangles << a.triangles, (b.triangles.array() + static_cast<Index>(a.vertices.rows())).matrix();
    return both;
}

bool is_closed(const TriangleMesh& mesh) {
    bool closed = true;
    for_each_edge(sorted_half_edges(mesh.triangles),
                  [&](auto first, auto last) { closed = closed && last - first == 2; });
    return closed;
}

// Empty where corefinement cannot make it a manifold.
TriangleMesh united(const TriangleMesh& a, const TriangleMesh& b) {
    SurfaceMesh first, second, result;
    try {
        if (!to_surface_mesh(a, first) || !to_surface_mesh(b, second) ||
            !CGAL::Polygon_mesh_processing::corefine_and_compute_union(first, second, result))
            return {};
    } catch (const CGAL::Failure_exception&) {
        return {};
    }
    return to_triangle_mesh(result);
}

}  // namespace

std::size_t unite_crossing_pieces(TriangleMesh& mesh) {
    const std::vector<Index> piece_of = connected_pieces(mesh, sorted_half_edges(mesh.triangles));
    const Index count = piece_of.empty() ? 0 : *std::ranges::max_element(piece_of) + 1;
    if (count < 2) return 0;
    std::vector<std::vector<Index>> triangles(count);
    for (Index t = 0; t < mesh.triangles.rows(); ++t) triangles[piece_of[t]].push_back(t);
    std::vector<TriangleMesh> pieces(count);
    std::vector<bool> usable(count);
    for (Index p = 0; p < count; ++p) {
        pieces[p] = compact(mesh, triangles[p]);
        usable[p] = is_closed(pieces[p]) && signed_volume(pieces[p]) > 0 && intersecting_triangles(pieces[p]).empty();
    }
    std::size_t absorbed = 0;
    for (Index p = 0; p < count; ++p) {
        if (!usable[p]) continue;
        for (Index q = 0; q < count; ++q) {
            if (q == p || !usable[q]) continue;
            const TriangleMesh both = joined(pieces[p], pieces[q]);
            if (intersecting_triangles(both, static_cast<Index>(pieces[p].triangles.rows())).empty()) continue;
            TriangleMesh sum = united(pieces[p], pieces[q]);
            if (sum.triangles.rows() == 0) continue;
            pieces[p] = std::move(sum);
            usable[q] = false;
            pieces[q] = {Points(0, 3), Triangles(0, 3)};
            ++absorbed;
            q = -1;  // the sum may cross pieces that p did not
        }
    }
    if (absorbed == 0) return 0;
    TriangleMesh all = {Points(0, 3), Triangles(0, 3)};
    for (const TriangleMesh& piece : pieces) all = joined(all, piece);
    mesh = std::move(all);
    return absorbed;
}

}  // namespace octafield::surface
