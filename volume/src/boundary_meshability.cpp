#include "octafield/volume/boundary_meshability.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "axis_numbers.hpp"
#include "boundary_star.hpp"
#include "octafield/error.hpp"
#include "octafield/parallel.hpp"
#include "require_frames.hpp"
#include "surface_wedges.hpp"

namespace octafield::volume {
namespace {

using frames::Vector3;
using EdgeKey = std::pair<Index, Index>;

constexpr double quarter = std::numbers::pi / 2;

// Of v about the axis from its part across the axis to that of w, in (-pi, pi].
double angle_about(const Vector3& axis, const Vector3& v, const Vector3& w) {
    const Vector3 unit = axis.normalized();
    return std::atan2(unit.dot(v.cross(w)), v.dot(w) - unit.dot(v) * unit.dot(w));
}

// Quarter turns about axis `about` from axis `from` to axis `to`, 0 to 3, or none where one lies along `about`.
std::optional<int> quarter_turns(int about, int from, int to) {
    if (from % 3 == about % 3 || to % 3 == about % 3) return std::nullopt;
    if (from == to) return 0;
    if (from == opposite_axis(to)) return 2;
    return axis_unit(about).dot(axis_unit(from).cross(axis_unit(to))) > 0 ? 1 : 3;
}

// Two axes of a frame carried from vertex to vertex, and how far the second has turned about a direction of space.
class Carried {
public:
    Carried(const VertexAxes& axes, Index at, int about, int across, const Vector3& direction)
        : about(about), across(across), axes_(axes), at_(at), direction_(direction) {}
    void to(Index next) {
        const int matching = frames::octahedral_inverse(axes_.matching(at_, next));
        const Vector3 before = axes_.direction(at_, across);
        about = turned_axis(matching, about);
        across = turned_axis(matching, across);
        turn += angle_about(direction_, before, axes_.direction(next, across));
        at_ = next;
    }
    int about, across;
    double turn = 0;

private:
    const VertexAxes& axes_;
    Index at_;
    const Vector3 direction_;
};

// The axis nearest to `direction` among those at right angles to axis `normal`.
int nearest_across(const VertexAxes& axes, Index v, const Vector3& direction, int normal) {
    Vector3 in_frame = axes.frame(v).conjugate() * direction;
    in_frame[normal % 3] = 0;
    return nearest_axis_number(in_frame);
}

// The whole number of quarter turns of this residue (mod 4) nearest to the measured one.
int nearest_of_residue(int residue, double measured) {
    return residue + 4 * static_cast<int>(std::lround((measured - residue) / 4));
}

class Counter {
public:
    Counter(const TetMesh& mesh, const Quaternions& frames) : mesh_(mesh), axes_(frames) {}

    double angle(const Wedge& wedge) const {
        double sum = 0;
        for (std::size_t i = 0; i + 1 < wedge.link.size(); ++i)
            sum += std::abs(
                angle_about(p(wedge.b) - p(wedge.a), p(wedge.link[i]) - p(wedge.a), p(wedge.link[i + 1]) - p(wedge.a)));
        return sum;
    }

    // Hexahedra in the wedge by the frame of v, one of its ends; carried through the link and back where asked.
    int hexahedra(const Wedge& wedge, Index v, double angle, bool round_the_link = false) const {
        const Vector3 edge = p(wedge.b) - p(wedge.a);
        const Vector3 first = (p(wedge.link.front()) - p(wedge.a)).cross(edge);  // normals out of the wedge
        const Vector3 last = edge.cross(p(wedge.link.back()) - p(wedge.a));
        const int normal = axes_.nearest(v, first);
        Carried carried(axes_, v, nearest_across(axes_, v, edge, normal), normal, edge);
        const int tangent = carried.about;
        if (round_the_link) {
            for (const Index l : wedge.link) carried.to(l);
            carried.to(v);
        }
        const auto turns = quarter_turns(carried.about, carried.across, axes_.nearest(v, last));
        if (carried.about != tangent || !turns) return no_number;
        // Normals are half a turn more than the wedge apart.
        return nearest_of_residue((*turns + 2) % 4, (angle - carried.turn) / quarter);
    }

