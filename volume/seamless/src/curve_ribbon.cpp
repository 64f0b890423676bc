#include "curve_ribbon.hpp"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <set>

#include "axis_numbers.hpp"
#include "octafield/frames/quaternion.hpp"

namespace octafield::volume::detail {
namespace {

using Eigen::Vector3d;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, std::vector<Kernel::Triangle_3>::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

constexpr int steps_outside = 4;  // beyond the surface, so that no edge of it passes the ribbon's end
constexpr int spreading = 4;      // steps in which a ribbon becomes wider
// Of a step: in meshes along axes a ribbon from middles of tets would pass through edges and vertices.
const Vector3d aside{0.031, 0.017, 0.023};
constexpr int most_tets = 1000;  // on the way of one step

Kernel::Point_3 point(const Vector3d& p) { return {p[0], p[1], p[2]}; }

Eigen::Vector4d weights_in(const TetMesh& mesh, Index tet, const Vector3d& p) {
    Eigen::Matrix3d edges;
    const Vector3d first = mesh.vertices.row(mesh.tets(tet, 0));
    for (int k = 0; k < 3; ++k) edges.col(k) = mesh.vertices.row(mesh.tets(tet, k + 1)).transpose() - first;
    const Vector3d w = edges.inverse() * (p - first);
    return {1 - w.sum(), w[0], w[1], w[2]};
}

// The tet that holds the point, looked for from one near; -1 where the surface is on the way.
Index tet_towards(const TetDomain& domain, Index tet, const Vector3d& p) {
    const TriangleTable& table = domain.triangles();
    for (int i = 0; i < most_tets; ++i) {
        int corner;
        if (weights_in(domain.mesh(), tet, p).minCoeff(&corner) >= 0) return tet;
        const Index row = table.tet_triangles(tet, corner);
        const Index other = table.sides(row, table.sides(row, 0) / 4 == tet ? 1 : 0);
        if (other < 0) return -1;
        tet = other / 4;
    }
    return -1;
}

}  // namespace

std::optional<Ribbon> swept_ribbon(const TetDomain& domain, const Quaternions& frames,
                                   const std::vector<Vector3d>& line, const std::vector<Index>& tets,
                                   const Vector3d& along, double step, double spread, int most_steps) {
    const TetMesh& mesh = domain.mesh();
    Ribbon ribbon{{line}, {}};
    std::vector<Index> held = tets;
    Vector3d direction = along;
    const auto axis_at = [&](Index tet, const Vector3d& p) {
        const Eigen::Vector4d w = weights_in(mesh, tet, p);
        Vector3d sum = Vector3d::Zero();
        for (int k = 0; k < 4; ++k) {
            const frames::Quaternion q = frames::from_wxyz(frames.row(mesh.tets(tet, k)));
            sum += std::max(w[k], 0.0) * (q * axis_unit(nearest_axis_number(q.conjugate() * direction)));
        }
        return sum;
    };
    for (int i = 0, outside = 0; i < most_steps; ++i) {
        const std::vector<Vector3d>& row = ribbon.rows.back();
        Vector3d sum = Vector3d::Zero();
        for (std::size_t k = 0; k < row.size(); ++k)
            if (held[k] >= 0) sum += axis_at(held[k], row[k]);
        if (sum.norm() > 0) direction = sum.normalized();
        std::vector<Vector3d> next;
        bool left = true;
        const Vector3d centre = (row.front() + row.back()) / 2;
        const double wider = i < spreading ? std::pow(spread, 1.0 / spreading) : 1;
        for (std::size_t k = 0; k < row.size(); ++k) {
            const Vector3d arm = row[k] - centre, across = arm - arm.dot(direction) * direction;
            next.push_back(row[k] + step * direction + (wider - 1) * across);
            if (i == 0) next.back() += step * aside;
            if (held[k] >= 0) held[k] = tet_towards(domain, held[k], next.back());
            left = left && held[k] < 0;
        }
        ribbon.along.push_back(direction);
        ribbon.rows.push_back(std::move(next));
        if (left && ++outside == steps_outside) {
            ribbon.along.push_back(direction);
            return ribbon;
        }
    }
    return std::nullopt;
}

Ribbon straight_ribbon(const std::vector<Vector3d>& first, const std::vector<Vector3d>& last, double step) {
    // Every point of one line has its place on the other, so that both are kept.
    const auto shares = [](const std::vector<Vector3d>& line) {
        std::vector<double> at{0};
        for (std::size_t i = 1; i < line.size(); ++i) at.push_back(at.back() + (line[i] - line[i - 1]).norm());
        for (double& a : at) a /= at.back();
        return at;
    };
    const std::vector<double> of_first = shares(first), of_last = shares(last);
    std::vector<double> all = of_first;
    all.insert(all.end(), of_last.begin(), of_last.end());
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    const auto point_at = [](const std::vector<Vector3d>& line, const std::vector<double>& at, double share) {
        std::size_t i = 0;
        while (i + 2 < at.size() && at[i + 1] < share) ++i;
        const double part = std::clamp((share - at[i]) / (at[i + 1] - at[i]), 0.0, 1.0);
        return Vector3d(part == 1 ? line[i + 1] : line[i] + part * (line[i + 1] - line[i]));
    };
    std::vector<Vector3d> from, to;
    for (const double share : all) {
        from.push_back(point_at(first, of_first, share));
        to.push_back(point_at(last, of_last, share));
    }
    const Vector3d way = (to.front() + to.back() - from.front() - from.back()) / 2;
    const int steps = std::max(1, static_cast<int>(std::ceil(way.norm() / step)));
    Ribbon ribbon;
    for (int j = 0; j <= steps; ++j) {
        std::vector<Vector3d> row;
        for (std::size_t k = 0; k < from.size(); ++k)
            row.push_back(j == 0       ? from[k]
                          : j == steps ? to[k]
                                       : Vector3d(from[k] + double(j) / steps * (to[k] - from[k]) + step * aside));
        ribbon.rows.push_back(std::move(row));
        ribbon.along.push_back(way.normalized());
    }
    return ribbon;
}

std::vector<EdgeCrossing> ribbon_crossings(const TetDomain& domain, const Ribbon& ribbon) {
    std::vector<Kernel::Triangle_3> triangles;
    std::vector<std::size_t> row_of;
    for (std::size_t j = 0; j + 1 < ribbon.rows.size(); ++j)
        for (std::size_t k = 0; k + 1 < ribbon.rows[j].size(); ++k) {
            const auto &a = ribbon.rows[j][k], &b = ribbon.rows[j][k + 1], &c = ribbon.rows[j + 1][k],
                       &d = ribbon.rows[j + 1][k + 1];
            triangles.emplace_back(point(a), point(b), point(c));
            triangles.emplace_back(point(b), point(d), point(c));
            row_of.insert(row_of.end(), 2, j);
        }
    Tree tree(triangles.cbegin(), triangles.cend());
    const TetMesh& mesh = domain.mesh();
    std::set<std::pair<Index, Index>> edges;
    const CGAL::Bbox_3 box = tree.bbox();
    for (const auto tet : mesh.tets.rowwise()) {
        CGAL::Bbox_3 own;
        for (const Index v : tet) own += point(mesh.vertices.row(v)).bbox();
        if (!CGAL::do_overlap(own, box) || !tree.do_intersect(own)) continue;
        for (int k = 0; k < 4; ++k)
            for (int l = 0; l < k; ++l) edges.insert(std::minmax(tet[k], tet[l]));
    }
    std::vector<EdgeCrossing> found;
    std::vector<Tree::Primitive_id> hit;
    for (const auto& [from, to] : edges) {
        const Kernel::Segment_3 edge(point(mesh.vertices.row(from)), point(mesh.vertices.row(to)));
        hit.clear();
        tree.all_intersected_primitives(edge, std::back_inserter(hit));
        EdgeCrossing crossing{from, to, 0, Vector3d::Zero()};
        for (const auto& id : hit) {
            const CGAL::Sign ahead = CGAL::orientation((*id)[0], (*id)[1], (*id)[2], edge.target());
            crossing.times += ahead == CGAL::POSITIVE ? 1 : -1;
            crossing.along = ribbon.along[row_of[id - triangles.cbegin()]];
        }
        if (crossing.times != 0) found.push_back(crossing);
    }
    return found;
}

}  // namespace octafield::volume::detail
