// Places all over a surface.
#pragma once

#include "octafield/surface/surface_domain.hpp"

namespace octafield::surface::detail {

// Up to `count` triangles: the one farthest from the boundary first, then in turn the one farthest from the boundary
// and from those before it, along ways from centre to centre over edges. Near linear.
std::vector<Index> far_triangles(const SurfaceDomain& domain, int count);

}  // namespace octafield::surface::detail
