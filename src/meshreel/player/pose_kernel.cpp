/// One loop for all register widths: a block of vertices keeps its three sums in registers while k goes by.
// SPDX-License-Identifier: MIT
//
// This file alone of the library is compiled with contraction on: what it computes is shown, never measured or coded.
#include "meshreel/player/pose_kernel.h"

#include <utility>

namespace meshreel::player {

namespace {

#define MESHREEL_INLINE inline __attribute__((always_inline))

/// A register of some floats, and how it lies in memory.
template <int lanes>
struct Wide {
    typedef float Floats __attribute__((vector_size(lanes * sizeof(float)), may_alias));
    typedef float Unaligned __attribute__((vector_size(lanes * sizeof(float)), aligned(4), may_alias));
};

/// One register of x0 y0 z0 x1 y1 z1 ..., the one from place `first` on.
template <int lanes, int first, int... l>
MESHREEL_INLINE void store_interleaved(const typename Wide<lanes>::Floats (&xyz)[3], float* out,
                                       std::integer_sequence<int, l...>)
{
    const auto xy = __builtin_shufflevector(xyz[0], xyz[1], ((first + l) % 3 == 1 ? lanes : 0) + (first + l) / 3 ...);
    *reinterpret_cast<typename Wide<lanes>::Unaligned*>(out + first) =
        __builtin_shufflevector(xy, xyz[2], ((first + l) % 3 == 2 ? lanes + (first + l) / 3 : l)...);
}

/// The block is `registers` wide; three times as many hold the sums.
template <int lanes, int registers>
MESHREEL_INLINE void pose_block(const FrameTerms& frame, std::size_t b, float* out)
{
    using Floats = typename Wide<lanes>::Floats;
    constexpr std::size_t block = lanes * registers;
    Floats sums[registers][3];
    for (int r = 0; r < registers; ++r)
        for (int c = 0; c < 3; ++c) sums[r][c] = Floats{} + frame.mean_rest[c];
    for (std::size_t t = 0; t < frame.count; ++t) {
        const Term& term = frame.terms[t];
        const float* coefficients = term.coefficients + b * term.K * block;
        for (std::size_t k = 0; k < term.K; ++k, coefficients += block) {
            const float x = term.basis[3 * k], y = term.basis[3 * k + 1], z = term.basis[3 * k + 2];
#pragma GCC unroll 8
            for (int r = 0; r < registers; ++r) {
                const Floats c = *reinterpret_cast<const Floats*>(coefficients + r * lanes);
                sums[r][0] += c * x; // (8.2)
                sums[r][1] += c * y;
                sums[r][2] += c * z;
            }
        }
    }
#pragma GCC unroll 8
    for (int r = 0; r < registers; ++r, out += 3 * lanes) {
        for (int c = 0; c < 3; ++c) sums[r][c] += frame.mean[c];
        constexpr auto all = std::make_integer_sequence<int, lanes>();
        store_interleaved<lanes, 0>(sums[r], out, all);
        store_interleaved<lanes, lanes>(sums[r], out, all);
        store_interleaved<lanes, 2 * lanes>(sums[r], out, all);
    }
}

void pose_plain(const FrameTerms& frame, std::size_t b, float* out)
{
    pose_block<4, 4>(frame, b, out);
}

#if defined(__x86_64__)
__attribute__((target("avx2,fma"))) void pose_avx2(const FrameTerms& frame, std::size_t b, float* out)
{
    pose_block<8, 4>(frame, b, out);
}

__attribute__((target("avx512f,avx512vl,avx512dq,fma"))) void pose_avx512(const FrameTerms& frame, std::size_t b,
                                                                          float* out)
{
    pose_block<16, 8>(frame, b, out);
}
#endif

} // namespace

std::span<const Kernel> kernels()
{
    static const std::array<Kernel, 3> all{{{"plain", 16, pose_plain},
#if defined(__x86_64__)
                                            {"avx2", 32, pose_avx2},
                                            {"avx512", 128, pose_avx512}
#endif
    }};
    std::size_t count = 1;
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
        count = 2;
        if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
            __builtin_cpu_supports("avx512dq"))
            count = 3;
    }
#endif
    return std::span(all).first(count);
}

} // namespace meshreel::player

#undef MESHREEL_INLINE
