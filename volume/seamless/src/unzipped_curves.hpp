// Singular curves that turn back against their axis, led to the surface as two curves of one type each.
#pragma once

#include <cstdint>
#include <vector>

#include "edge_matchings.hpp"

namespace octafield::volume::detail {

struct UnzippedCurves {
    int turns = 0;                     // places where curves went on with another type
    int mended = 0;                    // of these, how many are no more
    std::vector<std::uint8_t> near{};  // (m) 1 for tets near the axes from those that are left, where there are any
};

// Five hexahedra round one part of a curve and three round the other: no hex mesh has that (a zipper node; Liu, Bommes
// 2023). Where the curve turns against its axis, a ribbon from there along the axis to the surface gets a quarter turn
// about the axis across it; so the two parts go on along its sides and end on the surface. Frames near it are smoothed
// with the matchings held, those on the surface about their normals, those on features not at all. Ribbons that would
// cross features or other curves are not made.
UnzippedCurves unzip_curves(const TetDomain& domain, Quaternions& frames, EdgeMatchings& matchings);

}  // namespace octafield::volume::detail
