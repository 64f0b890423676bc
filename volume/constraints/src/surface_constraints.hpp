// Constraints on a surface whose vertices are sites of a field: what boundary_constraints does for that of a domain.
#pragma once

#include "octafield/volume/axes_stretch.hpp"

namespace octafield::volume {

SectorNormals sector_normals_of(const surface::TriangleMesh& surface, const surface::FeatureGraph& features);

// vertex_count: of the tet mesh, whose ids vertex_map holds. stretch: none, or a row per vertex of the tet mesh.
BoundaryConstraints constraints_on_surface(Index vertex_count, const BoundarySurface& surface,
                                           const surface::FeatureGraph& features, const Points& directions,
                                           const BoundaryOptions& options, const Stretches* stretch = nullptr);

}  // namespace octafield::volume
