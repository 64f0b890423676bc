// Where the frames of a field live and how they are coupled: all that the solvers need to know of a mesh.
#pragma once

#include <memory>

#include "octafield/volume/operators.hpp"
#include "octafield/volume/tet_mesh.hpp"

namespace octafield::volume {

enum class Sites { vertices, tets };

// One frame per site. Made by vertex_sampling or tet_sampling; functions that take a TetMesh where they could take a
// Sampling mean the one at its vertices.
struct Sampling {
    Sites sites = Sites::vertices;
    SparseMatrix stiffness;   // L (n, n), symmetric, rows sum to 0: E = 1/2 sum_c a_c^T L a_c; row 0: of no tet
    Eigen::VectorXd mass;     // (n) lumped, cubed input unit
    double body_radius = 0;   // 3 volume / boundary area: the radius, for a ball
    double spacing = 0;       // of neighbouring sites: the mean boundary edge; of tets, see tet_sampling
    double box_diagonal = 0;  // of the mesh
    // The mesh whose linear elements L is of. None: L is a sum over pairs of sites alone, no entry off its diagonal is
    // positive.
    std::shared_ptr<const TetMesh> elements;

    Index count() const { return static_cast<Index>(mass.size()); }
};

// At the vertices: linear elements (operators.hpp). Throws GeometryError (unsound mesh).
Sampling vertex_sampling(const TetMesh& mesh);

// Same energy as above, but for rounding, of frames at any sites. frames: (n, 4) unit quaternions w x y z. The same
// bits at any thread count. Throws InvalidInput.
double dirichlet_energy(const Sampling& sampling, const Quaternions& frames, int threads = 0);

}  // namespace octafield::volume
