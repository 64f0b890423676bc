#include "cut_tets.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <utility>

#include "octafield/volume/triangle_table.hpp"

namespace octafield::volume::detail {
namespace {

constexpr double same = 1e-8;       // of the mean extent of the tets
constexpr double least_left = 0.2;  // of the volume of a tet, when a vertex of it moves

}  // namespace

CutTets::CutTets(const SeamlessMap& map) {
    const TetMesh& mesh = map.mesh;
    for (Index v = 0; v < mesh.vertices.rows(); ++v) points_.push_back(mesh.vertices.row(v).transpose());
    vertex_tet_.assign(points_.size(), -1);
    tets_.resize(mesh.tets.rows());
    double sum = 0;
    for (Index t = 0; t < tet_count(); ++t) {
        CutTet& tet = tets_[t];
        tet.root = t;
        tet.wall = tet.over = tet.next = {-1, -1, -1, -1};
        for (int k = 0; k < 4; ++k) {
            tet.vertices[k] = mesh.tets(t, k);
            tet.at[k] = parameters_at(map.parameters, t, k);
            vertex_tet_[mesh.tets(t, k)] = t;
        }
        sum += extent(map.parameters, t);
    }
    tolerance_ = same * sum / static_cast<double>(tets_.size());
    for (Index e = 0; e < map.features.rows(); ++e) features_.insert(edge_key(map.features(e, 0), map.features(e, 1)));
    link(map);
}

void CutTets::link(const SeamlessMap& map) {
    const TriangleTable table = triangle_table(map.mesh);
    for (Index f = 0; f < table.triangles.rows(); ++f) {
        if (table.sides(f, 1) < 0) continue;
        for (int side = 0; side < 2; ++side) {
            const Index here = table.sides(f, side), there = table.sides(f, 1 - side);
            CutTet& tet = tets_[here / 4];
            tet.next[here % 4] = there / 4;
            const Transition way = transition(triangle_parameters(map.parameters, map.mesh.tets, table, f, side),
                                              triangle_parameters(map.parameters, map.mesh.tets, table, f, 1 - side));
            // Rounding must not move what has the same parameters on both sides.
            if (way.rotation.isIdentity(0) && way.translation.norm() <= tolerance_ / 1000) continue;
            tet.over[here % 4] = static_cast<Index>(transitions_.size()) - 1;
            transitions_.push_back(way);
        }
    }
}

std::array<Index, 3> CutTets::triangle(Index tet, int face) const {
    const auto& v = tets_[tet].vertices;
    return {v[tet_face[face][0]], v[tet_face[face][1]], v[tet_face[face][2]]};
}

int CutTets::back(Index tet, int face) const {
    const auto& next = tets_[tets_[tet].next[face]].next;
    return static_cast<int>(std::find(next.begin(), next.end(), tet) - next.begin());
}

Index CutTets::tet_at(const EdgeKey& edge) const {
    const auto has = [&](Index t, Index v) {
        const auto& all = tets_[t].vertices;
        return std::find(all.begin(), all.end(), v) != all.end();
    };
    std::vector<Index> reached{vertex_tet_[edge[0]]};
    std::set<Index> known{reached[0]};
    for (std::size_t i = 0; i < reached.size(); ++i) {
        if (has(reached[i], edge[1])) return reached[i];
        for (int k = 0; k < 4; ++k) {
            const Index other = tets_[reached[i]].next[k];
            if (other >= 0 && has(other, edge[0]) && known.insert(other).second) reached.push_back(other);
        }
    }
    return -1;
}

EdgeRing CutTets::ring(const EdgeKey& edge) const {
    const Index tet = tet_at(edge);
    return tet < 0 ? EdgeRing{{}, true} : ring(edge, tet);
}

EdgeRing CutTets::ring(const EdgeKey& edge, Index first) const {
    const auto others = [&](Index t) {
        std::array<Index, 2> result{};
        int n = 0;
        for (const Index v : tets_[t].vertices)
            if (v != edge[0] && v != edge[1]) result[n++] = v;
        return result;
    };
    const auto other_than = [&](Index t, Index v) {
        const auto both = others(t);
        return both[0] == v ? both[1] : both[0];
    };
    const auto start = others(first);
    EdgeRing result{{{first, start[0], start[1]}}, true};
    for (;;) {
        const Wedge last = result.wedges.back();
        const Index next = tets_[last.tet].next[tets_[last.tet].corner(last.from)];
        if (next == first) return result;
        if (next < 0) break;
        result.wedges.push_back({next, last.to, other_than(next, last.to)});
    }
    result.closed = false;
    std::vector<Wedge> before;
    for (Wedge here = result.wedges.front();;) {
        const Index next = tets_[here.tet].next[tets_[here.tet].corner(here.to)];
        if (next < 0) break;
        before.push_back(here = {next, other_than(next, here.from), here.from});
    }
    result.wedges.insert(result.wedges.begin(), before.rbegin(), before.rend());
    return result;
}

Index CutTets::split(const EdgeKey& edge, double share) {
    const EdgeRing around = ring(edge);
    const Index middle = vertex_count();
    points_.push_back(points_[edge[0]] + share * (points_[edge[1]] - points_[edge[0]]));
    std::map<Index, Index> far;  // the half at the second vertex of each tet
    for (const Wedge& wedge : around.wedges) {
        far[wedge.tet] = tet_count();
        CutTet half = tets_[wedge.tet];
        const int a = half.corner(edge[0]), b = half.corner(edge[1]);
        const Eigen::Vector3d at = half.at[a] + share * (half.at[b] - half.at[a]);
        half.vertices[a] = tets_[wedge.tet].vertices[b] = middle;
        half.at[a] = tets_[wedge.tet].at[b] = at;
        tets_.push_back(half);
    }
    vertex_tet_.push_back(around.wedges[0].tet);
    for (const auto& [here, there] : far) {
        CutTet &tet = tets_[here], &half = tets_[there];
        const int a = tet.corner(edge[0]), b = half.corner(edge[1]);
        if (half.next[a] >= 0) tets_[half.next[a]].next[back(here, a)] = there;
        if (half.wall[a] >= 0 && walls_[half.wall[a]].tet == here) walls_[half.wall[a]].tet = there;
        tet.next[a] = there;
        half.next[b] = here;
        tet.over[a] = tet.wall[a] = half.over[b] = half.wall[b] = -1;
        vertex_tet_[edge[1]] = there;
    }
    for (const auto& [here, there] : far)
        for (int k = 0; k < 4; ++k) {
            CutTet& half = tets_[there];
            const Index corner = half.vertices[k];
            if (corner == middle || corner == edge[1]) continue;
            const Index next = half.next[k];
            if (next >= 0) half.next[k] = far.at(next);
            const Index wall = half.wall[k];
            if (wall < 0 || walls_[wall].tet != here) continue;
            Index third = -1;
            for (const Index v : half.vertices)
                if (v != corner && v != middle && v != edge[1]) third = v;
            const Index made = static_cast<Index>(walls_.size());
            walls_.push_back(walls_[wall]);
            walls_.back().tet = there;
            half.wall[k] = made;
            new_edges_.insert(new_edges_.end(), {{wall, edge_key(edge[0], middle)},
                                                 {made, edge_key(edge[1], middle)},
                                                 {made, edge_key(edge[1], third)}});
        }
    // The other sides of walls that were split.
    for (const auto& [here, there] : far)
        for (int k = 0; k < 4; ++k) {
            const Index wall = tets_[there].wall[k];
            if (wall < 0 || walls_[wall].tet != there || tets_[there].next[k] < 0) continue;
            tets_[tets_[there].next[k]].wall[back(there, k)] = wall;
        }
    for (auto* set : {&features_, &irregular}) {
        if (!set->erase(edge)) continue;
        for (const Index end : edge) {
            set->insert(edge_key(end, middle));
            if (set == &irregular) new_irregular_.push_back(edge_key(end, middle));
        }
    }
    return middle;
}

bool CutTets::slide(Index first, Index vertex, int axis, double value) {
    const auto volume = [](const auto& p) { return (p[1] - p[0]).cross(p[2] - p[0]).dot(p[3] - p[0]); };
    const CutTet& start = tets_[first];
    const int own = start.corner(vertex);
    const Eigen::Vector3d way = Eigen::Vector3d::Unit(axis) * (value - start.at[own][axis]);
    Eigen::Matrix3d parameters, space;  // edges of the tet
    for (int j = 0; j < 3; ++j) {
        parameters.col(j) = start.at[(own + j + 1) % 4] - start.at[own];
        space.col(j) = points_[start.vertices[(own + j + 1) % 4]] - points_[vertex];
    }
    const Eigen::Vector3d point = points_[vertex] + space * parameters.inverse() * way;
    std::vector<std::pair<Index, Eigen::Vector3d>> star{{first, way}};
    std::set<Index> known{first};
    for (std::size_t i = 0; i < star.size(); ++i) {
        const auto [here, moved] = star[i];
        const CutTet& tet = tets_[here];
        const int corner = tet.corner(vertex);
        auto at = tet.at, points = tet.at;
        for (int k = 0; k < 4; ++k) {
            points[k] = points_[tet.vertices[k]];
            if (k == corner) continue;
            if (irregular.count(edge_key(vertex, tet.vertices[k])) || tet.next[k] < 0) return false;
            if (tet.wall[k] >= 0 && walls_[tet.wall[k]].tet == here &&
                std::abs(moved[walls_[tet.wall[k]].axis]) > tolerance_ / 1000)
                return false;
            if (known.insert(tet.next[k]).second) star.emplace_back(tet.next[k], over(here, k).rotation * moved);
        }
        const double before = volume(tet.at), before_in_space = volume(points);
        at[corner] += moved;
        points[corner] = point;
        if (volume(at) < least_left * before || volume(points) < least_left * before_in_space) return false;
    }
    points_[vertex] = point;
    for (const auto& [here, moved] : star) tets_[here].at[tets_[here].corner(vertex)] += moved;
    return true;
}

Index CutTets::add_wall(Index tet, int face, int axis, const std::array<Eigen::Vector3d, 2>& source) {
    const Index number = static_cast<Index>(walls_.size()), next = tets_[tet].next[face];
    tets_[tet].wall[face] = number;
    if (next >= 0) tets_[next].wall[back(tet, face)] = number;
    walls_.push_back({tet, face, axis, source});
    const auto v = triangle(tet, face);
    for (int k = 0; k < 3; ++k) new_edges_.push_back({number, edge_key(v[k], v[(k + 1) % 3])});
    return number;
}

void CutTets::remove_wall(Index wall) {
    WallTriangle& gone = walls_[wall];
    const Index next = tets_[gone.tet].next[gone.face];
    if (next >= 0) tets_[next].wall[back(gone.tet, gone.face)] = -1;
    tets_[gone.tet].wall[gone.face] = -1;
    gone.kept = false;
}

SeamlessMap CutTets::map(const std::vector<Index>& corners) const {
    SeamlessMap result;
    result.corners = corners;
    result.mesh.vertices.resize(vertex_count(), 3);
    for (Index v = 0; v < vertex_count(); ++v) result.mesh.vertices.row(v) = points_[v].transpose();
    result.mesh.tets.resize(tet_count(), 4);
    result.parameters.resize(tet_count(), 12);
    for (Index t = 0; t < tet_count(); ++t)
        for (int k = 0; k < 4; ++k) {
            result.mesh.tets(t, k) = tets_[t].vertices[k];
            result.parameters.block<1, 3>(t, 3 * k) = tets_[t].at[k].transpose();
        }
    std::vector<std::array<Index, 3>> walls;
    for (const WallTriangle& wall : walls_)
        if (wall.kept) walls.push_back(triangle(wall.tet, wall.face));
    result.walls.resize(static_cast<Index>(walls.size()), 3);
    for (std::size_t w = 0; w < walls.size(); ++w)
        result.walls.row(static_cast<Index>(w)) << walls[w][0], walls[w][1], walls[w][2];
    result.features.resize(static_cast<Index>(features_.size()), 2);
    Index row = 0;
    for (const EdgeKey& edge : features_) result.features.row(row++) << edge[0], edge[1];
    return result;
}

}  // namespace octafield::volume::detail
