// Residual blocks of the Dirichlet energy of an embedded field (dirichlet_blocks.hpp), reading EmbeddedField's cache.
#pragma once

#include <ceres/cost_function.h>

#include "dirichlet_blocks.hpp"
#include "embedded_field.hpp"

namespace octafield::volume {

// sum_k coefficients_k a_k over the vertices of one block, for one row of coefficients. Residuals: R::dimension per
// row.
template <frames::Representation R>
class LinearCombinationCost final : public ceres::CostFunction {
public:
    using Coefficients = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

    // coefficients: (rows, vertices.size())
    LinearCombinationCost(const EmbeddedField<R>& field, std::vector<Index> vertices, Coefficients coefficients)
        : field_(field), vertices_(std::move(vertices)), coefficients_(std::move(coefficients)) {
        set_num_residuals(static_cast<int>(coefficients_.rows()) * R::dimension);
        mutable_parameter_block_sizes()->assign(vertices_.size(), 4);
    }

    bool Evaluate(const double* const*, double* residuals, double** jacobians) const override {
        const int rows = static_cast<int>(coefficients_.rows());
        for (int r = 0; r < rows; ++r) {
            typename R::Vector sum = coefficients_(r, 0) * field_.value(vertices_[0]);
            for (std::size_t k = 1; k < vertices_.size(); ++k) sum += coefficients_(r, k) * field_.value(vertices_[k]);
            Eigen::Map<typename R::Vector>(residuals + r * R::dimension) = sum;
        }
        if (!jacobians) return true;
        for (std::size_t k = 0; k < vertices_.size(); ++k) {
            if (!jacobians[k]) continue;
            for (int r = 0; r < rows; ++r)
                Eigen::Map<typename EmbeddedField<R>::Jacobian>(jacobians[k] + 4 * r * R::dimension) =
                    coefficients_(r, k) * field_.jacobian(vertices_[k]);
        }
        return true;
    }

private:
    const EmbeddedField<R>& field_;
    std::vector<Index> vertices_;
    Coefficients coefficients_;
};

}  // namespace octafield::volume
