// The stiffness matrix applied to fields of K numbers per site at once, and sums over sites whose bits do not depend on
// the number of threads.
#pragma once

#include <array>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "block_product.hpp"
#include "octafield/parallel.hpp"
#include "octafield/volume/sampling.hpp"

namespace octafield::volume {

// Sites of one block of a sum: few enough to balance threads, enough to hide their start.
constexpr std::int64_t sum_block = 2048;
// Rows of a product that are used while they are in the cache.
constexpr Index product_rows = 128;

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
    // Refers to the sampling.
    explicit BlockLaplacian(const Sampling& sampling)
        : matrix_(sampling.stiffness),
          diagonal_(matrix_.diagonal()),
          mass_(sampling.mass),
          single_(matrix_.valuePtr(), matrix_.valuePtr() + matrix_.nonZeros()) {}

    Index rows() const { return static_cast<Index>(matrix_.rows()); }
    const SparseMatrix& matrix() const { return matrix_; }
    const Eigen::VectorXd& diagonal() const { return diagonal_; }
    const Eigen::VectorXd& mass() const { return mass_; }  // lumped
    // True for vertices of no tet and tets of no neighbour: their row is zero.
    bool is_isolated(Index v) const { return !(diagonal_[v] > 0); }

    // use(v, row v of L x) for all rows; returns the sum of what it returns.
    template <class Real, int K, class Use>
    double for_rows_of_product(const Rows<Real, K>& x, int threads, const Use& use) const {
        return block_sum(x.rows(), threads, [&](std::int64_t begin, std::int64_t end) {
            std::array<Real, product_rows * std::size_t(K)> products;
            double sum = 0;
            for (Index first = begin; first < end; first += product_rows) {
                const Index last = std::min<Index>(end, first + product_rows);
                multiply_rows(compressed<Real>(), first, last, x, products.data());
                for (Index v = first; v < last; ++v)
                    sum += use(v, Eigen::Map<const Eigen::Matrix<Real, K, 1>>(&products[std::size_t(K) * (v - first)]));
            }
            return sum;
        });
    }

    // y = L x; returns x . y. Both from differences of neighbours, so that a constant field has no energy but the
    // square of rounding.
    template <int K>
    double multiply(const Rows<double, K>& x, Rows<double, K>& y, int threads) const {
        y.resize(x.rows(), K);
        return block_sum(x.rows(), threads, [&](std::int64_t first, std::int64_t last) {
            return multiply_by_differences(compressed<double>(), first, last, x, y.data() + K * first);
        });
    }

private:
    // L is symmetric: its columns are its rows.
    template <class Real>
    SparseRows<Real> compressed() const {
        if constexpr (std::is_same_v<Real, float>)
            return {matrix_.outerIndexPtr(), matrix_.innerIndexPtr(), single_.data()};
        else
            return {matrix_.outerIndexPtr(), matrix_.innerIndexPtr(), matrix_.valuePtr()};
    }

    template <class Real>
    static void multiply_rows(const SparseRows<Real>& rows, Index first, Index last, const Rows<Real, 9>& x, Real* y) {
        multiply_nine(rows, first, last, x.data(), y);
    }
    static double multiply_by_differences(const SparseRows<double>& rows, Index first, Index last,
                                          const Rows<double, 9>& x, double* y) {
        return multiply_nine_by_differences(rows, first, last, x.data(), y);
    }

    template <class Real, int K>
    static void multiply_rows(const SparseRows<Real>& rows, Index first, Index last, const Rows<Real, K>& x, Real* y) {
        for (Index v = first; v < last; ++v) {
            Eigen::Matrix<Real, 1, K> sum = Eigen::Matrix<Real, 1, K>::Zero();
            for (Index k = rows.begin[v]; k < rows.begin[v + 1]; ++k) sum += rows.value[k] * x.row(rows.column[k]);
            Eigen::Map<Eigen::Matrix<Real, 1, K>>(y + std::ptrdiff_t(K) * (v - first)) = sum;
        }
    }
    template <int K>
    static double multiply_by_differences(const SparseRows<double>& rows, Index first, Index last,
                                          const Rows<double, K>& x, double* y) {
        double energy = 0;
        for (Index v = first; v < last; ++v) {
            Eigen::Matrix<double, 1, K> sum = Eigen::Matrix<double, 1, K>::Zero();
            for (Index k = rows.begin[v]; k < rows.begin[v + 1]; ++k) {
                const Eigen::Matrix<double, 1, K> difference = x.row(rows.column[k]) - x.row(v);
                sum += rows.value[k] * difference;
                energy -= rows.value[k] / 2 * difference.squaredNorm();
            }
            Eigen::Map<Eigen::Matrix<double, 1, K>>(y + std::ptrdiff_t(K) * (v - first)) = sum;
        }
        return energy;
    }

    const SparseMatrix& matrix_;
    Eigen::VectorXd diagonal_;
    const Eigen::VectorXd& mass_;
    std::vector<float> single_;  // the matrix's values
};

}  // namespace octafield::volume
