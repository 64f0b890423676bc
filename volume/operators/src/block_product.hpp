// Rows of a sparse matrix times fields of nine numbers per vertex, where the solvers spend their time: one copy per
// instruction set, chosen at run time, all with the same bits.
#pragma once

#include "octafield/volume/operators.hpp"

namespace octafield::volume {

// Compressed rows [first, last): begin of each row in `column` and `value`.
template <class Real>
struct SparseRows {
    const Index* begin;
    const Index* column;
    const Real* value;
};

// y = rows * x. x: (n, 9), y: (last - first, 9), row-major.
void multiply_nine(const SparseRows<float>& rows, Index first, Index last, const float* x, float* y);
void multiply_nine(const SparseRows<double>& rows, Index first, Index last, const double* x, double* y);

// The same for rows that sum to zero, from differences of neighbours; returns sum of x . y over pairs of these rows
// with all, each half: over all rows it is x . L x.
double multiply_nine_by_differences(const SparseRows<double>& rows, Index first, Index last, const double* x,
                                    double* y);

}  // namespace octafield::volume
