#include "octafield/volume/motorcycle_complex.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "octafield/error.hpp"
#include "wall_blocks.hpp"

namespace octafield::volume {
namespace {

using namespace detail;

constexpr Index growth = 40, least_room = 200000;  // how many tets walls may make of those that are given

// Whether two parameters are the same all along an edge of a tet.
bool along_an_axis(const CutTets& tets, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    return ((to - from).array().abs() <= tets.tolerance()).count() >= 2;
}

// Edges where blocks meet in other ways than inside a box or on its sides.
void find_irregular(CutTets& tets) {
    std::set<EdgeKey> known;
    std::vector<Index> winding;
    for (Index t = 0; t < tets.tet_count(); ++t)
        for (int a = 0; a < 4; ++a)
            for (int b = a + 1; b < 4; ++b) {
                const EdgeKey edge = edge_key(tets.tet(t).vertices[a], tets.tet(t).vertices[b]);
                if (!known.insert(edge).second) continue;
                const EdgeRing ring = tets.ring(edge, t);
                const int quarters = quarters_around(tets, ring, edge);
                const bool flat_feature = !ring.closed && quarters == 2 && tets.features().count(edge);
                if (ring.closed ? quarters == 4 : quarters <= 2 && !flat_feature) continue;
                tets.irregular.insert(edge);
                if (!flat_feature && !along_an_axis(tets, tets.tet(t).at[a], tets.tet(t).at[b]))
                    winding.insert(winding.end(), {edge[0], edge[1]});
            }
    if (!winding.empty())
        throw GeometryError("parameters wind round edges at vertices " + first_few(winding) +
                                " that lie along no axis; blocks need a map whose singular edges do",
                            "winding_edge", winding);
}

void require_aligned(const CutTets& tets) {
    std::vector<Index> bad;
    for (Index t = 0; t < tets.tet_count(); ++t)
        for (int k = 0; k < 4; ++k) {
            const CutTet& tet = tets.tet(t);
            if (tet.next[k] >= 0) continue;
            bool aligned = false;
            for (int axis = 0; axis < 3; ++axis) {
                double low = 1e300, high = -1e300;
                for (int j = 0; j < 4; ++j)
                    if (j != k) {
                        low = std::min(low, tet.at[j][axis]);
                        high = std::max(high, tet.at[j][axis]);
                    }
                aligned |= high - low <= tets.tolerance();
            }
            if (!aligned) bad.push_back(t);
        }
    if (!bad.empty())
        throw GeometryError("no parameter is constant on the boundary triangles of tets " + first_few(bad) +
                                "; blocks need a map that is aligned with the boundary",
                            "unaligned_boundary", bad);
}

// Vertices where features or irregular edges end or meet.
std::vector<char> special_vertices(const CutTets& tets) {
    std::vector<int> count(tets.vertex_count(), 0);
    for (const auto* edges : {&tets.features(), &tets.irregular})
        for (const EdgeKey& edge : *edges)
            for (const Index v : edge) ++count[v];
    std::vector<char> result;
    for (const int n : count) result.push_back(n != 0 && n != 2);
    return result;
}

// A wall across the way round in a block, through a special vertex where there is one. False: there is no place for it.
bool cut_winding(const CutTets& tets, const CutBlocks& blocks, Index block, int axis, WallSpread& spread) {
    const std::vector<char> special = special_vertices(tets);
    for (const bool any : {false, true})
        for (Index t = 0; t < static_cast<Index>(blocks.of.size()); ++t) {
            if (blocks.of[t] != block) continue;
            int own = 0;
            blocks.charts[t].rotation.row(axis).cwiseAbs().maxCoeff(&own);
            for (int k = 0; k < 4; ++k)
                if ((any || special[tets.tet(t).vertices[k]]) && spread.start_at_corner(t, k, own)) return true;
        }
    return false;
}

void cut_windings(const CutTets& tets, const CutBlocks& blocks, WallSpread& spread) {
    std::vector<Index> left;
    for (const Winding& winding : blocks.windings) {
        bool cut = false;
        for (const int axis : winding.axes) cut |= cut_winding(tets, blocks, winding.block, axis, spread);
        if (!cut) left.push_back(winding.block);
    }
    if (left.size() == blocks.windings.size())
        throw GeometryError("blocks " + first_few(left) + " close in themselves and no plane cuts them", "not_a_box",
                            left);
    spread.spread();
}

}  // namespace

SeamlessMap motorcycle_complex(const SeamlessMap& map, const Progress& progress) {
    report_or_throw(progress, "walls", 0, std::nan(""));
    require_seamless(map);
    CutTets tets(map);
    require_aligned(tets);
    find_irregular(tets);
    WallSpread spread(tets, growth * tets.tet_count() + least_room, progress);
    spread.start_at_edges();
    spread.spread();
    for (CutBlocks blocks = cut_blocks(tets); !blocks.windings.empty(); blocks = cut_blocks(tets))
        cut_windings(tets, blocks, spread);
    remove_walls(tets);
    return tets.map(map.corners);
}

}  // namespace octafield::volume
