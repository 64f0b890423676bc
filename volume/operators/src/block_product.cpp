#include "block_product.hpp"

#include <cstddef>
#include <cstring>

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define OCTAFIELD_CLONES __attribute__((target_clones("default", "avx2", "avx512f")))
#else
#define OCTAFIELD_CLONES
#endif

// Compiled without contraction to fused multiply-add (CMakeLists.txt): the copies give the same bits.
namespace octafield::volume {
namespace {

template <class Real>
struct Nine {
    typedef Real Eight __attribute__((vector_size(8 * sizeof(Real))));
    Eight eight;
    Real ninth;

    [[gnu::always_inline]] static Nine load(const Real* p) {
        Nine n;
        std::memcpy(&n.eight, p, sizeof(Eight));
        n.ninth = p[8];
        return n;
    }
    [[gnu::always_inline]] void store(Real* p) const {
        std::memcpy(p, &eight, sizeof(Eight));
        p[8] = ninth;
    }
};

template <class Real>
[[gnu::always_inline]] inline void multiply_rows(const SparseRows<Real>& rows, Index first, Index last, const Real* x,
                                                 Real* y) {
    for (Index v = first; v < last; ++v) {
        Nine<Real> sum{};
        for (Index k = rows.begin[v]; k < rows.begin[v + 1]; ++k) {
            const Nine<Real> other = Nine<Real>::load(x + std::ptrdiff_t(9) * rows.column[k]);
            sum.eight += rows.value[k] * other.eight;
            sum.ninth += rows.value[k] * other.ninth;
        }
        sum.store(y + std::ptrdiff_t(9) * (v - first));
    }
}

}  // namespace

OCTAFIELD_CLONES
void multiply_nine(const SparseRows<float>& rows, Index first, Index last, const float* x, float* y) {
    multiply_rows(rows, first, last, x, y);
}

OCTAFIELD_CLONES
void multiply_nine(const SparseRows<double>& rows, Index first, Index last, const double* x, double* y) {
    multiply_rows(rows, first, last, x, y);
}

OCTAFIELD_CLONES
double multiply_nine_by_differences(const SparseRows<double>& rows, Index first, Index last, const double* x,
                                    double* y) {
    Nine<double> energy{};
    for (Index v = first; v < last; ++v) {
        const Nine<double> own = Nine<double>::load(x + std::ptrdiff_t(9) * v);
        Nine<double> sum{};
        for (Index k = rows.begin[v]; k < rows.begin[v + 1]; ++k) {
            Nine<double> other = Nine<double>::load(x + std::ptrdiff_t(9) * rows.column[k]);
            other.eight -= own.eight;
            other.ninth -= own.ninth;
            const Nine<double> weighted{rows.value[k] * other.eight, rows.value[k] * other.ninth};
            sum.eight += weighted.eight;
            sum.ninth += weighted.ninth;
            energy.eight -= weighted.eight * other.eight;
            energy.ninth -= weighted.ninth * other.ninth;
        }
        sum.store(y + std::ptrdiff_t(9) * (v - first));
    }
    double total = energy.ninth;
    for (int c = 0; c < 8; ++c) total += energy.eight[c];
    return total / 2;
}

}  // namespace octafield::volume
