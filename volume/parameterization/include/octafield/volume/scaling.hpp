// Sizes along the axes of a frame field for which they are closest to the gradients of a map.
#pragma once

#include "octafield/volume/tet_domain.hpp"

namespace octafield::volume {

// A map whose coordinates have the gradients h_i n_i, n_i the unit axes, exists locally where curl(h_i n_i) =
// h_i (grad H_i x n_i + curl n_i) is 0, H_i = log h_i. h_i is the density of its grid along axis i, 1 / h_i the size of
// a cell, each up to a constant. Beaufort (2019), conclusion, section 2, (5.5) to (5.7), has the plane, where one H for
// both axes takes all of the curl away: n_1 = (cos a, sin a) gives grad H = (-a_y, a_x), that is grad a = grad H x n,
// as (5.5) reads; for lengths of tangent vectors, 1 / h_i, the sign is the other. In space most fields leave something:
// n_i . curl n_i (the twist of integrability.hpp) in any case.

// What is left of the curl: per tet the root of sum_i |grad H_i x n_i + curl n_i|^2, with the axes of the vertices
// matched to the tet's frame (tet_frames) and interpolated linearly. It tends to a limit that measures the field. And
// the jump of integrability.hpp for the axes h_i n_i, h_i of the tet's centre, each axis's divided by its mean length
// on both sides: of the order of the mesh width for any h, and as a rule larger than that of unit axes, since h changes
// too.
struct ScaledIntegrability {
    double curl_rms = 0, curl_max = 0;  // over tets, weighted by volume; 1 / input unit
    double jump_rms = 0, jump_max = 0;  // over interior faces, weighted by area; pure numbers
    Eigen::VectorXd curl;               // (m) per tet
};

// One H for all three axes: minimises the integral of the squared curl over continuous, piecewise linear H. Since
// n x curl n = -(n . grad) n for unit n, that is |grad H - g|^2 with g = 1/2 sum_i (n_i . grad) n_i but for a constant:
// a Poisson problem with natural boundary conditions.
struct IsotropicScale {
    Eigen::VectorXd log_scale;  // (n) H at the vertices, of mean 0 in each part of the mesh; 0 at vertices of no tet
    ScaledIntegrability before, after;
    Index parts = 0;
    int iterations = 0;  // of conjugate gradients
};
// frames: (n, 4) unit quaternions w x y z, one per vertex. Near linear; the same bits at any thread count. Throws
// InvalidInput, GeometryError (unsound mesh), SolverError.
IsotropicScale isotropic_scale(const TetDomain& domain, const Quaternions& frames, int threads = 0);

struct AxisScaleOptions {
    // eps, in (0, 1]: weight of the change of H_i along its own axis, which no curl sees: a new parameter on the same
    // grid lines. Below 0.1 the curl hardly falls any further, and H_i follows errors of the mesh width
    // (docs/analysis.md).
    double along = 0.1;
    int threads = 0;
};

// One H_i per axis: minimises the integral of sum_i |P_i (grad H_i - (n_i . grad) n_i)|^2 + eps (n_i . grad H_i)^2, P_i
// the projection orthogonal to n_i. The axes at a vertex are those of the tets round it, identified by the matchings
// between them; so no cut is needed, and axes that a singular curve exchanges share one unknown on it.
struct AxisScales {
    Eigen::VectorXd values;    // (k) H per unknown, of mean 0 in each set of axes that matchings connect
    Rows<Index, 12> unknowns;  // (m, 12) column 3 c + i: the unknown of axis i of the tet's frame at its corner c
    Points log_scales;         // (m, 3) H_i at the centre, for the axes of the tet's frame
    Quaternions of_tets;       // (m, 4) that frame
    ScaledIntegrability before, after;
    Index parts = 0;  // sets of axes: three per part of the mesh, less where singular curves exchange them
    int iterations = 0;
};
// As isotropic_scale.
AxisScales axis_scales(const TetDomain& domain, const Quaternions& frames, const AxisScaleOptions& options = {});

}  // namespace octafield::volume