    // Quadrilaterals in a sector of the surface round v: the fan of triangles (v, link[i], link[i + 1]),
    // counter-clockwise from outside.
    std::optional<int> quadrilaterals(Index v, const std::vector<Index>& link) const {
        const auto normal_of = [&](std::size_t i) -> Vector3 {
            return (p(link[i]) - p(v)).cross(p(link[i + 1]) - p(v)).normalized();
        };
        double angle = 0;
        Vector3 mean = Vector3::Zero();
        for (std::size_t i = 0; i + 1 < link.size(); ++i) {
            const double part = angle_about(normal_of(i), p(link[i]) - p(v), p(link[i + 1]) - p(v));
            angle += part;
            mean += part * normal_of(i);
        }
        const int normal = axes_.nearest(link.front(), normal_of(0));
        Carried carried(axes_, link.front(), normal,
                        nearest_across(axes_, link.front(), p(link.front()) - p(v), normal), mean);
        for (std::size_t i = 1; i < link.size(); ++i) carried.to(link[i]);
        const Index end = link.back();
        if (carried.about != axes_.nearest(end, normal_of(link.size() - 2))) return std::nullopt;
        const auto turns =
            quarter_turns(carried.about, carried.across, nearest_across(axes_, end, p(end) - p(v), carried.about));
        if (!turns) return std::nullopt;
        return nearest_of_residue(*turns, (angle - carried.turn) / quarter);
    }

    FeatureWedge judge(const Wedge& wedge) const {
        const double size = angle(wedge);
        FeatureWedge result{wedge.a,
                            wedge.b,
                            size,
                            hexahedra(wedge, wedge.a, size),
                            hexahedra(wedge, wedge.b, size),
                            hexahedra(wedge, wedge.a, size, true),
                            false};
        const auto fails = [](int number) { return number < 1 && number != no_number; };
        result.meshable = (result.hexahedra_a != no_number || result.hexahedra_b != no_number) &&
                          !fails(result.hexahedra_a) && !fails(result.hexahedra_b);
        return result;
    }

    // Hexahedra at the singular edge on the surface between v and w, where their normals are given; 2: there is none.
    int hexahedra(Index v, Index w, const Vector3& normal_v, const Vector3& normal_w) const {
        const int carried = axes_.carried(v, w, axes_.nearest(v, normal_v)), there = axes_.nearest(w, normal_w);
        if (carried == there) return 2;
        const Vector3 about = (normal_v + normal_w).cross(p(w) - p(v));  // normals turn forward about it where convex
        const Vector3 from = axes_.direction(w, carried), to = axes_.direction(w, there);
        const bool convex = angle_about(about, normal_v, normal_w) > 0;
        if (carried == opposite_axis(there)) return convex ? 0 : 4;
        return about.dot(from.cross(to)) > 0 ? 1 : 3;
    }

private:
    Vector3 p(Index v) const { return mesh_.vertices.row(v).transpose(); }

    const TetMesh& mesh_;
    const VertexAxes axes_;
};

// Feature edges, by tet-mesh ids.
std::vector<EdgeKey> feature_keys(const BoundarySurface& surface, const surface::FeatureGraph& features) {
    std::vector<EdgeKey> keys;
    for (const auto& edge : features.edges.rowwise())
        keys.push_back(std::minmax({surface.vertex_map[edge[0]], surface.vertex_map[edge[1]]}));
    std::sort(keys.begin(), keys.end());
    return keys;
}

// The triangles round v as a cycle of neighbours, counter-clockwise; empty where they form none.
std::vector<Index> ring(const BoundarySurface& surface, const BoundaryStars& stars, Index v) {
    std::map<Index, Index> next;
    for (const Index t : stars.triangles(v))
        for (int k = 0; k < 3; ++k)
            if (surface.mesh.triangles(t, k) == v)
                next[surface.mesh.triangles(t, (k + 1) % 3)] = surface.mesh.triangles(t, (k + 2) % 3);
    if (next.size() != stars.triangles(v).size()) return {};
    std::vector<Index> ids;
    for (Index w = next.begin()->first; ids.size() <= next.size();) {
        ids.push_back(w);
        const auto found = next.find(w);
        if (found == next.end()) return {};
        w = found->second;
        if (w == ids.front()) break;
    }
    if (ids.size() != next.size()) return {};
    return ids;
}

class CornerJudge {
public:
    CornerJudge(const BoundarySurface& surface, const Counter& counter, const std::vector<FeatureWedge>& wedges,
                std::vector<EdgeKey> keys, const std::vector<std::uint8_t>& corner)
        : surface_(surface), counter_(counter), keys_(std::move(keys)), corner_(corner) {
        for (const FeatureWedge& w : wedges) by_edge_.emplace(EdgeKey{w.a, w.b}, &w);
    }

