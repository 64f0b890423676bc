// What the widths of a surface ask of lengths: walls, gaps, strips between feature curves, the curves themselves.
#include <CGAL/Segment_3.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <queue>
#include <set>

#include "background.hpp"

namespace octafield::surface {
namespace {

constexpr double kPerWidth = 2;        // an edge may be so many times as long as a wall or a strip is wide
constexpr double kNarrow = 4;          // for the sake of widths alone edges become no shorter than longest / kNarrow
constexpr Index kMostRays = 60000;     // triangles looked from
constexpr double kFacing = 0.8660254;  // two faces within 30 degrees of parallel are a wall
constexpr double kRound = 6;       // times as far round a corner or bend, of two curves, is no strip: over 19 degrees
constexpr double kSagShare = 0.5;  // of a wall's width that the arc over an edge may take

using Flat = CGAL::Simple_cartesian<double>;
using FlatTriangles = std::vector<Flat::Triangle_3>;
using RayTree =
    CGAL::AABB_tree<CGAL::AABB_traits<Flat, CGAL::AABB_triangle_primitive<Flat, FlatTriangles::const_iterator>>>;

Flat::Point_3 flat(const Eigen::Vector3d& p) { return {p[0], p[1], p[2]}; }

FlatTriangles flat_triangles(const TriangleMesh& mesh) {
    FlatTriangles triangles;
    triangles.reserve(mesh.triangles.rows());
    for (const auto t : mesh.triangles.rowwise())
        triangles.emplace_back(flat(mesh.vertices.row(t[0])), flat(mesh.vertices.row(t[1])),
                               flat(mesh.vertices.row(t[2])));
    return triangles;
}

// All, or so many that lie evenly over the area.
std::vector<Index> lookouts(const Eigen::VectorXd& areas) {
    std::vector<Index> chosen;
    const double step = areas.size() > kMostRays ? areas.sum() / kMostRays : 0;
    double passed = 0;
    for (Index t = 0; t < areas.size(); ++t) {
        passed += areas[t];
        if (passed < step) continue;
        passed = step > 0 ? std::fmod(passed, step) : 0;
        chosen.push_back(t);
    }
    return chosen;
}

double squared_distance(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    const Eigen::Vector3d along = b - a;
    const double square = along.squaredNorm();
    const double at = square > 0 ? std::clamp((p - a).dot(along) / square, 0., 1.) : 0;
    return (p - a - at * along).squaredNorm();
}

// Of edges at a wall or strip of this width. Those that ask for less than `least` stay flat between edges of any
// length.
double fitting(const Background& ground, double width, double least) {
    return kPerWidth * width < least ? ground.longest : std::max(kPerWidth * width, ground.shortest);
}

bool meet(const std::set<Index>& a, const std::set<Index>& b) {
    return std::ranges::any_of(a, [&](Index v) { return b.contains(v); });
}

// Whether one comes from a to b along feature curves within this length.
bool reached(const Background& ground, const Curves& curves, Index a, Index b, double length) {
    using Entry = std::pair<double, Index>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> nearest;
    std::set<Index> seen;
    nearest.emplace(0, a);
    while (!nearest.empty()) {
        const auto [way, v] = nearest.top();
        nearest.pop();
        if (v == b) return true;
        if (!seen.insert(v).second) continue;
        for (const Index e : curves.edges[v]) {
            const auto ends = ground.features.edges.row(e);
            const Index w = ends[0] == v ? ends[1] : ends[0];
            const double next = way + (ground.mesh.vertices.row(v) - ground.mesh.vertices.row(w)).norm();
            if (next <= length) nearest.emplace(next, w);
        }
    }
    return false;
}

}  // namespace

Curves curves_of(const Background& ground) {
    const Edges& edges = ground.features.edges;
    Curves curves;
    curves.edges.resize(ground.mesh.vertices.rows());
    curves.is_corner.assign(ground.mesh.vertices.rows(), false);
    for (const Index v : ground.features.corners) curves.is_corner[v] = true;
    for (Index e = 0; e < edges.rows(); ++e)
        for (const Index v : edges.row(e)) curves.edges[v].push_back(e);
    curves.of_edge.assign(edges.rows(), -1);
    for (Index seed = 0; seed < edges.rows(); ++seed) {
        if (curves.of_edge[seed] >= 0) continue;
        const Index curve = static_cast<Index>(curves.length.size());
        curves.length.push_back(0);
        curves.corners.emplace_back();
        std::vector<Index> stack{seed};
        curves.of_edge[seed] = curve;
        while (!stack.empty()) {
            const Index e = stack.back();
            stack.pop_back();
            curves.length[curve] +=
                (ground.mesh.vertices.row(edges(e, 0)) - ground.mesh.vertices.row(edges(e, 1))).norm();
            for (const Index v : edges.row(e)) {
                if (curves.is_corner[v]) {
                    curves.corners[curve].insert(v);
                    continue;
                }
                for (const Index next : curves.edges[v])
                    if (curves.of_edge[next] < 0) {
                        curves.of_edge[next] = curve;
                        stack.push_back(next);
                    }
            }
        }
    }
    return curves;
}

double least_length(const Background& ground) { return ground.longest / kNarrow; }

void bound_by_curves(Background& ground, double angle, double least) {
    const Curves curves = curves_of(ground);
    const Edges& edges = ground.features.edges;
    const auto lower = [&](Index v, double length) {
        ground.length[v] = std::min(ground.length[v], std::max(ground.shortest, length));
    };
    for (Index v = 0; v < ground.mesh.vertices.rows(); ++v) {
        if (curves.is_corner[v]) {
            for (const Index e : curves.edges[v]) lower(v, fitting(ground, curves.length[curves.of_edge[e]], least));
            continue;
        }
        if (curves.edges[v].size() != 2) continue;
        const auto arm = [&](int k) -> Eigen::Vector3d {
            const auto ends = edges.row(curves.edges[v][k]);
            return ground.mesh.vertices.row(ends[0] == v ? ends[1] : ends[0]) - ground.mesh.vertices.row(v);
        };
        const Eigen::Vector3d a = arm(0), b = -arm(1);
        const double turn = std::atan2(a.cross(b).norm(), a.dot(b));
        if (turn > 0) lower(v, angle / turn * (a.norm() + b.norm()) / 2);
    }
}

void bound_by_widths(Background& ground) {
    const TriangleMesh& mesh = ground.mesh;
    const FlatTriangles triangles = flat_triangles(mesh);
    const RayTree tree(triangles.begin(), triangles.end());
    const Points normals = triangle_normals(mesh);
    const double start = 1e-6 * shape_size(mesh);
    for (const Index t : lookouts(triangle_areas(mesh))) {
        const Eigen::Vector3d normal = normals.row(t);
        if (normal.isZero(0)) continue;
        Eigen::Vector3d centre = Eigen::Vector3d::Zero();
        for (const Index v : mesh.triangles.row(t)) centre += mesh.vertices.row(v) / 3;
        for (const double side : {-1., 1.}) {
            const Eigen::Vector3d way = side * normal, from = centre + start * way;
            const auto hit = tree.first_intersection(
                Flat::Ray_3(flat(from), Flat::Vector_3(way[0], way[1], way[2])),
                [&](FlatTriangles::const_iterator other) { return other - triangles.begin() == t; });
            const auto* point = hit ? boost::get<Flat::Point_3>(&hit->first) : nullptr;
            if (!point) continue;
            const double width = (Eigen::Vector3d(point->x(), point->y(), point->z()) - centre).norm();
            if (side < 0) ground.depth[t] = width;
            const Index other = static_cast<Index>(hit->second - triangles.begin());
            if (-normals.row(other).dot(normal) < kFacing) continue;
            const double bend = std::max(ground.bend[t], ground.bend[other]);
            const double most =
                std::min(fitting(ground, width, least_length(ground)), std::sqrt(8 * kSagShare * width / bend));
            for (const Index v : mesh.triangles.row(t))
                ground.length[v] = std::min(ground.length[v], std::max(ground.shortest, most));
        }
    }
}

void bound_by_strips(Background& ground, double least) {
    const Curves curves = curves_of(ground);
    const Edges& edges = ground.features.edges;
    const auto point = [&](Index v) -> Eigen::Vector3d { return ground.mesh.vertices.row(v); };
    std::vector<std::vector<Index>> round(ground.mesh.vertices.rows());
    for (const auto t : ground.mesh.triangles.rowwise())
        for (int k = 0; k < 3; ++k) round[t[k]].push_back(t[(k + 1) % 3]), round[t[(k + 1) % 3]].push_back(t[k]);
    const auto distance = [&](Index v, Index e) {
        return std::sqrt(squared_distance(point(v), point(edges(e, 0)), point(edges(e, 1))));
    };
    std::vector<Index> nearest(ground.mesh.vertices.rows(), -1);  // feature edge
    struct Entry {
        double distance;
        Index vertex, edge;
        bool operator>(const Entry& other) const { return distance > other.distance; }
    };
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> fronts;
    for (Index v = 0; v < ground.mesh.vertices.rows(); ++v)
        if (!curves.is_corner[v] && !curves.edges[v].empty()) fronts.push({0, v, curves.edges[v].front()});
    while (!fronts.empty()) {
        const Entry now = fronts.top();
        fronts.pop();
        if (nearest[now.vertex] >= 0) continue;
        nearest[now.vertex] = now.edge;
        for (const Index w : round[now.vertex]) {
            if (curves.is_corner[w]) continue;
            if (nearest[w] < 0) {
                if (const double far = distance(w, now.edge); far < ground.longest / kPerWidth)
                    fronts.push({far, w, now.edge});
                continue;
            }
            const Index one = curves.of_edge[now.edge], two = curves.of_edge[nearest[w]];
            if (one == two || meet(curves.corners[one], curves.corners[two])) continue;
            const auto segment = [&](Index e) {
                return Flat::Segment_3(flat(point(edges(e, 0))), flat(point(edges(e, 1))));
            };
            const double width = std::sqrt(CGAL::squared_distance(segment(now.edge), segment(nearest[w])));
            const double most = fitting(ground, width, least);
            for (const Index e : {now.edge, nearest[w]})
                for (const Index v : edges.row(e)) ground.length[v] = std::min(ground.length[v], most);
        }
    }
}

void bound_by_near_features(Background& ground) {
    const Curves curves = curves_of(ground);
    const auto point = [&](Index v) -> Eigen::Vector3d { return ground.mesh.vertices.row(v); };
    const auto lower = [&](Index v, double width) {
        ground.length[v] = std::min(ground.length[v], std::max(ground.shortest, kPerWidth * width));
    };
    const auto joined = [&](Index a, Index b) {
        return std::ranges::any_of(curves.edges[a], [&](Index e) {
            return ground.features.edges(e, 0) == b || ground.features.edges(e, 1) == b;
        });
    };
    const auto on_feature = [&](Index v) { return !curves.edges[v].empty(); };
    for (const auto t : ground.mesh.triangles.rowwise())
        for (int k = 0; k < 3; ++k) {
            const Index a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3];
            if (!on_feature(a) || !on_feature(b)) continue;
            if (!joined(a, b)) {
                if (joined(a, c) && joined(b, c)) continue;  // beside a bend or a corner
                const double width = (point(a) - point(b)).norm();
                if (reached(ground, curves, a, b, kRound * width)) continue;
                for (const Index v : {a, b}) lower(v, width);
            } else if (on_feature(c) && !joined(a, c) && !joined(b, c)) {
                const double width = std::sqrt(squared_distance(point(c), point(a), point(b)));
                if (reached(ground, curves, a, c, kRound * width)) continue;
                for (const Index v : {a, b, c}) lower(v, width);
            }
        }
}

}  // namespace octafield::surface
