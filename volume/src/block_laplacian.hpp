// The stiffness matrix applied to fields of K numbers per vertex at once, and sums over vertices whose bits do not
// depend on the number of threads.
#pragma once

#include <cstdint>
#include <vector>

#include "octafield/parallel.hpp"
#include "octafield/volume/sampling.hpp"

namespace octafield::volume {

// Vertices of one block of a sum: few enough to balance threads, enough to hide their start.
constexpr std::int64_t sum_block = 2048;

// sum of body(first, last) over blocks of fixed size, added up in their order. Bodies may write elements of their
// block.
template <class Body>
double block_sum(std::int64_t n, int threads, const Body& body) {
    std::vector<double> sums((n + sum_block - 1) / sum_block);
    parallel_for(
        static_cast<std::int64_t>(sums.size()), threads,
        [&](std::int64_t k) { sums[k] = body(k * sum_block, std::min(n, (k + 1) * sum_block)); }, 2);
    double total = 0;
    for (const double sum : sums) total += sum;
    return total;
}

class BlockLaplacian {
public:
    explicit BlockLaplacian(const Sampling& sampling)
        : matrix_(sampling.stiffness), diagonal_(matrix_.diagonal()), mass_(sampling.mass) {}

    Index rows() const { return static_cast<Index>(matrix_.rows()); }
    const Eigen::VectorXd& diagonal() const { return diagonal_; }
    const Eigen::VectorXd& mass() const { return mass_; }  // lumped
    // True for vertices of no tet and tets of no neighbour: their row is zero.
    bool is_isolated(Index v) const { return !(diagonal_[v] > 0); }

    // Row v of L x.
    template <int K>
    Eigen::Matrix<double, K, 1> row_times(Index v, const Rows<double, K>& x) const {
        Eigen::Matrix<double, K, 1> sum = Eigen::Matrix<double, K, 1>::Zero();
        const Index* columns = matrix_.innerIndexPtr();  // L is symmetric: columns are rows
        for (auto k = matrix_.outerIndexPtr()[v]; k < matrix_.outerIndexPtr()[v + 1]; ++k) {
            const double weight = matrix_.valuePtr()[k];
            const double* value = x.data() + std::ptrdiff_t(K) * columns[k];
            for (int c = 0; c < K; ++c) sum[c] += weight * value[c];
        }
        return sum;
    }

    // y = L x; returns x . y. Both from differences of neighbours, so that a constant field has no energy but the
    // square of rounding.
    template <int K>
    double multiply(const Rows<double, K>& x, Rows<double, K>& y, int threads) const {
        y.resize(x.rows(), K);
        return block_sum(x.rows(), threads, [&](std::int64_t first, std::int64_t last) {
            double sum = 0;
            for (std::int64_t v = first; v < last; ++v) {
                y.row(v).setZero();
                for (auto k = matrix_.outerIndexPtr()[v]; k < matrix_.outerIndexPtr()[v + 1]; ++k) {
                    const Eigen::Matrix<double, 1, K> difference = x.row(matrix_.innerIndexPtr()[k]) - x.row(v);
                    y.row(v) += matrix_.valuePtr()[k] * difference;
                    sum -= matrix_.valuePtr()[k] / 2 * difference.squaredNorm();
                }
            }
            return sum;
        });
    }

private:
    SparseMatrix matrix_;
    Eigen::VectorXd diagonal_, mass_;
};

}  // namespace octafield::volume
