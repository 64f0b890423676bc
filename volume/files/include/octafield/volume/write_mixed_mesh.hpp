// Meshes of mixed cells and surfaces of quads, with their scaled Jacobians, for ParaView, pyvista, meshio.
#pragma once

#include "octafield/volume/mixed_mesh.hpp"
#include "octafield/volume/write_vtk.hpp"

namespace octafield::volume {

// .vtu, cells in the order of their numbers, with cell data scaled_jacobian. Throws IoError, and GeometryError (kind
// "index_out_of_range", naming cells) before anything is written.
void write_mixed_mesh(const std::filesystem::path& path, const MixedMesh& mesh, const Metadata& metadata = {});
void write_quad_mesh(const std::filesystem::path& path, const surface::QuadMesh& mesh, const Metadata& metadata = {});

}  // namespace octafield::volume
