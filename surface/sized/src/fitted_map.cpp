#include "fitted_map.hpp"

#include <algorithm>

#include "sparse_cholesky.hpp"
#include "vertex_laplacian.hpp"

namespace octafield::surface::detail {
namespace {

constexpr double smoothness = 1e-2;  // of the gradient, against one value
constexpr double least = 1e-12;      // keeps parts without values definite

}  // namespace

Eigen::MatrixXd fitted_map(const Charts& charts, const std::vector<Index>& triangles,
                           const std::vector<Complex>& places, const Eigen::MatrixXd& values) {
    const SurfaceDomain& domain = charts.domain();
    const Index vertices = domain.vertex_count();
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(vertices, values.cols());
    const auto add = [&](Index a, Index b, double value) {
        entries.emplace_back(std::max(a, b), std::min(a, b), value);
    };
    for (Index v = 0; v < vertices; ++v) add(v, v, least);
    const Eigen::VectorXd weights = cotangent_weights(domain).cwiseMax(least);
    for (Index e = 0; e < domain.edge_count(); ++e) {
        const Index a = domain.topology().edges(e, 0), b = domain.topology().edges(e, 1);
        add(a, a, smoothness * weights[e]);
        add(b, b, smoothness * weights[e]);
        add(a, b, -smoothness * weights[e]);
    }
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const Index t = triangles[i];
        std::array<double, 3> part{};
        for (int k = 0; k < 3; ++k) {
            const int next = (k + 1) % 3;
            part[k] = cross(charts.side(t, next), places[i] - charts.corners(t)[next]) / charts.twice_area(t);
        }
        for (int j = 0; j < 3; ++j) {
            const Index a = domain.mesh().triangles(t, j);
            right.row(a) += part[j] * values.row(static_cast<Index>(i));
            for (int k = 0; k <= j; ++k) add(a, domain.mesh().triangles(t, k), part[j] * part[k]);
        }
    }
    Eigen::SparseMatrix<double> matrix(vertices, vertices);
    matrix.setFromTriplets(entries.begin(), entries.end());
    SparseCholesky<double> cholesky(matrix, SparseCholesky<double>::amd_order(matrix));
    if (!cholesky.factorize(matrix))
        throw SolverError("the maps at vertices have no solution to rounding", "not_definite");
    Eigen::MatrixXd result(vertices, values.cols());
    for (Index c = 0; c < values.cols(); ++c) result.col(c) = cholesky.solve(right.col(c));
    return result;
}

}  // namespace octafield::surface::detail
