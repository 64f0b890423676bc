#include "octafield/volume/boundary_meshability.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "boundary_star.hpp"
#include "octafield/error.hpp"
#include "octafield/parallel.hpp"
#include "octafield/volume/tet_meshability.hpp"
#include "require_frames.hpp"
#include "turn_counter.hpp"

namespace octafield::volume {
namespace {

using frames::Vector3;
using EdgeKey = std::pair<Index, Index>;

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

// Quadrilaterals in the fan of triangles (v, link[i], link[i + 1]).
using CountQuadrilaterals = std::function<std::optional<int>(Index v, const std::vector<Index>& link)>;

class CornerJudge {
public:
    CornerJudge(const BoundarySurface& surface, const CountQuadrilaterals& counter,
                const std::vector<FeatureWedge>& wedges, std::vector<EdgeKey> keys,
                const std::vector<std::uint8_t>& corner)
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
        SurfaceCorner corner{surface_.vertex_map[b], 0, 0, 6, 0, 0, 0, false};
        std::vector<Index> link{surface_.vertex_map[ring.front()]};
        for (std::size_t i = 1; i < ring.size(); ++i) {
            link.push_back(surface_.vertex_map[ring[i]]);
            if (!is_feature(ring[i])) continue;
            count_edge(b, ring[i], corner);
            const std::optional<int> quadrilaterals = counter_(corner.vertex, link);
            ++corner.sectors;
            corner.unclear_sectors += !quadrilaterals;
            corner.empty_sectors += quadrilaterals && *quadrilaterals < 1;
            corner.inside -= quadrilaterals.value_or(1) - 1;
            link = {link.back()};
        }
        corner.meshable = corner.empty_sectors == 0 && corner.non_meshable_edges == 0 &&
                          (corner.inside >= 0 || corner.unclear_sectors > 0);
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
    const CountQuadrilaterals& counter_;
    const std::vector<EdgeKey> keys_;
    const std::vector<std::uint8_t>& corner_;
    std::multimap<EdgeKey, const FeatureWedge*> by_edge_;
};

// Edges of the surface that are no features, once each.
std::vector<SurfaceCrossing> find_crossings(const BoundarySurface& surface, const BoundaryStars& stars,
                                            const std::vector<EdgeKey>& keys, const TurnCounter& counter) {
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
                                        const CountQuadrilaterals& counter, const std::vector<FeatureWedge>& wedges) {
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

void add_totals(BoundaryMeshability& result) {
    for (const FeatureWedge& w : result.wedges) result.non_meshable_wedges += !w.meshable;
    for (const SurfaceCrossing& c : result.crossings) result.non_meshable_crossings += c.hexahedra < 1;
    for (const SurfaceCorner& c : result.corners) result.non_meshable_corners += !c.meshable;
}

// All edges of the surface, by tet-mesh ids.
std::vector<EdgeKey> surface_keys(const BoundarySurface& surface) {
    std::vector<EdgeKey> keys;
    for (const auto triangle : surface.mesh.triangles.rowwise())
        for (int k = 0; k < 3; ++k)
            keys.push_back(std::minmax({surface.vertex_map[triangle[k]], surface.vertex_map[triangle[(k + 1) % 3]]}));
    std::sort(keys.begin(), keys.end());
    keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
    return keys;
}

}  // namespace

BoundaryMeshability boundary_meshability(const TetDomain& domain, const Quaternions& frames, int threads,
                                         const Stretches& stretch) {
    const TetMesh& mesh = domain.mesh();
    const BoundarySurface& surface = domain.surface();
    const surface::FeatureGraph& features = domain.features();
    require_frames(frames, mesh.vertices.rows());
    const BoundaryStars stars(surface.mesh, features);
    const std::vector<EdgeKey> keys = feature_keys(surface, features);
    const std::vector<Wedge> wedges = surface_wedges(domain, keys, threads);
    const TurnCounter counter(mesh, frames, stretch_or_none(stretch, domain.vertex_count()));
    BoundaryMeshability result;
    result.wedges.resize(wedges.size());
    parallel_for(static_cast<std::int64_t>(wedges.size()), threads,
                 [&](std::int64_t i) { result.wedges[i] = counter.judge(wedges[i]); });
    result.crossings = find_crossings(surface, stars, keys, counter);
    result.corners = find_corners(
        surface, stars, features, keys,
        [&](Index v, const std::vector<Index>& link) { return counter.quadrilaterals(v, link); }, result.wedges);
    add_totals(result);
    return result;
}

Rows<double, 2> wedge_alignment(const TetDomain& domain, const Quaternions& frames, int threads,
                                const Stretches& stretch) {
    require_frames(frames, domain.vertex_count());
    const Stretches* stretched = stretch_or_none(stretch, domain.vertex_count());
    const std::vector<Wedge> wedges =
        surface_wedges(domain, feature_keys(domain.surface(), domain.features()), threads);
    Rows<double, 2> result = Rows<double, 2>::Zero(static_cast<Eigen::Index>(wedges.size()), 2);
    parallel_for(result.rows(), threads, [&](std::int64_t i) {
        const Wedge& wedge = wedges[i];
        const auto [first, last] = outward_normals(domain.mesh(), wedge);
        const Vector3 edge = (domain.mesh().vertices.row(wedge.b) - domain.mesh().vertices.row(wedge.a)).transpose();
        for (const Index v : {wedge.a, wedge.b}) {
            const frames::Matrix3 turned = frames::from_wxyz(frames.row(v)).toRotationMatrix();
            const frames::Matrix3 s = stretched ? unpacked(stretched->row(v)) : frames::Matrix3::Identity();
            const frames::Matrix3 normals = s.inverse() * turned, axes = s * turned;
            result(i, 0) = std::max(
                {result(i, 0), angle_to_nearest_column(normals, first), angle_to_nearest_column(normals, last)});
            result(i, 1) = std::max(result(i, 1), angle_to_nearest_column(axes, edge));
        }
    });
    return result;
}

BoundaryMeshability tet_boundary_meshability(const TetDomain& domain, const Quaternions& of_tets, int threads) {
    const TetMesh& mesh = domain.mesh();
    const BoundarySurface& surface = domain.surface();
    const surface::FeatureGraph& features = domain.features();
    require_frames(of_tets, mesh.tets.rows());
    const std::vector<EdgeKey> keys = feature_keys(surface, features);
    const std::vector<Wedge> wedges = surface_wedges(domain, surface_keys(surface), threads);
    const TetTurnCounter counter(mesh, of_tets, wedges);
    BoundaryMeshability result;
    for (const Wedge& w : wedges)
        if (std::binary_search(keys.begin(), keys.end(), EdgeKey{w.a, w.b}))
            result.wedges.push_back(counter.judge(w));
        else if (const int hexahedra = counter.hexahedra(w); hexahedra != 2)
            result.crossings.push_back({w.a, w.b, hexahedra});
    result.corners = find_corners(
        surface, BoundaryStars(surface.mesh, features), features, keys,
        [&](Index v, const std::vector<Index>& link) { return counter.quadrilaterals(v, link); }, result.wedges);
    add_totals(result);
    return result;
}

}  // namespace octafield::volume
