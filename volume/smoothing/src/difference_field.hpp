// The field as a least-squares solver sees it when it is smoothed in a metric: quaternions, and the differences over
// all pairs of vertices that costs need, computed once per evaluation and in parallel.
#pragma once

#include <ceres/cost_function.h>
#include <ceres/evaluation_callback.h>

#include "frame_difference.hpp"
#include "frame_manifolds.hpp"
#include "octafield/arrays.hpp"
#include "octafield/parallel.hpp"

namespace octafield::volume {

template <DifferenceScheme Scheme>
class DifferenceField final : public ceres::EvaluationCallback {
public:
    static constexpr int dimension = Scheme::dimension;
    using LeftInverse = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;

    struct Pair {
        Index i, j;
    };

    DifferenceField(Quaternions quaternions, Scheme scheme_of_pairs, int threads)
        : scheme(std::move(scheme_of_pairs)),
          threads_(threads),
          quaternions_(std::move(quaternions)),
          vertices_(quaternions_.rows()),
          left_inverses_(quaternions_.rows()) {}

    // Its number.
    std::size_t add_pair(Index i, Index j) {
        pairs_.push_back({i, j});
        differences_.emplace_back();
        return pairs_.size() - 1;
    }

    double* parameters(Index vertex) { return quaternions_.row(vertex).data(); }
    Quaternions& quaternions() { return quaternions_; }
    frames::Quaternion frame(Index vertex) const {
        return frames::from_wxyz(frames::Vector4(quaternions_.row(vertex).transpose()));
    }
    const std::vector<Pair>& pairs() const { return pairs_; }
    const Difference<dimension>& difference(std::size_t pair) const { return differences_[pair]; }
    // Of the manifolds' PlusJacobian: derivatives by rotation vectors times this are ones by (w, x, y, z).
    const LeftInverse& left_inverse(Index vertex) const { return left_inverses_[vertex]; }

    void PrepareForEvaluation(bool evaluate_jacobians, bool new_evaluation_point) override {
        if (new_evaluation_point) jacobians_current_ = false;
        const bool jacobians = evaluate_jacobians && !jacobians_current_;
        if (!new_evaluation_point && !jacobians) return;
        parallel_for(quaternions_.rows(), threads_, [&](std::int64_t v) {
            const frames::Quaternion q = frame(static_cast<Index>(v));
            vertices_[v] = Scheme::at(q, jacobians);
            if (!jacobians) return;
            FrameManifold().MinusJacobian(quaternions_.row(v).data(), left_inverses_[v].data());
        });
        parallel_for(static_cast<std::int64_t>(pairs_.size()), threads_, [&](std::int64_t k) {
            differences_[k] = scheme.difference(k, vertices_[pairs_[k].i], vertices_[pairs_[k].j], jacobians);
        });
        jacobians_current_ = jacobians;
    }

    Scheme scheme;

private:
    int threads_;
    bool jacobians_current_ = false;
    Quaternions quaternions_;
    std::vector<typename Scheme::Vertex> vertices_;
    std::vector<LeftInverse> left_inverses_;
    std::vector<Pair> pairs_;
    std::vector<Difference<dimension>> differences_;
};

// Rows of coefficients times the differences from one vertex to others: an edge (one row, one pair) or a tet (its
// gradient, from its first vertex). Parameters: the first vertex, then the others. Residuals: Scheme::dimension per
// row.
template <DifferenceScheme Scheme>
class DifferenceCost final : public ceres::CostFunction {
public:
    using Field = DifferenceField<Scheme>;
    using Coefficients = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

    // The pairs are `first_pair` and those after it, as many as columns, all from the same vertex.
    DifferenceCost(const Field& field, std::size_t first_pair, Coefficients coefficients)
        : field_(field), first_pair_(first_pair), coefficients_(std::move(coefficients)) {
        set_num_residuals(static_cast<int>(coefficients_.rows()) * d);
        mutable_parameter_block_sizes()->assign(coefficients_.cols() + 1, 4);
    }

    bool Evaluate(const double* const*, double* residuals, double** jacobians) const override {
        const int rows = static_cast<int>(coefficients_.rows()), pairs = static_cast<int>(coefficients_.cols());
        for (int r = 0; r < rows; ++r) {
            Eigen::Matrix<double, d, 1> sum = coefficients_(r, 0) * at(0).value;
            for (int k = 1; k < pairs; ++k) sum += coefficients_(r, k) * at(k).value;
            Eigen::Map<Eigen::Matrix<double, d, 1>>(residuals + r * d) = sum;
        }
        if (!jacobians) return true;
        for (int block = 0; block <= pairs; ++block) {
            if (!jacobians[block]) continue;
            const auto& pair = field_.pairs()[first_pair_ + std::max(0, block - 1)];
            const auto& chain = field_.left_inverse(block == 0 ? pair.i : pair.j);
            for (int r = 0; r < rows; ++r)
                Eigen::Map<Eigen::Matrix<double, d, 4, Eigen::RowMajor>>(jacobians[block] + 4 * r * d) =
                    by_block(r, block) * chain;
        }
        return true;
    }

private:
    static constexpr int d = Scheme::dimension;
    const Difference<d>& at(int k) const { return field_.difference(first_pair_ + k); }

    Eigen::Matrix<double, d, 3> by_block(int row, int block) const {
        if (block > 0) return coefficients_(row, block - 1) * at(block - 1).by_second;
        Eigen::Matrix<double, d, 3> sum = coefficients_(row, 0) * at(0).by_first;
        for (int k = 1; k < coefficients_.cols(); ++k) sum += coefficients_(row, k) * at(k).by_first;
        return sum;
    }

    const Field& field_;
    std::size_t first_pair_;
    Coefficients coefficients_;
};

}  // namespace octafield::volume
