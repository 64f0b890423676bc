#include "deviation.hpp"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace octafield::surface {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Place = std::array<double, 3>;
using Corners = std::array<Place, 3>;

Place place(const Eigen::RowVector3d& point) { return {point[0], point[1], point[2]}; }

Corners corners(const TriangleMesh& mesh, Index t) {
    Corners found;
    for (int k = 0; k < 3; ++k) found[k] = place(mesh.vertices.row(mesh.triangles(t, k)));
    std::ranges::sort(found);
    return found;
}

using Primitive = CGAL::AABB_triangle_primitive<Kernel, std::vector<Kernel::Triangle_3>::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

// Without those of no area, which the tree does not take.
std::vector<Kernel::Triangle_3> triangles_of(const TriangleMesh& mesh) {
    std::vector<Kernel::Triangle_3> triangles;
    for (Index t = 0; t < mesh.triangles.rows(); ++t) {
        const auto point = [&](int k) {
            const auto p = mesh.vertices.row(mesh.triangles(t, k));
            return Kernel::Point_3(p[0], p[1], p[2]);
        };
        triangles.emplace_back(point(0), point(1), point(2));
        if (triangles.back().is_degenerate()) triangles.pop_back();
    }
    return triangles;
}

Eigen::Vector3d area_vector(const Kernel::Triangle_3& triangle) {
    const auto n = CGAL::cross_product(triangle[1] - triangle[0], triangle[2] - triangle[0]);
    return Eigen::Vector3d(n.x(), n.y(), n.z()) / 2;
}

}  // namespace

double one_sided_distance(const TriangleMesh& from, const TriangleMesh& to) {
    std::set<Corners> known;
    for (Index t = 0; t < to.triangles.rows(); ++t) known.insert(corners(to, t));
    const std::vector<Kernel::Triangle_3> triangles = triangles_of(to);
    if (triangles.empty()) return 0;
    const Tree tree(triangles.cbegin(), triangles.cend());
    double most = 0;
    const auto look = [&](const Eigen::RowVector3d& point) {
        most = std::max(most, CGAL::to_double(tree.squared_distance({point[0], point[1], point[2]})));
    };
    for (Index t = 0; t < from.triangles.rows(); ++t) {
        if (known.contains(corners(from, t))) continue;
        Eigen::RowVector3d centre = Eigen::RowVector3d::Zero();
        for (const Index v : from.triangles.row(t)) {
            look(from.vertices.row(v));
            centre += from.vertices.row(v) / 3;
        }
        look(centre);
    }
    return std::sqrt(most);
}

Points nearest_points(const Points& points, const TriangleMesh& to) {
    const std::vector<Kernel::Triangle_3> triangles = triangles_of(to);
    if (triangles.empty()) return points;
    const Tree tree(triangles.cbegin(), triangles.cend());
    Points nearest(points.rows(), 3);
    for (Index i = 0; i < points.rows(); ++i) {
        const auto found = tree.closest_point({points(i, 0), points(i, 1), points(i, 2)});
        nearest.row(i) << found.x(), found.y(), found.z();
    }
    return nearest;
}

double turned_share(const TriangleMesh& from, const TriangleMesh& to, double angle) {
    constexpr std::size_t most = 20000;
    const std::vector<Kernel::Triangle_3> there = triangles_of(from), here = triangles_of(to);
    if (there.empty() || here.empty()) return 0;
    const Tree tree(here.cbegin(), here.cend());
    const double least = std::cos(angle);
    double area = 0, turned = 0;
    for (std::size_t t = 0; t < there.size(); t += 1 + there.size() / most) {
        const Eigen::Vector3d wanted = area_vector(there[t]);
        const auto nearest = tree.closest_point_and_primitive(CGAL::centroid(there[t])).second;
        area += wanted.norm();
        if (std::abs(wanted.normalized().dot(area_vector(*nearest).normalized())) < least) turned += wanted.norm();
    }
    return area > 0 ? turned / area : 0;
}

}  // namespace octafield::surface
