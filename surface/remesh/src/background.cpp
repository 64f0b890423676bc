#include "background.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>

#include "octafield/error.hpp"
#include "octafield/surface/principal_directions.hpp"
#include "working_surface.hpp"

namespace octafield::surface {
namespace {

constexpr double kTetsPerCube = 12.5;     // in a cube of one edge length, measured
constexpr double kTetsPerTriangle = 1.5;  // at least: in walls without vertices inside, measured
constexpr double kGrowthInside = 0.3;     // of lengths, per depth: TetGen's bound on shapes, measured

Eigen::VectorXd largest_curvatures(const TriangleMesh& mesh, const FeatureGraph& features) {
    try {
        return principal_directions({mesh, features}).curvatures.col(0).cwiseAbs();
    } catch (const GeometryError&) {  // a triangle too flat for it
        return Eigen::VectorXd::Zero(mesh.triangles.rows());
    }
}

}  // namespace

Background background_of(const TriangleMesh& mesh, const FeatureGraph& features, const Eigen::VectorXd& lengths,
                         double longest, double shortest) {
    Working work(mesh, features);
    const Eigen::VectorXd bend = largest_curvatures(mesh, features);
    for (const Vertex v : work.marked.mesh.vertices()) work.length[v] = lengths[static_cast<Index>(v)];
    for (const Face f : work.marked.mesh.faces()) work.bend[f] = bend[static_cast<Index>(f)];
    split_long(work, 1, [&](Edge e) { return std::optional(split(work, e)); });

    Background ground;
    const SurfaceMesh& fine = work.marked.mesh;
    ground.mesh.vertices.resize(fine.number_of_vertices(), 3);
    ground.mesh.triangles.resize(fine.number_of_faces(), 3);
    ground.patch.resize(fine.number_of_faces());
    ground.bend.resize(fine.number_of_faces());
    ground.length.resize(fine.number_of_vertices());
    for (const Vertex v : fine.vertices()) {
        ground.mesh.vertices.row(static_cast<Index>(v)) = work.at(v);
        ground.length[static_cast<Index>(v)] = work.length[v];
    }
    for (const Face f : fine.faces()) {
        int k = 0;
        for (const Vertex v : CGAL::vertices_around_face(fine.halfedge(f), fine))
            ground.mesh.triangles(static_cast<Index>(f), k++) = static_cast<Index>(v);
        ground.patch[static_cast<Index>(f)] = work.marked.patch[f];
        ground.bend[static_cast<Index>(f)] = work.bend[f];
    }
    std::vector<std::pair<Index, Index>> edges;
    for (const Edge e : fine.edges())
        if (work.marked.feature[e])
            edges.push_back(std::minmax(static_cast<Index>(fine.vertex(e, 0)), static_cast<Index>(fine.vertex(e, 1))));
    std::ranges::sort(edges);
    ground.features.edges.resize(static_cast<Eigen::Index>(edges.size()), 2);
    for (std::size_t i = 0; i < edges.size(); ++i)
        ground.features.edges.row(static_cast<Index>(i)) << edges[i].first, edges[i].second;
    ground.features.corners = features.corners;
    ground.patches = work.marked.patches;
    ground.depth = Eigen::VectorXd::Zero(ground.mesh.triangles.rows());
    ground.longest = longest;
    ground.shortest = shortest;
    return ground;
}

void bound_by_curvature(Background& ground, double angle) {
    for (Index t = 0; t < ground.mesh.triangles.rows(); ++t)
        for (const Index v : ground.mesh.triangles.row(t))
            ground.length[v] = std::min(ground.length[v], std::max(ground.shortest, angle / ground.bend[t]));
}

void limit_growth(Background& ground, double growth) {
    std::vector<std::vector<Index>> round(ground.mesh.vertices.rows());
    for (Index t = 0; t < ground.mesh.triangles.rows(); ++t)
        for (int k = 0; k < 3; ++k) {
            const Index a = ground.mesh.triangles(t, k), b = ground.mesh.triangles(t, (k + 1) % 3);
            round[a].push_back(b);
            round[b].push_back(a);
        }
    using Entry = std::pair<double, Index>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> shortest;
    for (Index v = 0; v < ground.length.size(); ++v) shortest.emplace(ground.length[v], v);
    while (!shortest.empty()) {
        const auto [length, v] = shortest.top();
        shortest.pop();
        if (length > ground.length[v]) continue;
        for (const Index w : round[v]) {
            const double next = length + growth * (ground.mesh.vertices.row(v) - ground.mesh.vertices.row(w)).norm();
            if (next >= ground.length[w]) continue;
            ground.length[w] = next;
            shortest.emplace(next, w);
        }
    }
}

bool lower(Background& ground, const Places& places) {
    std::vector<std::vector<Index>> round(ground.mesh.vertices.rows());
    for (const auto t : ground.mesh.triangles.rowwise())
        for (int k = 0; k < 3; ++k) round[t[k]].push_back(t[(k + 1) % 3]), round[t[(k + 1) % 3]].push_back(t[k]);
    struct Entry {
        double reach;  // how much farther it goes
        Index vertex;
        double length;
        bool operator<(const Entry& other) const { return reach < other.reach; }
    };
    std::priority_queue<Entry> farthest;
    for (const auto& [v, factor] : places)
        farthest.push({ground.length[v], v, std::max(ground.shortest, factor * ground.length[v])});
    std::vector<double> reached(ground.mesh.vertices.rows(), -1);
    bool lowered = false;
    while (!farthest.empty()) {
        const Entry now = farthest.top();
        farthest.pop();
        if (reached[now.vertex] >= 0 && now.length >= ground.length[now.vertex]) continue;
        reached[now.vertex] = std::max(reached[now.vertex], now.reach);
        if (now.length < ground.length[now.vertex]) {
            lowered = lowered || now.length < 0.99 * ground.length[now.vertex];
            ground.length[now.vertex] = now.length;
        }
        for (const Index w : round[now.vertex]) {
            const double reach =
                now.reach - (ground.mesh.vertices.row(now.vertex) - ground.mesh.vertices.row(w)).norm();
            if (reach > reached[w] || (reach > 0 && now.length < ground.length[w]))
                if (reach > 0) farthest.push({reach, w, now.length});
        }
    }
    if (lowered) limit_growth(ground, SizeFieldOptions{}.growth);
    return lowered;
}

Cells expected_cells(const Background& ground, double volume, double scale) {
    const Eigen::VectorXd areas = triangle_areas(ground.mesh);
    const double longest = scale * ground.longest, core = 1 / std::pow(longest, 3);
    double triangles = 0, inside = 0, seen = 0;
    for (Index t = 0; t < ground.mesh.triangles.rows(); ++t) {
        double length = 0;
        for (const Index v : ground.mesh.triangles.row(t)) length += scale * ground.length[v] / 3;
        triangles += areas[t] / (std::numbers::sqrt3 / 4 * length * length);
        const double half = ground.depth[t] / 2;
        if (half == 0) continue;
        const double layer = std::min(half, (longest - length) / kGrowthInside);  // lengths grow so far
        const double end = length + kGrowthInside * layer;
        const double in_layer = (1 / (length * length) - 1 / (end * end)) / (2 * kGrowthInside);
        inside += areas[t] * (in_layer + (half - layer) * core);
        seen += areas[t] * half;
    }
    const double tets = kTetsPerCube * std::abs(volume) * (seen > 0 ? inside / seen : core);
    return {triangles, volume == 0 ? 0 : std::max(tets, kTetsPerTriangle * triangles)};
}

GroundTrees::GroundTrees(const Background& ground) : ground_(ground), triangles_(ground.patches), ids_(ground.patches) {
    for (Index t = 0; t < ground.mesh.triangles.rows(); ++t) {
        const auto p = [&](int k) {
            const auto row = ground.mesh.vertices.row(ground.mesh.triangles(t, k));
            return Flat::Point_3(row[0], row[1], row[2]);
        };
        triangles_[ground.patch[t]].emplace_back(p(0), p(1), p(2));
        ids_[ground.patch[t]].push_back(t);
    }
    for (const auto& triangles : triangles_) {
        trees_.push_back(std::make_unique<Tree>(triangles.begin(), triangles.end()));
        if (!triangles.empty()) trees_.back()->accelerate_distance_queries();
    }
}

GroundTrees::Nearest GroundTrees::nearest(int patch, const Eigen::Vector3d& point) const {
    const auto [at, primitive] = trees_[patch]->closest_point_and_primitive({point[0], point[1], point[2]});
    return {{at.x(), at.y(), at.z()}, ids_[patch][primitive - triangles_[patch].begin()]};
}

double length_at(const Background& ground, Index triangle, const Eigen::Vector3d& point) {
    const auto corner = [&](int k) -> Eigen::Vector3d {
        return ground.mesh.vertices.row(ground.mesh.triangles(triangle, k));
    };
    const Eigen::Vector3d a = corner(0), u = corner(1) - a, v = corner(2) - a, p = point - a;
    const Eigen::Vector3d normal = u.cross(v);
    const double square = normal.squaredNorm();
    const auto clamped = [&](double x) { return square > 0 ? std::clamp(x / square, 0., 1.) : 1. / 3; };
    const double second = clamped(p.cross(v).dot(normal)), third = clamped(u.cross(p).dot(normal));
    const double first = std::max(0., 1 - second - third), sum = first + second + third;
    const auto length = [&](int k) { return ground.length[ground.mesh.triangles(triangle, k)]; };
    return (first * length(0) + second * length(1) + third * length(2)) / sum;
}

}  // namespace octafield::surface
