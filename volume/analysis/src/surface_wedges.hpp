// The wedges of tets between neighbouring triangles of a surface in a tet mesh.
#pragma once

#include <utility>
#include <vector>

#include "octafield/volume/tet_domain.hpp"

namespace octafield::volume {

// From the triangle (a, b, link.front()) through tets to the triangle (a, b, link.back()), positive about b - a.
struct Wedge {
    Index a, b;               // tet-mesh ids, a < b
    std::vector<Index> link;  // tet-mesh ids; consecutive ones share a tet with a and b
    std::vector<Index> tets;  // these, one less
};

// Those at the given edges (tet-mesh ids, lower first; sorted). Ordered by a, b, and the first triangle.
std::vector<Wedge> surface_wedges(const TetDomain& domain,
                                  const std::vector<std::pair<Index, Index>>& edges, int threads);

}  // namespace octafield::volume
