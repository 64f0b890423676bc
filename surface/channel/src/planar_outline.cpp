#include "octafield/surface/planar_outline.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "octafield/error.hpp"
#include "outline_segments.hpp"
#include "plane_triangulation.hpp"

namespace octafield::surface {
namespace {

using namespace detail;

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_2;
using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 2, Index>;
using Ids = std::vector<Index>;

constexpr double largest = 1e100;  // its square is a number, too

void throw_if_any(const Ids& ids, const char* kind, const std::string& what, const std::string& remedy) {
    if (!ids.empty()) throw GeometryError(what + " (" + first_few(ids) + "); " + remedy, kind, ids);
}

void require_points(const PlanePoints& points, const Edges& segments) {
    const Index count = static_cast<Index>(points.rows());
    Ids lost, outside;
    for (Index i = 0; i < count; ++i)
        if (!points.row(i).allFinite()) lost.push_back(i);
    if (!lost.empty())
        throw InvalidInput(
            "points have coordinates that are not finite (" + first_few(lost) + "); correct or remove them",
            "non_finite_vertex", lost);
    const PlanePoints size = points.colwise().maxCoeff() - points.colwise().minCoeff();
    if (count > 0 && !(points.cwiseAbs().maxCoeff() < largest && size.maxCoeff() > 1 / largest))
        throw InvalidInput(
            "coordinates are too large, or too near to each other, to be reckoned with; choose another unit",
            "extreme_coordinates");
    for (Index s = 0; s < segments.rows(); ++s)
        if (segments.row(s).minCoeff() < 0 || segments.row(s).maxCoeff() >= count) outside.push_back(s);
    if (!outside.empty())
        throw InvalidInput("segments name points that do not exist (" + first_few(outside) + ")", "index_out_of_range",
                           outside);
}

void require_different(const PlanePoints& points, const Edges& segments) {
    const auto before = [&](Index a, Index b) {
        const auto p = points.row(a), q = points.row(b);
        return p[0] != q[0] ? p[0] < q[0] : p[1] < q[1];
    };
    Ids order(points.rows()), same, flat;
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), before);
    for (std::size_t i = 1; i < order.size(); ++i)
        if (!before(order[i - 1], order[i])) same.push_back(order[i]);
    std::sort(same.begin(), same.end());
    throw_if_any(same, "repeated_point", "points are at the place of another", "use one point for both");
    for (Index s = 0; s < segments.rows(); ++s)
        if (segments(s, 0) == segments(s, 1)) flat.push_back(s);
    throw_if_any(flat, "no_length", "segments start and end at the same point", "remove them");
}

void require_loops(const PlanarOutline& outline) {
    std::vector<int> count(outline.points.rows(), 0);
    for (Index s = 0; s < outline.loops.rows(); ++s)
        for (int k = 0; k < 2; ++k) ++count[outline.loops(s, k)];
    Ids open, touching;
    for (Index i = 0; i < static_cast<Index>(count.size()); ++i) {
        if (count[i] == 1) open.push_back(i);
        if (count[i] > 2) touching.push_back(i);
    }
    throw_if_any(open, "open_loop", "loops end at points", "close them");
    throw_if_any(touching, "touching_loops", "loops touch at points",
                 "move them apart, or give what divides the region as lines");
}

// Whether two segments have more in common than an end of both.
bool meet(const std::array<Point, 4>& p, const std::array<Index, 4>& ids) {
    for (int i = 0; i < 2; ++i)
        for (int j = 2; j < 4; ++j)
            if (ids[i] == ids[j]) {
                const Point &a = p[1 - i], &b = p[5 - j];
                return ids[1 - i] == ids[5 - j] ||
                       (CGAL::collinear(a, p[i], b) && !CGAL::collinear_are_strictly_ordered_along_line(a, p[i], b));
            }
    return CGAL::do_intersect(Kernel::Segment_2(p[0], p[1]), Kernel::Segment_2(p[2], p[3]));
}