    // b: boundary-mesh id; ring: its neighbours in order.
    std::optional<SurfaceCorner> judge(Index b, std::vector<Index> ring) const {
        const auto is_feature = [&](Index w) { return std::binary_search(keys_.begin(), keys_.end(), key(b, w)); };
        const auto first = std::find_if(ring.begin(), ring.end(), is_feature);
        if (first == ring.end()) return std::nullopt;
        for (const Index w : ring)
            if (by_edge_.count(key(b, w)) > 1) return std::nullopt;  // tets on both sides: an interface
        std::rotate(ring.begin(), first, ring.end());
        ring.push_back(ring.front());
        SurfaceCorner corner{surface_.vertex_map[b], 0, 0, 6, 0, 0, false};
        std::vector<Index> link{surface_.vertex_map[ring.front()]};
        for (std::size_t i = 1; i < ring.size(); ++i) {
            link.push_back(surface_.vertex_map[ring[i]]);
            if (!is_feature(ring[i])) continue;
            count_edge(b, ring[i], corner);
            const int quadrilaterals = counter_.quadrilaterals(corner.vertex, link).value_or(0);
            ++corner.sectors;
            corner.empty_sectors += quadrilaterals < 1;
            corner.inside -= quadrilaterals - 1;
            link = {link.back()};
        }
        corner.meshable = corner.inside >= 0 && corner.empty_sectors == 0 && corner.non_meshable_edges == 0;
        return corner;
    }

private:
    EdgeKey key(Index b, Index w) const { return std::minmax({surface_.vertex_map[b], surface_.vertex_map[w]}); }

    // Of the edge from b to w by the frame of its far end, which follows the edge also where none fits this corner.
    void count_edge(Index b, Index w, SurfaceCorner& corner) const {
        const FeatureWedge& wedge = *by_edge_.find(key(b, w))->second;
        int here = wedge.hexahedra_a, there = wedge.hexahedra_b;
        if (wedge.a != corner.vertex) std::swap(here, there);
        const bool take_far = there != no_number && (!corner_[w] || here == no_number);
        const int hexahedra = take_far ? there : here;
        ++corner.feature_edges;
        corner.non_meshable_edges += hexahedra < 1;
        corner.inside -= hexahedra == no_number ? 0 : 3 - hexahedra;
    }

