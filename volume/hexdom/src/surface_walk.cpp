#include "surface_walk.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "octafield/disjoint_sets.hpp"
#include "tet_corners.hpp"

namespace octafield::volume {
namespace {

using frames::Vector3;

constexpr int most_triangles = 10000;
constexpr double on_edge = 1e-9;      // weights below count as 0, as in point_surface
constexpr double most_normal = 0.75;  // cosine between the normal and a direction that is followed

struct Side {
    Index a, b, number;  // a < b; 3 triangle + edge
    auto edge() const { return std::pair(a, b); }
};

std::vector<Side> sides_of(const Triangles& triangles) {
    std::vector<Side> sides;
    for (Index t = 0; t < triangles.rows(); ++t)
        for (int k = 0; k < 3; ++k) {
            const auto [a, b] = std::minmax({triangles(t, k), triangles(t, (k + 1) % 3)});
            sides.push_back({a, b, 3 * t + k});
        }
    std::sort(sides.begin(), sides.end(), [](const Side& x, const Side& y) {
        return x.edge() != y.edge() ? x.edge() < y.edge() : x.number < y.number;
    });
    return sides;
}

// visit(sides of one edge: first, count)
template <class Visit>
void for_each_edge(const std::vector<Side>& sides, const Visit& visit) {
    for (std::size_t i = 0, n; i < sides.size(); i += n) {
        n = 1;
        while (i + n < sides.size() && sides[i + n].edge() == sides[i].edge()) ++n;
        visit(&sides[i], n);
    }
}

}  // namespace

Edges surface_curves(const TetDomain& domain) {
    std::vector<std::pair<Index, Index>> edges;
    for (const auto e : domain.features().edges.rowwise()) edges.push_back(std::minmax({e[0], e[1]}));
    for_each_edge(sides_of(domain.surface().mesh.triangles), [&](const Side* side, std::size_t count) {
        if (count != 2) edges.push_back(side->edge());
    });
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    Edges result(static_cast<Eigen::Index>(edges.size()), 2);
    for (std::size_t i = 0; i < edges.size(); ++i)
        result.row(static_cast<Eigen::Index>(i)) << edges[i].first, edges[i].second;
    return result;
}

SurfaceWalker::SurfaceWalker(const TetDomain& domain, const Edges& curves)
    : domain_(domain),
      mesh_(domain.surface().mesh),
      normals_(surface::triangle_normals(mesh_)),
      ahead_(mesh_.triangles.size(), -1),
      first_(mesh_.vertices.rows() + 1, 0),
      triangles_at_(mesh_.triangles.size()),
      tet_corner_(mesh_.triangles.rows(), 3) {
    std::vector<std::pair<Index, Index>> held;
    for (const auto e : curves.rowwise()) held.emplace_back(e[0], e[1]);
    for_each_edge(sides_of(mesh_.triangles), [&](const Side* side, std::size_t count) {
        if (count != 2 || std::binary_search(held.begin(), held.end(), side->edge())) return;
        ahead_[side[0].number] = side[1].number;
        ahead_[side[1].number] = side[0].number;
    });
    for (const Index v : mesh_.triangles.reshaped()) ++first_[v + 1];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    std::vector<Index> next(first_.begin(), first_.end() - 1);
    for (Index t = 0; t < mesh_.triangles.rows(); ++t)
        for (int k = 0; k < 3; ++k) {
            const Index v = mesh_.triangles(t, k);
            triangles_at_[next[v]++] = t;
            tet_corner_(t, k) = static_cast<std::int8_t>(
                corner_of(domain.mesh(), domain.sides()(t, 0), domain.surface().vertex_map[v]));
        }
}

Vector3 SurfaceWalker::corner(Index triangle, int k) const {
    return mesh_.vertices.row(mesh_.triangles(triangle, k)).transpose();
}

Vector3 SurfaceWalker::change(Index triangle, const Vector3& direction) const {
    const Vector3 normal = normals_.row(triangle).transpose();
    const double area =
        (corner(triangle, 1) - corner(triangle, 0)).cross(corner(triangle, 2) - corner(triangle, 0)).norm();
    Vector3 result;
    for (int k = 0; k < 3; ++k)
        result[k] = normal.cross(corner(triangle, (k + 2) % 3) - corner(triangle, (k + 1) % 3)).dot(direction) / area;
    return result;
}

FrontPlace SurfaceWalker::place(Index triangle, const Vector3& weights) const {
    FrontPlace result;
    result.tet = domain_.sides()(triangle, 0);
    result.triangle = triangle;
    Vector3 rounded = weights;
    for (double& w : rounded)
        if (w < on_edge) w = 0;
    rounded /= rounded.sum();
    for (int k = 0; k < 3; ++k) result.weights[tet_corner_(triangle, k)] = rounded[k];
    return result;
}

FrontPlace SurfaceWalker::at_vertex(Index vertex) const {
    const Index triangle = triangles_at_[first_[vertex]];
    Vector3 weights = Vector3::Zero();
    for (int k = 0; k < 3; ++k)
        if (mesh_.triangles(triangle, k) == vertex) weights[k] = 1;
    return place(triangle, weights);
}

std::vector<Index> SurfaceWalker::parts() const {
    DisjointSets sets(mesh_.triangles.rows());
    for (std::size_t side = 0; side < ahead_.size(); ++side)
        if (ahead_[side] >= 0) sets.join(static_cast<Index>(side / 3), ahead_[side] / 3);
    Index count;
    return std::move(sets).numbers(count);
}

std::vector<Index> SurfaceWalker::round(const FrontPlace& place) const {
    std::vector<Index> corners, found;
    for (int k = 0; k < 3; ++k)
        if (place.weights[tet_corner_(place.triangle, k)] > 0) corners.push_back(mesh_.triangles(place.triangle, k));
    if (corners.size() == 3) return {place.triangle};
    for (Index i = first_[corners[0]]; i < first_[corners[0] + 1]; ++i) {
        const auto row = mesh_.triangles.row(triangles_at_[i]);
        if (corners.size() == 1 || std::find(row.begin(), row.end(), corners[1]) != row.end())
            found.push_back(triangles_at_[i]);
    }
    return found;
}

// Where several triangles have the place, the one that the direction stays in best.
SurfaceWalker::Start SurfaceWalker::start(const FrontPlace& from, const Vector3& way) const {
    Start best;
    double most = -0.3;
    for (const Index t : round(from)) {
        const Vector3 normal = normals_.row(t).transpose();
        if (std::abs(normal.dot(way)) > most_normal * way.norm()) continue;
        Start here{t, Vector3::Zero(), (way - normal.dot(way) * normal).normalized()};
        for (int k = 0; k < 3; ++k)
            for (int i = 0; i < 3; ++i)
                if (mesh_.triangles(t, k) == mesh_.triangles(from.triangle, i))
                    here.weights[k] = from.weights[tet_corner_(from.triangle, i)];
        const Vector3 rate = change(t, here.direction);
        double least = 1;
        for (int k = 0; k < 3; ++k)
            if (here.weights[k] == 0) least = std::min(least, rate[k] / rate.cwiseAbs().maxCoeff());
        if (least > most) most = least, best = here;
    }
    return best;
}

Vector3 SurfaceWalker::across(Index from, int edge, Index to, int other, const Vector3& direction) const {
    const Vector3 a = corner(from, edge), along = (corner(from, (edge + 1) % 3) - a).normalized();
    const Vector3 out = along.cross(normals_.row(from).transpose());
    Vector3 in = corner(to, (other + 2) % 3) - a;
    in = (in - in.dot(along) * along).normalized();
    return direction.dot(along) * along + std::max(direction.dot(out), 0.0) * in;
}

FrontStep SurfaceWalker::along(const FrontPlace& from, const Vector3& way) const {
    auto [triangle, weights, direction] = start(from, way);
    FrontStep step{{}, way.normalized(), Vector3::Zero()};
    if (triangle < 0) return step;
    step.up = normals_.row(triangle).transpose();
    double left = way.norm();
    int entered = -1;  // the corner opposite the edge behind
    for (int count = 0; count < most_triangles; ++count) {
        const Vector3 rate = change(triangle, direction);
        int exit = -1;
        double first = left;
        for (int k = 0; k < 3; ++k) {
            if (k == entered || !(rate[k] < 0)) continue;
            const double length = std::max(weights[k], 0.0) / -rate[k];
            if (length < first) first = length, exit = k;
        }
        weights += first * rate;
        if (exit < 0) {
            step.place = place(triangle, weights);
            step.direction = direction;
            return step;
        }
        const int edge = (exit + 1) % 3;
        const Index next = ahead_[3 * triangle + edge];
        if (next < 0) return step;
        const int other = next % 3;
        Vector3 there = Vector3::Zero();
        for (int k = 0; k < 2; ++k)
            for (int i = 0; i < 2; ++i)
                if (mesh_.triangles(next / 3, (other + k) % 3) == mesh_.triangles(triangle, (edge + i) % 3))
                    there[(other + k) % 3] = std::max(weights[(edge + i) % 3], 0.0);
        direction = across(triangle, edge, next / 3, other, direction).normalized();
        weights = there / there.sum();
        left -= first;
        triangle = next / 3;
        entered = (other + 2) % 3;
    }
    return step;
}

bool SurfaceWalker::free(const FrontPlace& from, const Vector3& way) const {
    return start(from, way).triangle < 0 || along(from, way).place.tet >= 0;
}

Vector3 SurfaceWalker::corrected(const FrontStep& half, const Vector3& direction, const Vector3& axis) const {
    const Vector3 normal = normals_.row(half.place.triangle).transpose();
    const double angle =
        std::atan2(normal.dot(half.direction.cross(axis)), half.direction.dot(axis - normal.dot(axis) * normal));
    return Eigen::AngleAxisd(angle, half.up) * (direction - half.up.dot(direction) * half.up);
}

}  // namespace octafield::volume
