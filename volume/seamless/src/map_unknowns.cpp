#include "map_unknowns.hpp"

#include <algorithm>
#include <array>
#include <deque>

#include "axis_numbers.hpp"
#include "edge_loops.hpp"
#include "map_room.hpp"
#include "map_transitions.hpp"
#include "octafield/disjoint_sets.hpp"
#include "octafield/frames/octahedral_group.hpp"

namespace octafield::volume::detail {
namespace {

// Parts of the cut with one transition each.
struct Sheets {
    std::vector<Index> of_row;           // -1: not of the cut
    std::vector<std::uint8_t> reversed;  // the sheet's transition leads from the row's second tet to its first
    Index count = 0;
};

std::vector<std::uint8_t> cut_rows(const TriangleTable& table, const CombedField& combed) {
    std::vector<std::uint8_t> cut(table.triangles.rows(), 0);
    std::size_t f = 0;
    for (Index row = 0; row < table.triangles.rows(); ++row)
        if (table.sides(row, 1) >= 0) cut[row] = combed.cut[f++];
    return cut;
}

Sheets sheets_of(const MatchedField& field, const std::vector<std::uint8_t>& cut) {
    const TriangleTable& table = field.domain.triangles();
    struct Neighbour {
        Index row;
        bool turned;
    };
    std::vector<std::vector<Neighbour>> neighbours(cut.size());
    const std::vector<TetAtEdge> tets = tets_at_edges(field.domain.mesh(), table, 1);
    for_each_edge_loop(tets, table, field.matching, [&](std::size_t first, std::size_t last, const EdgeLoop& loop) {
        if (!loop.closed || loop.holonomy != 0) return;
        std::vector<const TetAtEdge*> crossed;
        for (std::size_t i = first; i < last; ++i)
            if (cut[tets[i].triangle]) crossed.push_back(&tets[i]);
        if (crossed.size() != 2) return;
        const auto forward = [&](int k) { return table.sides(crossed[k]->triangle, 0) / 4 == crossed[k]->tet; };
        const bool turned = forward(0) == forward(1);
        for (int k = 0; k < 2; ++k) neighbours[crossed[k]->triangle].push_back({crossed[1 - k]->triangle, turned});
    });
    Sheets sheets{std::vector<Index>(cut.size(), -1), std::vector<std::uint8_t>(cut.size(), 0), 0};
    std::deque<Index> queue;
    for (Index seed = 0; seed < static_cast<Index>(cut.size()); ++seed) {
        if (!cut[seed] || sheets.of_row[seed] >= 0) continue;
        sheets.of_row[seed] = sheets.count++;
        for (queue.push_back(seed); !queue.empty(); queue.pop_front())
            for (const Neighbour& n : neighbours[queue.front()]) {
                if (sheets.of_row[n.row] >= 0) continue;
                sheets.of_row[n.row] = sheets.of_row[queue.front()];
                sheets.reversed[n.row] = sheets.reversed[queue.front()] ^ n.turned;
                queue.push_back(n.row);
            }
    }
    return sheets;
}

class Equations {
public:
    Equations(const MatchedField& field, const CombedField& combed)
        : field_(field),
          mesh_(field.domain.mesh()),
          table_(field.domain.triangles()),
          cut_(cut_rows(table_, combed)),
          sheets_(sheets_of(field, cut_)),
          corners_(join_corners()),
          values_(3 * count_, 3 * sheets_.count) {}

    MapUnknowns solve() {
        hold_parts();
        for (Index row = 0; row < table_.triangles.rows(); ++row)
            if (cut_[row]) cross(row);
        align_surface();
        align_features();
        MapUnknowns result{corners_, values_.free(), {}};
        for (Index t = 0; t < mesh_.tets.rows(); ++t)
            if (is_flat(result, t)) result.locked.push_back(t);
        return result;
    }

private:
    Tets join_corners() {
        DisjointSets sets(4 * static_cast<std::size_t>(mesh_.tets.rows()));
        for (Index row = 0; row < table_.triangles.rows(); ++row) {
            if (cut_[row] || table_.sides(row, 1) < 0) continue;
            const Index first = table_.sides(row, 0) / 4, second = table_.sides(row, 1) / 4;
            for (int k = 0; k < 3; ++k) {
                const Index v = table_.triangles(row, k);
                sets.join(4 * first + corner_at(mesh_.tets, first, v), 4 * second + corner_at(mesh_.tets, second, v));
            }
        }
        const std::vector<Index> numbers = std::move(sets).numbers(count_);
        return Eigen::Map<const Tets>(numbers.data(), mesh_.tets.rows(), 4);
    }
    Index number(Index tet, Index vertex, int i) const {
        return 3 * corners_(tet, corner_at(mesh_.tets, tet, vertex)) + i;
    }

