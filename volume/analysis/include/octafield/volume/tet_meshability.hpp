// Whether a hex mesh can exist round a frame field that lives in the tets: meshability.hpp and boundary_meshability.hpp
// for it, NECESSARY conditions only.
#pragma once

#include "octafield/volume/boundary_meshability.hpp"
#include "octafield/volume/meshability.hpp"
#include "octafield/volume/tet_singularities.hpp"

namespace octafield::volume {

// singular: singular_edges(mesh, of_tets). surface: of the mesh, boundary_surface or that of region_surface; features
// of it. Vertices where curves end, as points of singular.graph: on the boundary away from features one curve alone may
// end, about the normal; what may end on features, boundary_meshability counts, here they must only be of a valence
// that hex meshes have. Throws InvalidInput where sizes do not fit together, GeometryError (unsound mesh).
Meshability tet_meshability(const TetDomain& domain, const Quaternions& of_tets, const SingularEdges& singular);

// hexahedra_a, hexahedra_b and around of a wedge are one number, by the frame of its first tet carried through its tets
// to the last; no_number where another of its axes is nearest to the edge there, as where a singular curve runs into
// it. Crossings: smooth edges of the surface where the axis on one normal, carried through the tets between, is not the
// one on the other. Throws InvalidInput, GeometryError (unsound mesh).
BoundaryMeshability tet_boundary_meshability(const TetDomain& domain, const Quaternions& of_tets, int threads = 0);

}  // namespace octafield::volume
