// Symmetric matrices of the unknowns of a map, from blocks of single tets.
#pragma once

#include <Eigen/SparseCore>
#include <algorithm>
#include <memory>

#include "octafield/parallel.hpp"
#include "sparse_cholesky.hpp"
#include "unfolded_tets.hpp"

namespace octafield::volume::detail {

using Matrix12 = Eigen::Matrix<double, 12, 12>;
using Vector12 = Eigen::Matrix<double, 12, 1>;

class TetAssembly {
public:
    explicit TetAssembly(const TetProblem& problem) : tets_(problem.corners.rows()) {
        std::vector<Eigen::Triplet<double>> entries;
        for (Index i = 0; i < problem.free.count; ++i) entries.emplace_back(i, i, 0.0);
        for (std::size_t t = 0; t < tets_.size(); ++t) {
            Local& local = tets_[t];
            for (int j = 0; j < 12; ++j)
                for (const auto& entry : row(problem, t, j)) local.unknowns.push_back(entry.first);
            std::sort(local.unknowns.begin(), local.unknowns.end());
            local.unknowns.erase(std::unique(local.unknowns.begin(), local.unknowns.end()), local.unknowns.end());
            local.by = Eigen::MatrixXd::Zero(12, static_cast<Index>(local.unknowns.size()));
            for (int j = 0; j < 12; ++j)
                for (const auto& [unknown, c] : row(problem, t, j))
                    local.by(j, std::lower_bound(local.unknowns.begin(), local.unknowns.end(), unknown) -
                                    local.unknowns.begin()) = c;
            for (std::size_t i = 0; i < local.unknowns.size(); ++i)
                for (std::size_t j = 0; j <= i; ++j) entries.emplace_back(local.unknowns[i], local.unknowns[j], 0.0);
        }
        matrix_.resize(problem.free.count, problem.free.count);
        matrix_.setFromTriplets(entries.begin(), entries.end());
        for (Local& local : tets_)
            for (std::size_t i = 0; i < local.unknowns.size(); ++i)
                for (std::size_t j = 0; j <= i; ++j) {
                    const int* first = matrix_.innerIndexPtr() + matrix_.outerIndexPtr()[local.unknowns[j]];
                    const int* last = matrix_.innerIndexPtr() + matrix_.outerIndexPtr()[local.unknowns[j] + 1];
                    local.places.push_back(
                        static_cast<Index>(std::lower_bound(first, last, local.unknowns[i]) - matrix_.innerIndexPtr()));
                }
        if (problem.free.count > 0)
            cholesky_ = std::make_unique<surface::detail::SparseCholesky<double>>(
                matrix_, surface::detail::SparseCholesky<double>::metis_order(matrix_));
    }

    void clear() {
        std::fill(matrix_.valuePtr(), matrix_.valuePtr() + matrix_.nonZeros(), 0.0);
        gradient_ = Eigen::VectorXd::Zero(matrix_.cols());
    }
    // By the 12 coordinates of the tet's corners.
    void add(std::size_t t, const Vector12& first, const Matrix12& second) {
        const Local& local = tets_[t];
        const Eigen::MatrixXd block = local.by.transpose() * second * local.by;
        const Eigen::VectorXd slope = local.by.transpose() * first;
        std::size_t at = 0;
        for (std::size_t i = 0; i < local.unknowns.size(); ++i) {
            gradient_[local.unknowns[i]] += slope[static_cast<Index>(i)];
            for (std::size_t j = 0; j <= i; ++j)
                matrix_.valuePtr()[local.places[at++]] += block(static_cast<Index>(i), static_cast<Index>(j));
        }
    }
    // Of the quadratic function assembled: from where it is to its least. Empty where that cannot be had.
    Eigen::VectorXd step() {
        double most = 0;
        for (Index i = 0; i < matrix_.cols(); ++i)
            most = std::max(most, matrix_.valuePtr()[matrix_.outerIndexPtr()[i]]);
        for (Index i = 0; i < matrix_.cols(); ++i) {
            double& diagonal = matrix_.valuePtr()[matrix_.outerIndexPtr()[i]];
            diagonal += 1e-10 * diagonal + 1e-13 * most;
        }
        if (!cholesky_->factorize(matrix_)) return {};
        return -cholesky_->solve(gradient_);
    }
    const Eigen::VectorXd& gradient() const { return gradient_; }

private:
    struct Local {
        std::vector<Index> unknowns, places;
        Eigen::MatrixXd by;  // (12, unknowns)
    };
    static const Form& row(const TetProblem& problem, std::size_t t, int j) {
        return problem.free.rows[3 * problem.corners(static_cast<Index>(t), j / 3) + j % 3];
    }

    std::vector<Local> tets_;
    Eigen::SparseMatrix<double> matrix_;  // lower triangle
    Eigen::VectorXd gradient_;
    std::unique_ptr<surface::detail::SparseCholesky<double>> cholesky_;
};

}  // namespace octafield::volume::detail
