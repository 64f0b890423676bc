#include "near_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <unordered_map>

#include "half_edges.hpp"

namespace octafield::surface {
namespace {

std::vector<HalfEdge> open_edges(const Triangles& triangles) {
    std::vector<HalfEdge> open;
    for_each_edge(sorted_half_edges(triangles), [&](auto first, auto last) {
        if (last - first == 1) open.push_back(*first);
    });
    return open;
}

std::vector<Index> ends_of(const std::vector<HalfEdge>& edges) {
    std::vector<Index> ends;
    for (const HalfEdge& edge : edges) ends.insert(ends.end(), {edge.low, edge.high});
    std::ranges::sort(ends);
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    return ends;
}

std::size_t crowded_edges(const Triangles& triangles) {
    std::size_t count = 0;
    for_each_edge(sorted_half_edges(triangles), [&](auto first, auto last) { count += last - first > 2; });
    return count;
}

using Cell = std::array<std::int64_t, 3>;

struct CellHash {
    std::size_t operator()(const Cell& cell) const {
        std::uint64_t hash = 0;
        for (const std::int64_t word : cell) hash = (hash ^ static_cast<std::uint64_t>(word)) * 0x9e3779b97f4a7c15;
        return hash ^ (hash >> 32);
    }
};

// Groups of points of a diameter of at most the tolerance, in the order of their first points.
class Groups {
public:
    Groups(const Points& points, double tolerance) : points_(points), tolerance_(tolerance) {}

    // The first point of the group that takes it; itself where none does.
    Index add(Index point) {
        const Cell home = cell_of(point);
        std::vector<Index>* best = nullptr;
        double nearest = tolerance_;
        for (int step = 0; step < 27; ++step) {
            const auto found = at_.find({home[0] + step % 3 - 1, home[1] + step / 3 % 3 - 1, home[2] + step / 9 - 1});
            if (found == at_.end()) continue;
            for (std::vector<Index>& group : found->second) {
                const double distance = between(group.front(), point);
                const auto fits = [&](Index other) { return between(other, point) <= tolerance_; };
                if (distance > nearest || !std::ranges::all_of(group, fits)) continue;
                best = &group;
                nearest = distance;
            }
        }
        if (best) {
            best->push_back(point);
            return best->front();
        }
        at_[home].push_back({point});
        return point;
    }

private:
    double between(Index a, Index b) const { return (points_.row(a) - points_.row(b)).norm(); }
    Cell cell_of(Index point) const {
        Cell cell;
        for (int k = 0; k < 3; ++k) cell[k] = static_cast<std::int64_t>(std::floor(points_(point, k) / tolerance_));
        return cell;
    }

    const Points& points_;
    double tolerance_;
    std::unordered_map<Cell, std::vector<std::vector<Index>>, CellHash> at_;
};

// Without the triangles that use a vertex twice and without the vertices marked.
TriangleMesh without(const TriangleMesh& mesh, const Triangles& triangles, const std::vector<bool>& gone) {
    TriangleMesh result{mesh.vertices, triangles};
    std::vector<Index> new_id(gone.size());
    Index kept = 0;
    for (std::size_t v = 0; v < gone.size(); ++v) {
        if (gone[v]) continue;
        result.vertices.row(kept) = mesh.vertices.row(static_cast<Index>(v));
        new_id[v] = kept++;
    }
    result.vertices.conservativeResize(kept, 3);
    kept = 0;
    for (Index t = 0; t < triangles.rows(); ++t) {
        if (repeats_vertex(triangles, t)) continue;
        for (int k = 0; k < 3; ++k) result.triangles(kept, k) = new_id[triangles(t, k)];
        ++kept;
    }
    result.triangles.conservativeResize(kept, 3);
    return result;
}

using EdgeKey = std::pair<Index, Index>;

// The vertices of open edges along the inside of others, by the axis that leaves the fewest to look at.
class PointsAlong {
public:
    PointsAlong(const Points& points, std::vector<Index> candidates) : points_(points) {
        for (int axis = 0; axis < 3; ++axis) {
            sorted_[axis] = candidates;
            std::ranges::sort(sorted_[axis], {}, [&](Index v) { return points(v, axis); });
        }
    }

