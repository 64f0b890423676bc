// How far a frame field is from the gradients of a map: jumps across faces, and the twist of its axes.
#pragma once

#include "octafield/volume/tet_domain.hpp"

namespace octafield::volume {

// Per-tet frames: those nearest to the mean sh4 vector of the four vertices.
//
// Jump of a face between two tets, after matching their frames: J = P (R_s o - R_t), P the projection onto the face;
// its Frobenius norm, the root of the sum over the three axes of the squared jump of the tangential component, as in
// integrability terms on piecewise constant frames (Nieser, Reitebuch, Polthier 2011; Vekhter et al., MINT, 2025). It
// is 0 where the axes are gradients of one continuous, piecewise linear map. On a smooth field it is of the order of
// the mesh width, whether that field is integrable or not: compare on one mesh only.
//
// Twist of a tet: t_i = n_i . curl n_i for the axes n_1..3 interpolated linearly from the vertices, n_i in front that
// of the tet's frame; the root of the sum of their squares. By Frobenius' theorem surfaces orthogonal to n_i exist
// where t_i = 0, and t_i = -n_i . [n_j, n_k]: the part of the Lie bracket (Beaufort 2019, conclusion, section 2) that
// no scaling of the axes by positive factors removes. All three vanish for the normalised gradients of any map with
// orthogonal gradients (unit axes without any curl would be constant). It converges to a limit that measures the field
// and not the mesh; near a singular curve that limit may grow like 1 over the distance.
struct Integrability {
    double jump_rms = 0, jump_max = 0;    // over interior faces, weighted by area; pure numbers, at most sqrt(6)
    double twist_rms = 0, twist_max = 0;  // over tets, weighted by volume; 1 / input unit
    Eigen::VectorXd twist;                // (m) per tet
};

// frames: (n, 4) unit quaternions w x y z. Near linear; the same bits at any thread count. Throws InvalidInput and
// GeometryError (unsound mesh).
Integrability integrability(const TetDomain& domain, const Quaternions& frames, int threads = 0);

// (m, 4) unit quaternions w x y z: the frame nearest to the mean sh4 vector of each tet's vertices.
Quaternions tet_frames(const TetDomain& domain, const Quaternions& frames, int threads = 0);

}  // namespace octafield::volume
