#include <CGAL/AABB_segment_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <cmath>

#include "octafield/error.hpp"
#include "octafield/surface/wanted_sizes.hpp"
#include "size_checks.hpp"

namespace octafield::surface {
namespace {

using Flat = CGAL::Simple_cartesian<double>;
using Segments = std::vector<Flat::Segment_3>;
using SegmentTree =
    CGAL::AABB_tree<CGAL::AABB_traits<Flat, CGAL::AABB_segment_primitive<Flat, Segments::const_iterator>>>;

Flat::Point_3 point_of(const Eigen::RowVector3d& p) { return {p[0], p[1], p[2]}; }

}  // namespace

Eigen::VectorXd boundary_sizes(const SurfaceDomain& domain, const BoundarySizeOptions& options) {
    detail::require_in_space(domain);
    if (!(options.growth >= 0 && std::isfinite(options.growth)))
        throw InvalidInput("growth must be 0 or more; 0.2 is usual", "bad_option");
    if (!(options.largest >= 0 && std::isfinite(options.largest)))
        throw InvalidInput("largest must be a length, or 0 for no limit", "bad_option");
    const Points& points = domain.mesh().vertices;
    const EdgeTopology& topology = domain.topology();
    std::vector<Index> boundary;
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(points.rows()), count = sum;
    for (Index e = 0; e < domain.edge_count(); ++e) {
        if (topology.edge_triangles.row(e).minCoeff() >= 0) continue;
        boundary.push_back(e);
        for (const Index v : topology.edges.row(e)) {
            sum[v] += domain.edge_lengths()[e];
            count[v] += 1;
        }
    }
    if (boundary.empty())
        throw InvalidInput(
            "the surface has no boundary from which sizes could grow; give lengths per vertex, or those "
            "of size_field",
            "no_boundary");
    Segments segments;
    for (const Index e : boundary)
        segments.emplace_back(point_of(points.row(topology.edges(e, 0))), point_of(points.row(topology.edges(e, 1))));
    SegmentTree tree(segments.begin(), segments.end());
    tree.accelerate_distance_queries();
    Eigen::VectorXd sizes(points.rows());
    for (Index v = 0; v < sizes.size(); ++v) {
        const auto [near, segment] = tree.closest_point_and_primitive(point_of(points.row(v)));
        const auto ends = topology.edges.row(boundary[segment - segments.begin()]);
        const Eigen::RowVector3d place(near.x(), near.y(), near.z());
        const double length = (points.row(ends[1]) - points.row(ends[0])).norm();
        const double part = std::clamp((place - points.row(ends[0])).norm() / length, 0.0, 1.0);
        const double here = (1 - part) * sum[ends[0]] / count[ends[0]] + part * sum[ends[1]] / count[ends[1]];
        sizes[v] = here + options.growth * (place - points.row(v)).norm();
        if (options.largest > 0) sizes[v] = std::min(sizes[v], options.largest);
    }
    return sizes;
}

}  // namespace octafield::surface
