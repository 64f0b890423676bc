// Sparse matrices summed from 4 x 4 element matrices.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "octafield/parallel.hpp"
#include "octafield/volume/operators.hpp"

namespace octafield::volume {

// For every unknown its places 4 element + k, in ascending order. Rows of elements: four unknowns in [0, count).
struct Corners {
    std::vector<std::int64_t> begin;   // (count + 1)
    std::vector<std::int64_t> corner;  // (4 elements)

    Corners(const Tets& elements, Index count) : begin(count + 1, 0), corner(4 * elements.rows()) {
        const auto* unknowns = elements.data();
        for (std::size_t i = 0; i < corner.size(); ++i) ++begin[unknowns[i] + 1];
        for (Index v = 0; v < count; ++v) begin[v + 1] += begin[v];
        std::vector<std::int64_t> next(begin.begin(), begin.end() - 1);
        for (std::size_t i = 0; i < corner.size(); ++i) corner[next[unknowns[i]]++] = static_cast<std::int64_t>(i);
    }
};

// Columns [first, last) of a matrix that is being assembled.
struct ColumnBlock {
    std::vector<Index> rows;
    std::vector<double> values;
    std::vector<SparseMatrix::StorageIndex> sizes;  // of each column

    template <class ElementColumn>
    void fill(const Tets& elements, const Corners& corners, Index first, Index last,
              const ElementColumn& element_column) {
        const std::size_t count = corners.begin.size() - 1;
        std::vector<double> sum(count, 0);
        std::vector<Index> stamp(count, -1), found;
        sizes.reserve(last - first);
        for (Index column = first; column < last; ++column) {
            found.clear();
            for (std::int64_t c = corners.begin[column]; c < corners.begin[column + 1]; ++c) {
                const Index element = static_cast<Index>(corners.corner[c] / 4);
                const Eigen::Vector4d local = element_column(element, static_cast<int>(corners.corner[c] % 4));
                for (int k = 0; k < 4; ++k) {
                    const Index row = elements(element, k);
                    if (stamp[row] != column) {
                        stamp[row] = column;
                        sum[row] = 0;
                        found.push_back(row);
                    }
                    sum[row] += local[k];
                }
            }
            std::sort(found.begin(), found.end());
            rows.insert(rows.end(), found.begin(), found.end());
            for (const Index row : found) values.push_back(sum[row]);
            sizes.push_back(static_cast<SparseMatrix::StorageIndex>(found.size()));
        }
    }
};

// (count, count): sums the columns element_column(element, k) of the symmetric element matrices. Column by column, so
// that no list of 16 triplets per element is ever held; both halves sum the same numbers in the same order, so the
// result is exactly symmetric where the element matrices are. The same bits at any thread count.
template <class ElementColumn>
SparseMatrix assemble(const Tets& elements, Index count, int threads, const ElementColumn& element_column) {
    constexpr std::int64_t least_columns = 4096, most_blocks = 8;  // a block's own arrays are as long as all columns
    const Corners corners(elements, count);
    const std::int64_t parts =
        std::clamp<std::int64_t>(std::min(count / least_columns, most_blocks), 1, thread_count(threads));
    std::vector<ColumnBlock> blocks(parts);
    const auto first = [&](std::int64_t b) { return static_cast<Index>(count * b / parts); };
    parallel_for(
        parts, threads,
        [&](std::int64_t b) { blocks[b].fill(elements, corners, first(b), first(b + 1), element_column); }, 1);

    SparseMatrix matrix(count, count);
    auto* begin = matrix.outerIndexPtr();
    for (std::int64_t b = 0; b < parts; ++b)
        for (std::size_t c = 0; c < blocks[b].sizes.size(); ++c)
            begin[first(b) + c + 1] = begin[first(b) + c] + blocks[b].sizes[c];
    matrix.resizeNonZeros(begin[count]);
    parallel_for(
        parts, threads,
        [&](std::int64_t b) {
            const ColumnBlock block = std::move(blocks[b]);
            std::copy(block.rows.begin(), block.rows.end(), matrix.innerIndexPtr() + begin[first(b)]);
            std::copy(block.values.begin(), block.values.end(), matrix.valuePtr() + begin[first(b)]);
        },
        1);
    return matrix;
}

// matrix * x. Symmetric, so that column v serves as row v, and threads share the unknowns: the same bits at any count
// of them.
inline Eigen::VectorXd symmetric_product(const SparseMatrix& matrix, const Eigen::VectorXd& x, int threads) {
    Eigen::VectorXd product(x.size());
    parallel_for(
        x.size(), threads,
        [&](std::int64_t v) {
            double sum = 0;
            for (SparseMatrix::InnerIterator entry(matrix, v); entry; ++entry) sum += entry.value() * x[entry.row()];
            product[v] = sum;
        },
        8192);
    return product;
}

// Rows: gradients of the four hat functions of a tet. With E its edges from vertex 0 as columns, those of 1 to 3 are
// the rows of E^-1.
using Gradients = Eigen::Matrix<double, 4, 3>;
Gradients hat_gradients(const Eigen::Matrix3d& edges);
Eigen::Matrix3d tet_edges(const TetMesh& mesh, Eigen::Index tet);

}  // namespace octafield::volume
