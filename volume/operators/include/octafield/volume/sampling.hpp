// Where the frames of a field live and how they are coupled: all that the solvers need to know of a mesh.
#pragma once

#include <memory>

#include "octafield/volume/operators.hpp"
#include "octafield/volume/tet_domain.hpp"

namespace octafield::volume {

enum class Sites { vertices, tets };

// One frame per site. Made by vertex_sampling or tet_sampling; where a function takes a Sampling, a domain stands for
// the one at its vertices.
struct Sampling {
    Sampling() = default;
    Sampling(const TetDomain& domain);
    Sampling(const TetMesh& mesh) : Sampling(TetDomain(mesh)) {}

    Sites sites = Sites::vertices;
    SparseMatrix stiffness;  // L (n, n), symmetric, rows sum to 0: E = 1/2 sum_c a_c^T L a_c; row 0: of no tet
    Eigen::VectorXd mass;    // (n) lumped, cubed input unit
    double body_radius = 0;  // 3 volume / boundary area: the radius, for a ball
    double edge_length = 0;  // mean, of the boundary
    double size = 0;         // of the boundary: surface::shape_size
    // The mesh whose linear elements L is of. None: L is a sum over pairs of sites alone, no entry off its diagonal is
    // positive.
    std::shared_ptr<const TetMesh> elements;

    Index count() const { return static_cast<Index>(mass.size()); }
};

// At the vertices: linear elements (operators.hpp). Throws GeometryError (unsound mesh).
Sampling vertex_sampling(const TetDomain& domain);

// In the tets: E = 1/2 sum over interior triangles of w |a_s - a_t|^2, w = area / distance between the centroids of the
// two tets (the orthogonal correction of Jasak 1996, section 3.3.1.3). Such two-point fluxes are not consistent on
// general tets: energies do not tend to those of the continuous field, but to what docs/tet_meshes.md measures. Mass:
// the volumes. Throws GeometryError (unsound mesh).
Sampling tet_sampling(const TetDomain& domain);

// (n, 4) unit quaternions w x y z at the vertices: the frame nearest to the mean sh4 vector, weighted by volume, of the
// tets round each; the identity at vertices of no tet. tet_frames (integrability.hpp) goes the other way. of_tets:
// (m, 4). Throws InvalidInput, GeometryError.
Quaternions vertex_frames(const TetDomain& domain, const Quaternions& of_tets, int threads = 0);

// 1/2 sum_c a_c^T L a_c, a the sh4 vectors: at vertices the energy of operators.hpp, but for rounding. frames: (n, 4)
// unit quaternions w x y z. The same bits at any thread count. Throws InvalidInput.
double dirichlet_energy(const Sampling& sampling, const Quaternions& frames, int threads = 0);

}  // namespace octafield::volume