void require_apart(const PlanePoints& points, const Edges& segments) {
    std::vector<Box> boxes;
    for (Index s = 0; s < segments.rows(); ++s) {
        const auto p = points.row(segments(s, 0)), q = points.row(segments(s, 1));
        const CGAL::Bbox_2 box = Point(p[0], p[1]).bbox() + Point(q[0], q[1]).bbox();
        boxes.emplace_back(box, s);
    }
    std::set<Index> found;
    CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
        std::array<Index, 4> ids{segments(a.info(), 0), segments(a.info(), 1), segments(b.info(), 0),
                                 segments(b.info(), 1)};
        std::array<Point, 4> places;
        for (int i = 0; i < 4; ++i) places[i] = Point(points(ids[i], 0), points(ids[i], 1));
        if (meet(places, ids)) found.insert({a.info(), b.info()});
    });
    throw_if_any({found.begin(), found.end()}, "crossing", "segments cross, overlap or end on one another",
                 "divide both where they meet, or move them apart");
}

// What each triangle's side lies on, from inside and outside.
void sort_segments(const PlaneTriangulation& made, const std::vector<char>& outside, const Edges& segments,
                   PlanarOutline& result) {
    std::vector<int> sides(segments.rows(), 0);  // inside, of each segment
    for (Index t = 0; t < made.triangles.rows(); ++t)
        for (int k = 0; k < 3 && !outside[t]; ++k)
            if (made.segments(t, k) >= 0) ++sides[made.segments(t, k)];
    const auto of = [&](int count) {
        std::vector<Index> rows;
        for (Index s = 0; s < segments.rows(); ++s)
            if (sides[s] == count) rows.push_back(s);
        return Edges(segments(rows, Eigen::all));
    };
    result.loops = of(1);
    result.lines = of(2);
}

}  // namespace

namespace detail {

Edges all_segments(const PlanarOutline& outline) {
    Edges all(outline.loops.rows() + outline.lines.rows(), 2);
    all << outline.loops, outline.lines;
    return all;
}

void require_graph(const PlanePoints& points, const Edges& segments) {
    require_points(points, segments);
    require_different(points, segments);
    require_apart(points, segments);
}

}  // namespace detail

void require_planar(const PlanarOutline& outline) {
    if (outline.loops.rows() == 0) throw InvalidInput("the outline has no loop, so nothing is inside", "empty");
    const Edges segments = all_segments(outline);
    require_points(outline.points, segments);
    require_different(outline.points, segments);
    require_loops(outline);
    require_apart(outline.points, segments);
}

PlanarOutline outline_of_graph(const PlanePoints& points, const Edges& segments, const PlanePoints& holes) {
    require_graph(points, segments);
    if (!holes.allFinite())
        throw InvalidInput("points of holes have coordinates that are not finite", "non_finite_vertex");
    const PlaneTriangulation made = triangulate(points, segments);
    std::vector<char> outside(made.triangles.rows(), false);
    std::vector<Index> open;
    const auto reach = [&](Index t) {
        if (outside[t]) return;
        outside[t] = true;
        open.push_back(t);
    };
    for (Index t = 0; t < made.triangles.rows(); ++t)
        for (int k = 0; k < 3; ++k)
            if (made.neighbours(t, k) < 0 && made.segments(t, k) < 0) reach(t);
    for (Index h = 0; h < holes.rows(); ++h)
        for (const Index t : triangles_at(made, points, holes.row(h))) reach(t);
    while (!open.empty()) {
        const Index t = open.back();
        open.pop_back();
        for (int k = 0; k < 3; ++k)
            if (made.neighbours(t, k) >= 0 && made.segments(t, k) < 0) reach(made.neighbours(t, k));
    }
    PlanarOutline result;
    result.points = points;
    sort_segments(made, outside, segments, result);
    if (result.loops.rows() == 0) throw InvalidInput("no segments go round a region, so nothing is inside", "empty");
    return result;
}

}  // namespace octafield::surface
