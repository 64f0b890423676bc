// The tets round an edge in the order in which they lie, with axes carried from one to the next.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "edge_loops.hpp"

namespace octafield::volume {

// Axis numbers (axis_numbers.hpp), in the frame of a fan's first tet, of another tet's axes 0, 1, 2.
using CarriedAxes = std::array<std::uint8_t, 3>;

struct FanTet {
    Index tet;
    CarriedAxes axes;
    Index entry, exit;  // rows of the triangle table: through which the way round a -> b enters and leaves the tet
};

struct EdgeFan {
    Index a, b;  // a < b
    std::vector<FanTet> tets;
    bool closed;
    CarriedAxes round;  // closed: the axis of the first tet that comes back as its axis i; else i
    bool returns(int axis) const { return round[axis] == axis; }
};

// The fans at one edge, whose tets are given: one, or several that touch in the edge alone. Closed ones begin at their
// lowest tet, others at the boundary. matching: of triangle_matchings.
void edge_fans(std::span<const TetAtEdge> tets, const TriangleTable& table, const std::vector<std::uint8_t>& matching,
               std::vector<EdgeFan>& fans);

// Calls use(fan) for all edges in order.
template <class Use>
void for_each_fan(const std::vector<TetAtEdge>& tets, const TriangleTable& table,
                  const std::vector<std::uint8_t>& matching, const Use& use) {
    std::vector<EdgeFan> fans;
    for (std::size_t first = 0, last; first < tets.size(); first = last) {
        for (last = first + 1; last < tets.size() && tets[last].a == tets[first].a && tets[last].b == tets[first].b;)
            ++last;
        fans.clear();
        edge_fans({&tets[first], last - first}, table, matching, fans);
        for (const EdgeFan& fan : fans) use(fan);
    }
}

}  // namespace octafield::volume
