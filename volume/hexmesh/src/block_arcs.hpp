// Edges where blocks end: arcs between nodes.
#pragma once

#include <array>
#include <map>
#include <vector>

#include "block_charts.hpp"

namespace octafield::volume::detail {

using EdgeKey = std::array<Index, 2>;  // vertex ids, lower first

// A wall as the tet on one of its sides has it.
struct WallSide {
    Index triangle;  // row of the triangle table
    int side;        // 0, 1
};

// What is the same of two walls that lie in one plane across an edge: the block's vertices and the side of its box.
struct SeenEdge {
    Index first, second;
    int box_side;
    bool operator==(const SeenEdge& o) const {
        return first == o.first && second == o.second && box_side == o.box_side;
    }
};

class WallEdges {
public:
    WallEdges(const SeamlessMap& map, const TriangleTable& table, const BlockCharts& charts);

    // Walls at an edge, rows of the table.
    const std::map<EdgeKey, std::vector<Index>>& walls() const { return walls_; }
    // Where more than two walls meet, or two that are not in one plane.
    bool on_arc(const EdgeKey& edge) const { return arc_edges_.count(edge) != 0; }
    SeenEdge seen(WallSide wall, const EdgeKey& edge) const;
    Index block_vertex(WallSide wall, Index vertex) const;

    // Chains of arc edges from node to node; `place` has for each edge its arc and its position from the arc's start.
    struct Chains {
        std::vector<Index> nodes;
        std::vector<std::vector<Index>> arcs;
        std::map<EdgeKey, std::pair<Index, Index>> place;
    };
    Chains chains(const std::vector<Index>& corners) const;

private:
    const SeamlessMap& map_;
    const TriangleTable& table_;
    const BlockCharts& charts_;
    std::map<EdgeKey, std::vector<Index>> walls_;
    std::map<EdgeKey, char> arc_edges_;
};

inline EdgeKey edge_key(Index a, Index b) { return a < b ? EdgeKey{a, b} : EdgeKey{b, a}; }

}  // namespace octafield::volume::detail
