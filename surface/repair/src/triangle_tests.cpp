#include "triangle_tests.hpp"

#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/intersections.h>

#include <algorithm>

namespace octafield::surface {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Segment = Kernel::Segment_3;
using Triangle = Kernel::Triangle_3;
using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, Index, CGAL::Box_intersection_d::ID_FROM_BOX_ADDRESS>;

Point point(const TriangleMesh& mesh, Index v) {
    return {mesh.vertices(v, 0), mesh.vertices(v, 1), mesh.vertices(v, 2)};
}
Point corner(const TriangleMesh& mesh, Index t, int k) { return point(mesh, mesh.triangles(t, k % 3)); }
Triangle triangle(const TriangleMesh& mesh, Index t) {
    return {corner(mesh, t, 0), corner(mesh, t, 1), corner(mesh, t, 2)};
}
Segment side_after(const TriangleMesh& mesh, Index t, int k) { return {corner(mesh, t, k), corner(mesh, t, k + 1)}; }

// Do two triangles meet outside their shared vertices and edges? (The same case distinction as CGAL's
// self_intersections, which needs a manifold mesh.)
bool intersect(const TriangleMesh& mesh, Index s, Index t) {
    int shared = 0, at_s = 0, at_t = 0;  // the corners of the last shared vertex; their sum, to find the one not shared
    int sum_s = 0, sum_t = 0;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            if (mesh.triangles(s, i) == mesh.triangles(t, j)) {
                ++shared;
                at_s = i, at_t = j;
                sum_s += i, sum_t += j;
            }
    if (shared == 0) return CGAL::do_intersect(triangle(mesh, s), triangle(mesh, t));
    if (shared == 1)  // then one of the opposite sides must reach the other triangle
        return CGAL::do_intersect(triangle(mesh, s), side_after(mesh, t, at_t + 1)) ||
               CGAL::do_intersect(triangle(mesh, t), side_after(mesh, s, at_s + 1));
    if (shared == 3) return true;
    // One shared edge: they meet elsewhere only if folded flat onto each other.
    const int apex_s = 3 - sum_s, apex_t = 3 - sum_t;
    const Point a = corner(mesh, s, apex_s + 1), b = corner(mesh, s, apex_s + 2);
    const Point c = corner(mesh, s, apex_s), d = corner(mesh, t, apex_t);
    return CGAL::coplanar(a, b, c, d) && CGAL::coplanar_orientation(a, b, c, d) == CGAL::POSITIVE;
}

}  // namespace

bool is_degenerate(const TriangleMesh& mesh, Index t) {
    return CGAL::collinear(corner(mesh, t, 0), corner(mesh, t, 1), corner(mesh, t, 2));
}

std::vector<Index> intersecting_triangles(const TriangleMesh& mesh, Index first) {
    std::vector<Box> boxes;
    boxes.reserve(mesh.triangles.rows());
    for (Index t = 0; t < mesh.triangles.rows(); ++t)
        if (!is_degenerate(mesh, t)) boxes.emplace_back(triangle(mesh, t).bbox(), t);
    std::vector<const Box*> pointers, later;  // the algorithm sorts these instead of the boxes
    pointers.reserve(boxes.size());
    for (const Box& box : boxes) (box.info() < first ? pointers : later).push_back(&box);
    // A byte per triangle, as there may be far more pairs than triangles.
    std::vector<char> marked(mesh.triangles.rows(), 0);
    const std::ptrdiff_t cutoff = 2000;  // as CGAL's self_intersections: plain scans below this many boxes
    const auto mark = [&](const Box* a, const Box* b) {
        char &at_a = marked[a->info()], &at_b = marked[b->info()];
        if (!(at_a && at_b) && intersect(mesh, a->info(), b->info())) at_a = at_b = 1;
    };
    CGAL::box_self_intersection_d(later.begin(), later.end(), mark, cutoff);
    if (!pointers.empty() && !later.empty())
        CGAL::box_intersection_d(later.begin(), later.end(), pointers.begin(), pointers.end(), mark, cutoff);
    std::vector<Index> found;
    for (Index t = 0; t < mesh.triangles.rows(); ++t)
        if (marked[t]) found.push_back(t);
    return found;
}

}  // namespace octafield::surface
