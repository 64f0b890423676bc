// The cotangent stiffness matrix of P1 elements, some vertices held.
#pragma once

#include <memory>
#include <vector>

#include "octafield/surface/surface_domain.hpp"
#include "sparse_cholesky.hpp"

namespace octafield::surface::detail {

// (E) half the sum of the cotangents opposite.
Eigen::VectorXd cotangent_weights(const SurfaceDomain& domain);

class VertexLaplacian {
public:
    // Vertices in no triangle are to be held. Throws SolverError (kind "thin_triangles", elements).
    VertexLaplacian(const SurfaceDomain& domain, const std::vector<bool>& held);

    // u with L u = right where nothing is held, and u = values where something is. One step of iterative refinement.
    Eigen::VectorXd solve(const Eigen::VectorXd& right, Eigen::VectorXd values);
    // L u, whether held or not.
    Eigen::VectorXd times(const Eigen::VectorXd& u) const;

private:
    SurfaceDomain domain_;
    Eigen::VectorXd weights_;
    std::vector<Index> row_;                            // (V), -1: held
    std::unique_ptr<SparseCholesky<double>> cholesky_;  // none where all is held
};

}  // namespace octafield::surface::detail
