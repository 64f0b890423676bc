#include "deviation.hpp"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

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

}  // namespace

double one_sided_distance(const TriangleMesh& from, const TriangleMesh& to) {
    std::vector<Kernel::Triangle_3> triangles;
    std::set<Corners> known;
    for (Index t = 0; t < to.triangles.rows(); ++t) {
        known.insert(corners(to, t));
        const auto point = [&](int k) {
            const auto p = to.vertices.row(to.triangles(t, k));
            return Kernel::Point_3(p[0], p[1], p[2]);
        };
        triangles.emplace_back(point(0), point(1), point(2));
        if (triangles.back().is_degenerate()) triangles.pop_back();  // the tree does not take these
    }
    if (triangles.empty()) return 0;
    using Primitive = CGAL::AABB_triangle_primitive<Kernel, std::vector<Kernel::Triangle_3>::const_iterator>;
    const CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>> tree(triangles.cbegin(), triangles.cend());
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

}  // namespace octafield::surface
