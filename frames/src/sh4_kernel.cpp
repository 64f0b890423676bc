// One copy of sh4_ascent.ipp and sh4_search.ipp per instruction set, chosen at run time. This file is compiled without
// contraction to fused multiply-add (frames/CMakeLists.txt), so that all copies give the same bits.
// _mm512_max_pd is written with a full mask: GCC 12 warns of an uninitialised variable in its header otherwise.
#include "sh4_kernel.hpp"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace octafield::frames::sh4 {

namespace {
namespace base {
#define OCTAFIELD_LANES 2
#if defined(__x86_64__)
#define OCTAFIELD_BITS(m) _mm_movemask_pd((__m128d)(m))
#define OCTAFIELD_GREATER(a, b) (V) _mm_max_pd((__m128d)(a), (__m128d)(b))
#endif
#include "sh4_ascent.ipp"
#include "sh4_search.ipp"
#undef OCTAFIELD_LANES
#undef OCTAFIELD_BITS
#undef OCTAFIELD_GREATER
}  // namespace base
}  // namespace

#if defined(__x86_64__)

#if defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx2"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx2")
#endif
namespace {
namespace avx2 {
#define OCTAFIELD_LANES 4
#define OCTAFIELD_BITS(m) _mm256_movemask_pd((__m256d)(m))
#define OCTAFIELD_GREATER(a, b) (V) _mm256_max_pd((__m256d)(a), (__m256d)(b))
#include "sh4_ascent.ipp"
#include "sh4_search.ipp"
#undef OCTAFIELD_LANES
#undef OCTAFIELD_BITS
#undef OCTAFIELD_GREATER
}  // namespace avx2
}  // namespace
#if defined(__clang__)
#pragma clang attribute pop
#pragma clang attribute push(__attribute__((target("avx512f,avx512dq,avx512vl"))), apply_to = function)
#else
#pragma GCC pop_options
#pragma GCC push_options
#pragma GCC target("avx512f,avx512dq,avx512vl,prefer-vector-width=512")
#endif
namespace {
namespace avx512 {
#define OCTAFIELD_LANES 8
#define OCTAFIELD_BITS(m) _mm512_movepi64_mask((__m512i)(m))
#define OCTAFIELD_GREATER(a, b) (V) _mm512_maskz_max_pd(0xff, (__m512d)(a), (__m512d)(b))
#include "sh4_ascent.ipp"
#include "sh4_search.ipp"
#undef OCTAFIELD_LANES
#undef OCTAFIELD_BITS
#undef OCTAFIELD_GREATER
}  // namespace avx512
}  // namespace
#if defined(__clang__)
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif

#endif  // __x86_64__

const std::vector<Kernel>& kernels() {
    static const std::vector<Kernel> list = [] {
        std::vector<Kernel> found;
#if defined(__x86_64__)
        if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
            __builtin_cpu_supports("avx512vl"))
            found.push_back({"avx512", avx512::lanes, avx512::project, avx512::expand_all, avx512::climb_one});
        if (__builtin_cpu_supports("avx2"))
            found.push_back({"avx2", avx2::lanes, avx2::project, avx2::expand_all, avx2::climb_one});
#endif
        found.push_back({"base", base::lanes, base::project, base::expand_all, base::climb_one});
        return found;
    }();
    return list;
}

}  // namespace octafield::frames::sh4
