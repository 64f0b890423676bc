// What cells and vertices of a mesh made in a domain belong to.
#pragma once

#include <cstdint>
#include <vector>

#include "octafield/volume/mixed_mesh.hpp"
#include "octafield/volume/point_surface.hpp"
#include "octafield/volume/tet_domain.hpp"

namespace octafield::volume {

// Per vertex, the surface's first: 0 inside, 1 on the surface, 2 on a feature curve, 3 a corner.
std::vector<std::uint8_t> vertex_support(const PointSurface& surface, Index vertices);

// Per cell the region: of cells that faces off the interfaces connect, that of the domain where most of their middles
// lie.
std::vector<Index> cell_regions(const TetDomain& domain, const PointSurface& surface, const MixedMesh& mesh);

}  // namespace octafield::volume
