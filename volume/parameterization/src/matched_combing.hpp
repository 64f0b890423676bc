// Combing by matchings that are given, where they are not the nearest ones of the frames.
#pragma once

#include "octafield/volume/combing.hpp"

namespace octafield::volume {

// As comb. matching: (rows of domain.triangles()) from the tet on the first side to that on the second, 0 on the
// boundary.
CombedField comb_matched(const TetDomain& domain, const Quaternions& of_tets, std::vector<std::uint8_t> matching,
                         int threads);

}  // namespace octafield::volume
