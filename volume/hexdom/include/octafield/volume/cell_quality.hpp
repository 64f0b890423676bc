// Positive Jacobians all through cells, proven, and vertices moved for better cells.
#pragma once

#include <cstdint>
#include <vector>

#include "octafield/surface/features.hpp"
#include "octafield/volume/mixed_mesh.hpp"

namespace octafield::volume {

// Per cell, 1: the Jacobian of the map from the reference cell (trilinear hexahedron, wedge, cone over a bilinear quad) is
// above 0 everywhere in it, by coefficients of Bernstein polynomials, the cell halved until they tell. 0: it is not, or
// nothing was proven within the depth.
std::vector<std::uint8_t> proven_positive(const MixedMesh& mesh, int depth = 8, int threads = 0);

// Where vertices may go.
struct VertexSupport {
    enum class Kind : std::uint8_t { inside, surface, curve, fixed };
    std::vector<Kind> kind;  // (n)
};

struct ImproveOptions {
    int sweeps = 20;
    double tolerance = 0;  // how far surface vertices may leave the surface, input unit
    int threads = 0;
};

// Moves vertices so that the lowest quality round each rises (scaled Jacobian; untangles what is inverted), then so that the
// whole gets smoother; what is positive stays so. Surface vertices slide on `surface`, those on curves along its feature edges.
MixedMesh improve_cells(MixedMesh mesh, const VertexSupport& support, const surface::TriangleMesh& surface,
                        const surface::FeatureGraph& features, const ImproveOptions& options = {});

}  // namespace octafield::volume
