// One triangle cut by chords.
#pragma once

#include "cut_surface.hpp"

namespace octafield::surface::detail {

// A node round a triangle or polygon, counter-clockwise.
struct RingNode {
    Index node;
    bool cut_after;  // whether the side to the next one is along a curve or the boundary
};

// Between two nodes of the ring.
struct Chord {
    Index curve;
    Index from, to;
    double first_length, last_length;  // along the curve
};

// The polygons. Appends a node to `positions` for each pair of chords whose ends alternate round the ring, and the
// crossings of each chord, in its order, to `in_between` of its curve, with increasing lengths.
std::vector<std::vector<RingNode>> cut_triangle(const std::vector<RingNode>& ring, const std::vector<Chord>& chords,
                                                std::vector<Eigen::Vector3d>& positions,
                                                std::vector<std::vector<CurveNode>>& in_between);

}  // namespace octafield::surface::detail
