// How large a refined mesh would be.
#pragma once

#include <cstdint>
#include <vector>

#include "octafield/volume/tet_domain.hpp"

namespace octafield::volume {

// Tets that refine_tets (refine_tets.hpp) makes of the marked ones, their neighbours and the rest. Neighbours may be
// far more than what is marked.
std::int64_t refined_count(const TetDomain& domain, const std::vector<std::uint8_t>& marked);

}  // namespace octafield::volume
