// Edge lengths of a refined surface whose triangles are parts of another one's.
#pragma once

#include "ringed_mesh.hpp"

namespace octafield::surface::detail {

// The domain of the refined mesh, by the lengths that its edges have in the triangles of the input; as in space where
// the input has no lengths of its own.
SurfaceDomain measured_alike(const SurfaceDomain& input, const RingedMesh& refined, SurfaceDomain domain);

}  // namespace octafield::surface::detail
