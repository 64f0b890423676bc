#include "vertex_laplacian.hpp"

#include <numbers>
#include <string>

namespace octafield::surface::detail {
namespace {

constexpr double thin = 1e-6;  // radians

[[noreturn]] void blame_thin_triangles(const SurfaceDomain& domain) {
    std::vector<Index> triangles;
    for (Index t = 0; t < domain.triangle_count(); ++t)
        if (domain.corner_angles().row(t).minCoeff() < thin) triangles.push_back(t);
    throw SolverError("the stiffness matrix of the surface is not positive definite to rounding: " +
                          std::to_string(triangles.size()) + " triangles (" + first_few(triangles) +
                          ") have angles below 1e-6 radians; remesh the surface",
                      "thin_triangles", triangles);
}

}  // namespace

Eigen::VectorXd cotangent_weights(const SurfaceDomain& domain) {
    Eigen::VectorXd weights = Eigen::VectorXd::Zero(domain.edge_count());
    for (Index t = 0; t < domain.triangle_count(); ++t)
        for (int k = 0; k < 3; ++k)
            weights[domain.topology().triangle_edges(t, k)] += domain.cotangents()(t, (k + 2) % 3) / 2;
    return weights;
}

VertexLaplacian::VertexLaplacian(const SurfaceDomain& domain, const std::vector<bool>& held)
    : domain_(domain), weights_(cotangent_weights(domain)), row_(domain.vertex_count(), -1) {
    Index rows = 0;
    for (Index v = 0; v < domain.vertex_count(); ++v)
        if (!held[v]) row_[v] = rows++;
    if (rows == 0) return;
    std::vector<Eigen::Triplet<double>> entries;
    const Edges& edges = domain.topology().edges;
    for (Index e = 0; e < domain.edge_count(); ++e) {
        const Index a = row_[edges(e, 0)], b = row_[edges(e, 1)];
        if (a >= 0) entries.emplace_back(a, a, weights_[e]);
        if (b >= 0) entries.emplace_back(b, b, weights_[e]);
        if (a >= 0 && b >= 0) entries.emplace_back(std::max(a, b), std::min(a, b), -weights_[e]);
    }
    Eigen::SparseMatrix<double> matrix(rows, rows);
    matrix.setFromTriplets(entries.begin(), entries.end());
    cholesky_ = std::make_unique<SparseCholesky<double>>(matrix, SparseCholesky<double>::amd_order(matrix));
    if (!cholesky_->factorize(matrix)) blame_thin_triangles(domain);
}

Eigen::VectorXd VertexLaplacian::times(const Eigen::VectorXd& u) const {
    Eigen::VectorXd result = Eigen::VectorXd::Zero(u.size());
    const Edges& edges = domain_.topology().edges;
    for (Index e = 0; e < domain_.edge_count(); ++e) {
        const double flux = weights_[e] * (u[edges(e, 0)] - u[edges(e, 1)]);
        result[edges(e, 0)] += flux;
        result[edges(e, 1)] -= flux;
    }
    return result;
}

Eigen::VectorXd VertexLaplacian::solve(const Eigen::VectorXd& right, Eigen::VectorXd values) {
    if (!cholesky_) return values;
    Index rows = 0;
    for (Index v = 0; v < domain_.vertex_count(); ++v)
        if (row_[v] >= 0) {
            values[v] = 0;
            rows = row_[v] + 1;
        }
    for (int refinement = 0; refinement < 2; ++refinement) {
        const Eigen::VectorXd residual = right - times(values);
        Eigen::VectorXd reduced(rows);
        for (Index v = 0; v < domain_.vertex_count(); ++v)
            if (row_[v] >= 0) reduced[row_[v]] = residual[v];
        const Eigen::VectorXd step = cholesky_->solve(reduced);
        for (Index v = 0; v < domain_.vertex_count(); ++v)
            if (row_[v] >= 0) values[v] += step[row_[v]];
    }
    return values;
}

}  // namespace octafield::surface::detail