    // With their place between 0 (at a) and 1 (at b), ascending; nearer than the tolerance, farther from both ends.
    std::vector<std::pair<double, Index>> within(Index a, Index b, double tolerance) const {
        auto [first, last] = range(a, b, 0, tolerance);
        for (int axis = 1; axis < 3; ++axis)
            if (const auto other = range(a, b, axis, tolerance); other.second - other.first < last - first)
                std::tie(first, last) = other;
        std::vector<std::pair<double, Index>> found;
        const Eigen::RowVector3d start = points_.row(a), along = points_.row(b) - points_.row(a);
        const double length = along.norm();
        for (auto v = first; v != last; ++v) {
            const Eigen::RowVector3d to = points_.row(*v) - start;
            const double place = to.dot(along) / (length * length);
            if (*v == a || *v == b || !(place * length > tolerance) || !((1 - place) * length > tolerance)) continue;
            if ((to - place * along).norm() <= tolerance) found.emplace_back(place, *v);
        }
        std::ranges::sort(found);
        return found;
    }

private:
    using Iterator = std::vector<Index>::const_iterator;
    std::pair<Iterator, Iterator> range(Index a, Index b, int axis, double tolerance) const {
        const auto [low, high] = std::minmax(points_(a, axis), points_(b, axis));
        const auto coordinate = [&, axis](Index v) { return points_(v, axis); };
        return {std::ranges::lower_bound(sorted_[axis], low - tolerance, {}, coordinate),
                std::ranges::upper_bound(sorted_[axis], high + tolerance, {}, coordinate)};
    }

    const Points& points_;
    std::array<std::vector<Index>, 3> sorted_;
};

// One open edge of each triangle at most. Number of triangles split.
std::size_t split_once(TriangleMesh& mesh, double tolerance) {
    const std::vector<HalfEdge> open = open_edges(mesh.triangles);
    std::set<EdgeKey> keys;
    for (const HalfEdge& edge : open) keys.insert({edge.low, edge.high});
    const PointsAlong along(mesh.vertices, ends_of(open));
    std::vector<std::array<Index, 3>> added;
    std::vector<bool> done(mesh.triangles.rows(), false);
    std::size_t split = 0;
    for (const HalfEdge& edge : open) {
        if (done[edge.triangle]) continue;
        const auto corner = [&](int k) { return mesh.triangles(edge.triangle, (edge.corner + k) % 3); };
        const Index a = corner(0), b = corner(1), c = corner(2);
        std::vector<Index> chain = {a};
        for (const auto& [place, v] : along.within(a, b, tolerance)) chain.push_back(v);
        chain.push_back(b);
        bool closes = false;
        for (std::size_t i = 1; i < chain.size(); ++i)
            closes = closes || (chain.size() > 2 && keys.contains(std::minmax(chain[i - 1], chain[i])));
        if (!closes || std::ranges::find(chain, c) != chain.end()) continue;
        mesh.triangles.row(edge.triangle) << chain[0], chain[1], c;
        for (std::size_t i = 2; i < chain.size(); ++i) added.push_back({chain[i - 1], chain[i], c});
        done[edge.triangle] = true;
        ++split;
    }
    Index next = static_cast<Index>(mesh.triangles.rows());
    mesh.triangles.conservativeResize(next + static_cast<Eigen::Index>(added.size()), 3);
    for (const auto& [a, b, c] : added) mesh.triangles.row(next++) << a, b, c;
    return split;
}

}  // namespace

NearMerge merge_near_points(TriangleMesh& mesh, double tolerance) {
    NearMerge done;
    const std::vector<Index> candidates = ends_of(open_edges(mesh.triangles));
    if (candidates.empty() || !(tolerance > 0)) return done;
    std::vector<Index> into(mesh.vertices.rows());
    for (std::size_t v = 0; v < into.size(); ++v) into[v] = static_cast<Index>(v);
    std::vector<bool> gone(into.size(), false);
    Groups groups(mesh.vertices, tolerance);
    for (const Index v : candidates) {
        into[v] = groups.add(v);
        if (into[v] == v) continue;
        gone[v] = true;
        ++done.points;
        done.largest_move = std::max(done.largest_move, (mesh.vertices.row(v) - mesh.vertices.row(into[v])).norm());
    }
    if (done.points == 0) return done;
    const Triangles triangles = mesh.triangles.unaryExpr([&](Index v) { return into[v]; });
    TriangleMesh merged = without(mesh, triangles, gone);
    if (crowded_edges(merged.triangles) > crowded_edges(mesh.triangles)) return {};
    done.triangles = static_cast<std::size_t>(mesh.triangles.rows() - merged.triangles.rows());
    mesh = std::move(merged);
    return done;
}

std::size_t split_open_edges(TriangleMesh& mesh, double tolerance) {
    const TriangleMesh before = mesh;
    const std::size_t open = open_edges(mesh.triangles).size();
    if (open == 0) return 0;
    std::size_t split = 0;
    for (std::size_t once = split_once(mesh, tolerance); once > 0; once = split_once(mesh, tolerance)) split += once;
    if (split > 0 && open_edges(mesh.triangles).size() < open &&
        crowded_edges(mesh.triangles) <= crowded_edges(before.triangles))
        return split;
    mesh = before;
    return 0;
}

}  // namespace octafield::surface
