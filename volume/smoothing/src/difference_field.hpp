// The field as a least-squares solver sees it when it is smoothed in a metric: a row of unknowns per vertex, and the
// differences over all pairs of vertices that costs need, computed once per evaluation and in parallel.
#pragma once

#include <ceres/cost_function.h>
#include <ceres/evaluation_callback.h>

#include <type_traits>

#include "frame_difference.hpp"
#include "frame_unknowns.hpp"
#include "octafield/arrays.hpp"
#include "octafield/parallel.hpp"

namespace octafield::volume {

// Quaternions, unless the scheme says otherwise.
template <class Scheme>
struct UnknownsOf {
    using type = QuaternionUnknowns;
};
template <class Scheme>
requires requires { typename Scheme::Unknowns; }
struct UnknownsOf<Scheme> {
    using type = typename Scheme::Unknowns;
};

template <DifferenceScheme Scheme>
class DifferenceField final : public ceres::EvaluationCallback {
public:
    static constexpr int dimension = Scheme::dimension;
    using Unknowns = typename UnknownsOf<Scheme>::type;
    using LeftInverse = Eigen::Matrix<double, 3, Unknowns::size, Eigen::RowMajor>;

    struct Pair {
        Index i, j;
    };

    DifferenceField(Quaternions start, Scheme scheme_of_pairs, int threads)
        : scheme(std::move(scheme_of_pairs)),
          threads_(threads),
          rows_(start.rows(), Unknowns::size),
          frames_(std::move(start)),
          vertices_(frames_.rows()),
          left_inverses_(frames_.rows()) {
        for (Eigen::Index v = 0; v < frames_.rows(); ++v)
            rows_.row(v) = Unknowns::row(frames::from_wxyz(frames::Vector4(frames_.row(v).transpose()))).transpose();
    }

    // Its number.
    std::size_t add_pair(Index i, Index j) {
        pairs_.push_back({i, j});
        differences_.emplace_back();
        return pairs_.size() - 1;
    }

    double* parameters(Index vertex) { return rows_.row(vertex).data(); }
    Rows<double, Unknowns::size>& rows() { return rows_; }
    frames::Quaternion frame(Index vertex) const { return Unknowns::frame(rows_.row(vertex).data()); }
    // As quaternions, each in the representative nearest to what it was before.
    const Quaternions& quaternions() {
        if constexpr (std::is_same_v<Unknowns, QuaternionUnknowns>) {
            return rows_;
        } else {
            parallel_for(rows_.rows(), threads_, [&](std::int64_t v) {
                const frames::Quaternion last = frames::from_wxyz(frames::Vector4(frames_.row(v).transpose()));
                if (rows_.row(v) == Unknowns::row(last).transpose()) return;  // keeps its bits
                const frames::Quaternion now = frames::closest_representative(frame(static_cast<Index>(v)), last);
                frames_.row(v) = frames::to_wxyz(now).transpose();
            });
            return frames_;
        }
    }
    const std::vector<Pair>& pairs() const { return pairs_; }
    const Difference<dimension>& difference(std::size_t pair) const { return differences_[pair]; }
    // Of the manifolds' PlusJacobian: derivatives by rotation vectors times this are ones by the row.
    const LeftInverse& left_inverse(Index vertex) const { return left_inverses_[vertex]; }

    void PrepareForEvaluation(bool evaluate_jacobians, bool new_evaluation_point) override {
        if (new_evaluation_point) jacobians_current_ = false;
        const bool jacobians = evaluate_jacobians && !jacobians_current_;
        if (!new_evaluation_point && !jacobians) return;
        parallel_for(rows_.rows(), threads_, [&](std::int64_t v) {
            const double* row = rows_.row(v).data();
            vertices_[v] = Scheme::at(Unknowns::point(row), jacobians);
            if (!jacobians) return;
            typename Unknowns::FreeManifold().MinusJacobian(row, left_inverses_[v].data());
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
    Rows<double, Unknowns::size> rows_;
    Quaternions frames_;  // of quaternions()
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
        mutable_parameter_block_sizes()->assign(coefficients_.cols() + 1, size);
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
                Eigen::Map<Eigen::Matrix<double, d, size, Eigen::RowMajor>>(jacobians[block] + size * r * d) =
                    by_block(r, block) * chain;
        }
        return true;
    }

private:
    static constexpr int d = Scheme::dimension, size = Field::Unknowns::size;
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
