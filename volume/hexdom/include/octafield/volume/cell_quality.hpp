// Positive Jacobians all through cells, proven, and vertices moved for better cells.
#pragma once

#include <cstdint>
#include <vector>

#include "octafield/surface/features.hpp"
#include "octafield/volume/mixed_mesh.hpp"

namespace octafield::volume {

// Per cell, 1: the Jacobian of the map from the reference cell (trilinear hexahedron, wedge, cone over a bilinear quad)
// is above 0 everywhere in it, but for a pyramid's apex, by coefficients of Bernstein polynomials, the cell halved
// until they tell (Johnen, Remacle, Geuzaine 2013); what doubles round is allowed for. 0: it is not (coordinates that
// are not finite included), or nothing was proven within `depth` halvings of each side, 0 to 20. Throws GeometryError
// (kind "index_out_of_range"), InvalidInput ("depth_out_of_range").
std::vector<std::uint8_t> proven_positive(const MixedMesh& mesh, int depth = 8, int threads = 0);

// Where vertices may go: anywhere, along the patch of the surface nearest at the start (its triangles between feature
// edges), along the curve nearest at the start (feature edges between corners), nowhere. Vertices of kind surface that
// lie on a curve stay on it, those of kind surface or curve at a corner stay there.
struct VertexSupport {
    enum class Kind : std::uint8_t { inside, surface, curve, fixed };
    std::vector<Kind> kind;  // (n)
};

struct ImproveOptions {
    // At most, half of them to smooth, half to raise, too. Where nothing moves any more vertices are left out.
    int sweeps = 20;
    // Scaled Jacobians below are raised, at the cost of better ones next to them, and smoothing lets none fall below.
    // Of tets few meshes reach 0.5 all over: asking for more than there can be makes many cells as poor as the poorest.
    double good = 0.3;
    // How far surface vertices may leave the surface, input unit.
    double tolerance = 0;
    // At the end vertices of kind surface move within `tolerance`, so that the faces between them fit the surface in
    // the least-squares sense and cut off as much volume as they add.
    bool fit_surface = false;
    // Qualities of wedges count as half as much again, those of tets and pyramids as 2.5 times as high, and theirs is a
    // fifth and a hundredth of the share in what is smoothed: hexahedra keep their shape where they meet others. The
    // lowest scaled Jacobian, so counted, does not fall below `good`.
    bool hexahedra_first = false;
    int threads = 0;
};

// Moves vertices so that the whole gets smoother (inverse mean ratio; Knupp 2001), and so that the lowest quality round
// each rises (as scaled_jacobians takes it, of inverted corners, too; Freitag, Ollivier-Gooch 1997). If all cells are
// positive, they stay so, and the lowest scaled Jacobian does not fall (by more than 1e-12); if not, as many as can be
// are made positive by single moves (Freitag, Plassmann 2000). Vertices on surface and curves stay on their pieces;
// those that start farther away than `tolerance` are brought there as far as their cells allow, nearer ones keep their
// distance. Deterministic; linear in the cells per sweep. Throws InvalidInput: kinds "wrong_size" (of support),
// "index_out_of_range", "non_finite_vertex", "no_surface", "no_features" (where vertices shall slide on what is not
// there), "option_out_of_range"; GeometryError "index_out_of_range" (cells).
MixedMesh improve_cells(MixedMesh mesh, const VertexSupport& support, const surface::TriangleMesh& surface,
                        const surface::FeatureGraph& features, const ImproveOptions& options = {});

}  // namespace octafield::volume
