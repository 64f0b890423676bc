// Chains segments between points into maximal curves.
#pragma once

#include <cstdint>
#include <vector>

#include "octafield/arrays.hpp"

namespace octafield::volume {

struct Segment {
    Index ends[2];
    int type;
};

struct CurveSet {
    std::vector<std::vector<Index>> curves;  // point ids; closed ones repeat the first id
    std::vector<int> types;
};

// Every segment lies in exactly one curve. Curves end at points where other than two segments meet or the type changes.
// In the order of their first points; closed ones without such a point come last, from their lowest segment. Linear.
// ends: per point, 1: curves end here in any case; empty: none.
CurveSet chain_segments(const std::vector<Segment>& segments, Index point_count,
                        const std::vector<std::uint8_t>& ends = {});

}  // namespace octafield::volume
