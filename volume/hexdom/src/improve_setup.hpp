// What improve_cells makes of its input before the first vertex moves.
#pragma once

#include <memory>
#include <vector>

#include "octafield/volume/cell_quality.hpp"
#include "surface_guide.hpp"
#include "vertex_star.hpp"

namespace octafield::volume::detail {

// Throw InvalidInput: kinds "option_out_of_range", "wrong_size", "non_finite_vertex".
void require_options(const ImproveOptions& options);
void require_vertices(const MixedMesh& mesh, const VertexSupport& support);

// Null if no vertex slides. Throws InvalidInput: "no_surface", "no_features", those of SurfaceGuide.
std::unique_ptr<SurfaceGuide> guide_for(const VertexSupport& support, const surface::TriangleMesh& surface,
                                        const surface::FeatureGraph& features);

// What lies on a curve may not leave it for either side, nor a corner for a curve, whatever it is called.
VertexSupport settled(VertexSupport support, const Points& vertices, const SurfaceGuide& guide, double tolerance,
                      int threads);

// The vertices that move in groups, so that no two of a cell share one, each in the first that can take it.
std::vector<std::vector<Index>> colours(const MixedMesh& mesh, const VertexCells& cells, const VertexSupport& support);

}  // namespace octafield::volume::detail
