#include "block_arcs.hpp"

#include <algorithm>
#include <set>

#include "map_transitions.hpp"
#include "octafield/error.hpp"

namespace octafield::volume::detail {

WallEdges::WallEdges(const SeamlessMap& map, const TriangleTable& table, const BlockCharts& charts)
    : map_(map), table_(table), charts_(charts) {
    for (const Index f : charts.wall_rows)
        for (int k = 0; k < 3; ++k)
            walls_[edge_key(table.triangles(f, k), table.triangles(f, (k + 1) % 3))].push_back(f);
    const auto in_one_plane = [&](const EdgeKey& edge, Index f, Index g) {
        for (int side = 0; side < 2; ++side) {
            if (table.sides(f, side) < 0) continue;
            bool found = false;
            for (int other = 0; other < 2; ++other)
                found |= table.sides(g, other) >= 0 && seen({f, side}, edge) == seen({g, other}, edge);
            if (!found) return false;
        }
        return (table.sides(f, 1) < 0) == (table.sides(g, 1) < 0);
    };
    for (const auto& [edge, rows] : walls_)
        if (rows.size() != 2 || !in_one_plane(edge, rows[0], rows[1])) arc_edges_[edge] = 1;
}

Index WallEdges::block_vertex(WallSide wall, Index vertex) const {
    const Index tet = table_.sides(wall.triangle, wall.side) / 4;
    return charts_.block_vertices(tet, corner_at(map_.mesh.tets, tet, vertex));
}

SeenEdge WallEdges::seen(WallSide wall, const EdgeKey& edge) const {
    return {block_vertex(wall, edge[0]), block_vertex(wall, edge[1]), charts_.wall_sides[wall.triangle][wall.side]};
}

WallEdges::Chains WallEdges::chains(const std::vector<Index>& corners) const {
    std::map<Index, std::vector<Index>> next;
    for (const auto& [edge, unused] : arc_edges_) {
        next[edge[0]].push_back(edge[1]);
        next[edge[1]].push_back(edge[0]);
    }
    std::set<Index> nodes;
    for (const auto& [vertex, others] : next)
        if (others.size() != 2) nodes.insert(vertex);
    for (const Index corner : corners)
        if (next.count(corner)) nodes.insert(corner);
    Chains result;
    result.nodes.assign(nodes.begin(), nodes.end());
    for (const Index node : nodes)
        for (const Index start : next[node]) {
            if (result.place.count(edge_key(node, start))) continue;
            std::vector<Index> chain{node, start};
            while (!nodes.count(chain.back())) {
                const auto& others = next[chain.back()];
                chain.push_back(others[0] == chain[chain.size() - 2] ? others[1] : others[0]);
            }
            for (std::size_t i = 0; i + 1 < chain.size(); ++i)
                result.place[edge_key(chain[i], chain[i + 1])] = {static_cast<Index>(result.arcs.size()),
                                                                  static_cast<Index>(i)};
            result.arcs.push_back(std::move(chain));
        }
    if (result.place.size() == arc_edges_.size()) return result;
    std::vector<Index> closed;
    for (const auto& [edge, unused] : arc_edges_)
        if (!result.place.count(edge)) closed.push_back(edge[0]);
    throw GeometryError("the edges between walls at vertices " + first_few(closed) +
                            " close without a node: the walls there bound no box",
                        "not_a_box", closed);
}

}  // namespace octafield::volume::detail
