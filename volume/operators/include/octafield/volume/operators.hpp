// P1 finite-element operators on tets, and the Dirichlet energy every table reports.
#pragma once

#include <Eigen/SparseCore>

#include "octafield/volume/tet_domain.hpp"

namespace octafield::volume {

using SparseMatrix = Eigen::SparseMatrix<double>;  // column-major

// (n, n): int grad phi_i . grad phi_j; symmetric, signed cotangents, rows sum to 0
SparseMatrix stiffness(const TetDomain& domain);
SparseMatrix mass(const TetDomain& domain);            // (n, n): int phi_i phi_j
Eigen::VectorXd lumped_mass(const TetDomain& domain);  // (n): a quarter of the volume of the incident tets

// E = 1/2 sum_c a_c^T L a_c, a the sh4 vectors of the frames, L the stiffness: the convention of every table. Unit
// speed: 3/20 E. frames: (n, 4) unit quaternions w x y z. The same bits at any thread count.
double dirichlet_energy(const TetDomain& domain, const Quaternions& frames, int threads = 0);
inline double dirichlet_energy(const TetMesh& mesh, const Quaternions& frames, int threads = 0) {
    return dirichlet_energy(TetDomain(mesh), frames, threads);
}
constexpr double unit_speed_factor = 3.0 / 20.0;

}  // namespace octafield::volume
