/// The product behind every posed frame: float32, fused where the machine can, as wide as its registers.
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

namespace meshreel::player {

/// The coefficients of one segment, and what its basis says of the frame. Components go from the smallest to the
/// largest: partial sums stay small, and so do their rounding errors.
struct Term {
    const float* coefficients =
        nullptr;                  ///< [blocks x K x block], at a multiple of 64 bytes; the last block is filled up
    const float* basis = nullptr; ///< [K x 3]
    std::size_t K = 0;
};

/// One frame: t = m + the sum of all terms (8.2). The mean is two numbers, as its size would else cost the sum digits.
struct FrameTerms {
    std::array<Term, 4> terms;
    std::size_t count = 0; ///< terms used
    std::array<float, 3> mean{}, mean_rest{};
};

inline constexpr std::size_t largest_block = 128;

/// One way to do it.
struct Kernel {
    std::string_view name;
    std::size_t block = 0; ///< vertices of a block, a multiple of 16, no more than largest_block
    /// Poses the vertices of block b into out [block x 3].
    void (*pose)(const FrameTerms& frame, std::size_t b, float* out) = nullptr;
};

/// Those that this machine can run, the fastest last.
std::span<const Kernel> kernels();

} // namespace meshreel::player
