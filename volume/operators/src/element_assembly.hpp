// Sparse matrices summed from 4 x 4 element matrices.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

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

// (count, count): sums the columns element_column(element, k) of the symmetric element matrices. Column by column, so
// that no list of 16 triplets per element is ever held; both halves sum the same numbers in the same order, so the
// result is exactly symmetric where the element matrices are.
template <class ElementColumn>
SparseMatrix assemble(const Tets& elements, Index count, const ElementColumn& element_column) {
    const Corners corners(elements, count);
    SparseMatrix matrix(count, count);
    matrix.reserve(count + 14 * static_cast<std::int64_t>(count));  // a vertex has about 14 neighbours
    std::vector<double> value(count, 0);
    std::vector<Index> stamp(count, -1), rows;
    for (Index column = 0; column < count; ++column) {
        rows.clear();
        for (std::int64_t c = corners.begin[column]; c < corners.begin[column + 1]; ++c) {
            const Index element = static_cast<Index>(corners.corner[c] / 4);
            const Eigen::Vector4d local = element_column(element, static_cast<int>(corners.corner[c] % 4));
            for (int k = 0; k < 4; ++k) {
                const Index row = elements(element, k);
                if (stamp[row] != column) {
                    stamp[row] = column;
                    value[row] = 0;
                    rows.push_back(row);
                }
                value[row] += local[k];
            }
        }
        std::sort(rows.begin(), rows.end());
        matrix.startVec(column);
        for (const Index row : rows) matrix.insertBack(row, column) = value[row];
    }
    matrix.finalize();
    return matrix;
}

// Rows: gradients of the four hat functions of a tet. With E its edges from vertex 0 as columns, those of 1 to 3 are
// the rows of E^-1.
using Gradients = Eigen::Matrix<double, 4, 3>;
Gradients hat_gradients(const Eigen::Matrix3d& edges);
Eigen::Matrix3d tet_edges(const TetMesh& mesh, Eigen::Index tet);

}  // namespace octafield::volume
