// Points of a lattice in the coordinates of a periodic map, each once.
#pragma once

#include <vector>

#include "map_charts.hpp"

namespace octafield::volume {

class LatticePoints {
public:
    // Those whose coordinates are integers plus `offset` (in units of the map), in all usable tets.
    LatticePoints(const MapCharts& charts, std::int32_t offset);

    Index count() const { return static_cast<Index>(place_.size()); }
    // A tet it is in, the lowest, and its coordinates there.
    const Place& place(Index point) const { return place_[point]; }
    // The point at a place of a tet; -1: none.
    Index find(const Place& place) const;

private:
    std::int64_t find_node(Index tet, const Coordinate& at) const;
    void enumerate(const MapCharts& charts, std::int32_t offset);

    std::vector<std::int64_t> begin_;  // of each tet's nodes
    std::vector<Coordinate> at_;       // of each node, in its tet
    std::vector<std::uint8_t> zero_;   // of each node: bit k where its weight of corner k is 0
    std::vector<Index> point_;         // of each node
    std::vector<Place> place_;
};

}  // namespace octafield::volume
