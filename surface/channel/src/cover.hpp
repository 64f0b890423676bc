// The channel between outline and mesh inside, covered by patches and these by templates.
#pragma once

#include "inside_mesh.hpp"
#include "patch_filler.hpp"
#include "plane_quads.hpp"

namespace octafield::surface::detail {

// All quads, some of which may be bad; vertices: those of the outline, then of the mesh inside, then new ones. The
// segments of the outline are locked, the quads inside kept.
PlaneQuads covered(const Outline& outline, const InsideMesh& inside, const PatchFiller& filler);

}  // namespace octafield::surface::detail
