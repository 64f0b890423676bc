// Threads of the numerical libraries underneath.
#pragma once

// Weak: absent with another BLAS, or in a process without OpenMP.
extern "C" void openblas_set_num_threads(int) __attribute__((weak));
extern "C" void omp_set_dynamic(int) __attribute__((weak));

namespace octafield {

// To be called at the start of work that factorizes matrices. One BLAS thread, since its kernels may round differently
// with more; and no more OpenMP threads than idle cores: CHOLMOD asks for four whatever the machine, and they spin (its
// sums do not depend on their number).
inline void calm_library_threads() {
    if (openblas_set_num_threads) openblas_set_num_threads(1);
    if (omp_set_dynamic) omp_set_dynamic(1);
}

}  // namespace octafield