    const BoundarySurface& surface_;
    const Counter& counter_;
    const std::vector<EdgeKey> keys_;
    const std::vector<std::uint8_t>& corner_;
    std::multimap<EdgeKey, const FeatureWedge*> by_edge_;
};

void require_fitting(const TetMesh& mesh, const BoundarySurface& surface, const surface::FeatureGraph& features) {
    const Eigen::Index count = surface.mesh.vertices.rows();
    if (static_cast<Eigen::Index>(surface.vertex_map.size()) != count)
        throw InvalidInput("vertex_map must have one entry per boundary vertex", "wrong_size");
    for (const Index v : surface.vertex_map)
        if (v < 0 || v >= mesh.vertices.rows())
            throw InvalidInput("vertex_map refers to vertex " + std::to_string(v) + " of a tet mesh with " +
                                   std::to_string(mesh.vertices.rows()),
                               "index_out_of_range", {v});
    for (const Index v : features.corners)
        if (v < 0 || v >= count)
            throw InvalidInput("corner " + std::to_string(v) + " is no vertex of the boundary mesh",
                               "index_out_of_range", {v});
}

// Edges of the surface that are no features, once each.
std::vector<SurfaceCrossing> find_crossings(const BoundarySurface& surface, const BoundaryStars& stars,
                                            const std::vector<EdgeKey>& keys, const Counter& counter) {
    const Triangles& triangles = surface.mesh.triangles;
    std::vector<std::array<Vector3, 3>> normals(triangles.rows());  // of the sector, per corner of a triangle
    for (Index v = 0; v < stars.vertex_count(); ++v) {
        const std::span<const Index> star = stars.triangles(v);
        const std::vector<int> sector = stars.sectors(v);
        const std::vector<Vector3> of_sectors = stars.sector_normals(v);
        std::vector<int> number(star.size());
        for (int i = 0, next = 0; i < static_cast<int>(star.size()); ++i) {
            number[i] = sector[i] == i ? next++ : number[sector[i]];
            for (int k = 0; k < 3; ++k)
                if (triangles(star[i], k) == v) normals[star[i]][k] = of_sectors[number[i]];
        }
    }
    std::map<EdgeKey, int> found;
    for (Eigen::Index t = 0; t < triangles.rows(); ++t)
        for (int k = 0; k < 3; ++k) {
            const int l = (k + 1) % 3;
            const Index v = surface.vertex_map[triangles(t, k)], w = surface.vertex_map[triangles(t, l)];
            const EdgeKey key = std::minmax({v, w});
            if (std::binary_search(keys.begin(), keys.end(), key)) continue;
            const int hexahedra = counter.hexahedra(v, w, normals[t][k], normals[t][l]);
            if (hexahedra != 2) found.emplace(key, hexahedra);
        }
    std::vector<SurfaceCrossing> crossings;
    for (const auto& [key, hexahedra] : found) crossings.push_back({key.first, key.second, hexahedra});
    return crossings;
}

std::vector<SurfaceCorner> find_corners(const BoundarySurface& surface, const BoundaryStars& stars,
                                        const surface::FeatureGraph& features, const std::vector<EdgeKey>& keys,
                                        const Counter& counter, const std::vector<FeatureWedge>& wedges) {
    std::vector<std::uint8_t> is_corner(stars.vertex_count(), 0);
    for (const Index v : features.corners) is_corner[v] = 1;
    const CornerJudge judge(surface, counter, wedges, keys, is_corner);
    std::vector<SurfaceCorner> corners;
    for (Index v = 0; v < stars.vertex_count(); ++v) {
        if (!is_corner[v]) continue;
        const std::vector<Index> neighbours = ring(surface, stars, v);
        if (neighbours.empty()) continue;
        if (const auto corner = judge.judge(v, neighbours)) corners.push_back(*corner);
    }
    return corners;
}

}  // namespace

BoundaryMeshability boundary_meshability(const TetMesh& mesh, const BoundarySurface& surface,
                                         const surface::FeatureGraph& features, const Quaternions& frames,
                                         int threads) {
    require_valid(mesh);
    require_frames(frames, mesh.vertices.rows());
    require_fitting(mesh, surface, features);
    const BoundaryStars stars(surface.mesh, features);
    const std::vector<EdgeKey> keys = feature_keys(surface, features);
    const std::vector<Wedge> wedges = surface_wedges(mesh, surface, keys, threads);
    const Counter counter(mesh, frames);
    BoundaryMeshability result;
    result.wedges.resize(wedges.size());
    parallel_for(static_cast<std::int64_t>(wedges.size()), threads,
                 [&](std::int64_t i) { result.wedges[i] = counter.judge(wedges[i]); });
    result.crossings = find_crossings(surface, stars, keys, counter);
    result.corners = find_corners(surface, stars, features, keys, counter, result.wedges);
    for (const FeatureWedge& w : result.wedges) result.non_meshable_wedges += !w.meshable;
    for (const SurfaceCrossing& c : result.crossings) result.non_meshable_crossings += c.hexahedra < 1;
    for (const SurfaceCorner& c : result.corners) result.non_meshable_corners += !c.meshable;
    return result;
}

}  // namespace octafield::volume
