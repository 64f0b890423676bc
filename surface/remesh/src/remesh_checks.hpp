// What both ways of remeshing ask of their input.
#pragma once

#include "octafield/surface/features.hpp"
#include "octafield/surface/triangle_mesh.hpp"

namespace octafield::surface {

// Throws InvalidInput, GeometryError: the mesh is not valid (it may be open), the features are not of it.
void require_remeshable(const TriangleMesh& mesh, const FeatureGraph& features);

}  // namespace octafield::surface