    void hold_parts() {
        DisjointSets sets(mesh_.tets.rows());
        for (Index row = 0; row < table_.triangles.rows(); ++row)
            if (table_.sides(row, 1) >= 0) sets.join(table_.sides(row, 0) / 4, table_.sides(row, 1) / 4);
        for (Index t = 0; t < mesh_.tets.rows(); ++t)
            for (int i = 0; i < 3 && sets.lowest(t) == t; ++i) values_.set_zero(3 * corners_(t, 0) + i);
    }
    void cross(Index row) {
        Index from = table_.sides(row, 0) / 4, to = table_.sides(row, 1) / 4;
        int matching = field_.matching[row];
        if (sheets_.reversed[row]) {
            std::swap(from, to);
            matching = frames::octahedral_inverse(matching);
        }
        for (int i = 0; i < 3; ++i) {
            const int axis = turned_axis(matching, i);
            for (int k = 0; k < 3; ++k) {
                const Index v = table_.triangles(row, k);
                values_.relate(number(to, v, i), number(from, v, axis % 3), axis < 3 ? 1 : -1,
                               {{3 * sheets_.of_row[row] + i, 1.0}});
            }
        }
    }
    void align_surface() {
        const std::vector<std::uint8_t> axes = normal_axes(field_);
        for (Index f = 0; f < static_cast<Index>(axes.size()); ++f)
            for (int k = 1; k < 3; ++k)
                values_.relate(number(behind(f), vertex(f, k), axes[f]), number(behind(f), vertex(f, 0), axes[f]), 1,
                               {});
    }
    // Where both triangles at a feature keep one and the same parameter, the edge keeps another one, too.
    void align_features() {
        const auto& triangles = field_.domain.surface().mesh.triangles;
        std::vector<std::array<Index, 3>> sides;  // vertices of the surface, lower first, and triangle
        for (Index f = 0; f < triangles.rows(); ++f)
            for (int k = 0; k < 3; ++k) {
                const auto [a, b] = std::minmax(triangles(f, k), triangles(f, (k + 1) % 3));
                sides.push_back({a, b, f});
            }
        std::sort(sides.begin(), sides.end());
        for (const auto e : field_.domain.features().edges.rowwise()) {
            const auto found = std::lower_bound(sides.begin(), sides.end(), std::array<Index, 3>{e[0], e[1], -1});
            if (found != sides.end() && (*found)[0] == e[0] && (*found)[1] == e[1])
                align_feature(e[0], e[1], (*found)[2]);
        }
    }
    void align_feature(Index one, Index other, Index triangle) {
        const std::vector<Index>& map = field_.domain.surface().vertex_map;
        const Index tet = behind(triangle), a = map[one], b = map[other];
        const auto equal = [&](int i) { return values_.are_equal(number(tet, a, i), number(tet, b, i)); };
        const Eigen::Vector3d way = frames::from_wxyz(field_.frames.row(tet)).conjugate() *
                                    Eigen::Vector3d((mesh_.vertices.row(b) - mesh_.vertices.row(a)).transpose());
        int kept = 0, least = -1;
        for (int i = 0; i < 3; ++i) {
            if (equal(i)) {
                ++kept;
            } else if (least < 0 || std::abs(way[i]) < std::abs(way[least])) {
                least = i;
            }
        }
        if (kept < 2 && least >= 0) values_.relate(number(tet, a, least), number(tet, b, least), 1, {});
    }
    Index behind(Index triangle) const { return field_.domain.sides()(triangle, 0); }
    Index vertex(Index triangle, int k) const {
        const BoundarySurface& surface = field_.domain.surface();
        return surface.vertex_map[surface.mesh.triangles(triangle, k)];
    }

    // One parameter of all corners, two of three, or three of two.
    static bool is_flat(const MapUnknowns& unknowns, Index tet) {
        const auto same = [&](int k, int l, int i) {
            return unknowns.free.rows[3 * unknowns.corners(tet, k) + i] ==
                   unknowns.free.rows[3 * unknowns.corners(tet, l) + i];
        };
        for (int k = 0; k < 4; ++k) {
            int all = 0;
            std::array<int, 4> of{};  // parameters that corner l has as k
            for (int i = 0; i < 3; ++i) {
                int count = 0;
                for (int l = 0; l < 4; ++l) count += l != k && same(k, l, i);
                all += count == 3;
                for (int l = 0; l < 4; ++l) of[l] += l != k && same(k, l, i);
            }
            if (all > 0) return true;
            for (int l = 0; l < 4; ++l) {
                if (of[l] == 3) return true;
                for (int n = 0; n < l; ++n) {
                    if (l == k || n == k) continue;
                    int both = 0;
                    for (int i = 0; i < 3; ++i) both += same(k, l, i) && same(k, n, i);
                    if (both >= 2) return true;
                }
            }
        }
        return false;
    }

    const MatchedField& field_;
    const TetMesh& mesh_;
    const TriangleTable& table_;
    std::vector<std::uint8_t> cut_;
    Sheets sheets_;
    Index count_ = 0;
    Tets corners_;
    RelatedValues values_;
};

}  // namespace

MapUnknowns map_unknowns(const MatchedField& field, const CombedField& combed) {
    return Equations(field, combed).solve();
}

}  // namespace octafield::volume::detail
