// Residual blocks of the Dirichlet energy of a field of vectors (dirichlet_blocks.hpp), reading the field's cache.
#pragma once

#include <ceres/cost_function.h>
#include <ceres/problem.h>

#include <cmath>
#include <utility>
#include <vector>

#include "dirichlet_blocks.hpp"

namespace octafield::volume {

// sum_k coefficients_k a_k over the sites of one block, for one row of coefficients. Residuals: Field::dimension per
// row. Parameters: the blocks of the first site, then those of the next.
template <class Field>
class LinearCombinationCost final : public ceres::CostFunction {
public:
    using Coefficients = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

    // coefficients: (rows, sites.size())
    LinearCombinationCost(const Field& field, std::vector<Index> sites, Coefficients coefficients)
        : field_(field), sites_(std::move(sites)), coefficients_(std::move(coefficients)) {
        set_num_residuals(static_cast<int>(coefficients_.rows()) * Field::dimension);
        for (std::size_t k = 0; k < sites_.size(); ++k)
            for (const int size : Field::block_sizes) mutable_parameter_block_sizes()->push_back(size);
    }

    bool Evaluate(const double* const*, double* residuals, double** jacobians) const override {
        const int rows = static_cast<int>(coefficients_.rows());
        for (int r = 0; r < rows; ++r) {
            typename Field::Vector sum = coefficients_(r, 0) * field_.value(sites_[0]);
            for (std::size_t k = 1; k < sites_.size(); ++k) sum += coefficients_(r, k) * field_.value(sites_[k]);
            Eigen::Map<typename Field::Vector>(residuals + r * Field::dimension) = sum;
        }
        if (!jacobians) return true;
        constexpr int blocks = static_cast<int>(Field::block_sizes.size());
        for (std::size_t k = 0; k < sites_.size(); ++k)
            for (int block = 0; block < blocks; ++block) {
                double* jacobian = jacobians[blocks * k + block];
                if (!jacobian) continue;
                const int size = Field::dimension * Field::block_sizes[block];
                const Eigen::Map<const Eigen::VectorXd> of_site(field_.jacobian(sites_[k], block), size);
                for (int r = 0; r < rows; ++r)
                    Eigen::Map<Eigen::VectorXd>(jacobian + r * size, size) = coefficients_(r, k) * of_site;
            }
        return true;
    }

private:
    const Field& field_;
    std::vector<Index> sites_;
    Coefficients coefficients_;
};

// The energy of `field` times `scale`.
template <class Field>
void add_dirichlet_costs(ceres::Problem& problem, Field& field, const DirichletBlocks& blocks, double scale) {
    using Cost = LinearCombinationCost<Field>;
    const auto add = [&](std::vector<Index> sites, typename Cost::Coefficients coefficients) {
        std::vector<double*> parameters;
        for (const Index v : sites)
            for (int block = 0; block < static_cast<int>(Field::block_sizes.size()); ++block)
                parameters.push_back(field.parameters(v, block));
        problem.AddResidualBlock(new Cost(field, std::move(sites), std::move(coefficients)), nullptr, parameters);
    };
    for (const auto& edge : blocks.edges) {
        const double w = std::sqrt(edge.weight * scale);
        typename Cost::Coefficients coefficients(1, 2);
        coefficients << w, -w;
        add({edge.i, edge.j}, std::move(coefficients));
    }
    for (const auto& tet : blocks.tets)
        add({tet.vertices.begin(), tet.vertices.end()}, std::sqrt(scale) * tet.gradient);
}

}  // namespace octafield::volume
