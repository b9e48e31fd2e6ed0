/// Strips of both factors packed side by side, and a kernel that keeps 16 x 6 sums in registers.
// SPDX-License-Identifier: MIT
#include "meshreel/linalg/product.h"

#include <algorithm>
#include <vector>

namespace meshreel::linalg {

namespace {

#define MESHREEL_INLINE inline __attribute__((always_inline))

constexpr std::size_t strip_rows = 16, strip_columns = 6;
constexpr std::size_t panel_depth = 256, panel_rows = 8 * strip_rows, panel_columns = 20 * strip_columns;

/// sums [6][16] of packed strips a [depth][16] and b [depth][6]. As many registers as hold their part of a column.
template <int lanes, int registers>
MESHREEL_INLINE void multiply_strips(const double* a, const double* b, std::size_t depth, double* sums)
{
    typedef double Doubles __attribute__((vector_size(lanes * sizeof(double)), may_alias, aligned(8)));
    for (std::size_t first = 0; first < strip_rows; first += lanes * registers) {
        Doubles part[strip_columns][registers] = {};
        for (std::size_t p = 0; p < depth; ++p) {
            Doubles x[registers];
#pragma GCC unroll 8
            for (int r = 0; r < registers; ++r)
                x[r] =
                    *reinterpret_cast<const Doubles*>(a + p * strip_rows + first + static_cast<std::size_t>(r * lanes));
#pragma GCC unroll 8
            for (std::size_t j = 0; j < strip_columns; ++j)
#pragma GCC unroll 8
                for (int r = 0; r < registers; ++r) part[j][r] += x[r] * b[p * strip_columns + j];
        }
        for (std::size_t j = 0; j < strip_columns; ++j)
            for (int r = 0; r < registers; ++r)
                *reinterpret_cast<Doubles*>(sums + j * strip_rows + first + static_cast<std::size_t>(r * lanes)) =
                    part[j][r];
    }
}

using MultiplyStrips = void (*)(const double* a, const double* b, std::size_t depth, double* sums);

void multiply_plain(const double* a, const double* b, std::size_t depth, double* sums)
{
    multiply_strips<2, 2>(a, b, depth, sums);
}

#if defined(__x86_64__)
__attribute__((target("avx2"))) void multiply_avx2(const double* a, const double* b, std::size_t depth, double* sums)
{
    multiply_strips<4, 2>(a, b, depth, sums);
}

__attribute__((target("avx512f"))) void multiply_avx512(const double* a, const double* b, std::size_t depth,
                                                        double* sums)
{
    multiply_strips<8, 2>(a, b, depth, sums);
}
#endif

MultiplyStrips widest()
{
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx512f")) return multiply_avx512;
    if (__builtin_cpu_supports("avx2")) return multiply_avx2;
#endif
    return multiply_plain;
}

/// Part of a factor as strips [depth][width], filled up with 0.
void pack(const Factor& part, std::size_t depth, std::size_t width, double* packed)
{
    for (std::size_t first = 0; first < part.count; first += width, packed += width * depth) {
        const std::size_t rows = std::min(width, part.count - first);
        const double* data = part.data + first * part.along;
        if (rows < width) std::fill_n(packed, width * depth, 0.0);
        if (part.along == 1)
            for (std::size_t p = 0; p < depth; ++p) std::copy_n(data + p * part.across, rows, packed + p * width);
        else
            for (std::size_t i = 0; i < rows; ++i)
                for (std::size_t p = 0; p < depth; ++p) packed[p * width + i] = data[i * part.along + p * part.across];
    }
}

Factor part_of(const Factor& factor, std::size_t first, std::size_t most, std::size_t p)
{
    return {factor.data + first * factor.along + p * factor.across, std::min(most, factor.count - first), factor.along,
            factor.across};
}

} // namespace

void add_product(const Factor& A, const Factor& B, std::size_t depth, const Sums& C)
{
    static const MultiplyStrips multiply = widest();
    std::vector<double> a(panel_rows * panel_depth), b(panel_columns * panel_depth);
    const auto add_panels = [&](std::size_t rows, std::size_t columns, std::size_t terms, double* corner) {
        for (std::size_t j = 0; j < columns; j += strip_columns)
            for (std::size_t i = 0; i < rows; i += strip_rows) {
                double sums[strip_columns * strip_rows];
                multiply(a.data() + i * terms, b.data() + j * terms, terms, sums);
                for (std::size_t c = j; c < std::min(columns, j + strip_columns); ++c)
                    for (std::size_t r = i; r < std::min(rows, i + strip_rows); ++r)
                        corner[r + c * C.stride] += sums[(c - j) * strip_rows + r - i];
            }
    };
    for (std::size_t p = 0; p < depth; p += panel_depth)
        for (std::size_t j = 0; j < B.count; j += panel_columns) {
            const std::size_t terms = std::min(panel_depth, depth - p);
            const Factor columns = part_of(B, j, panel_columns, p);
            pack(columns, terms, strip_columns, b.data());
            for (std::size_t i = 0; i < A.count; i += panel_rows) {
                const Factor rows = part_of(A, i, panel_rows, p);
                pack(rows, terms, strip_rows, a.data());
                add_panels(rows.count, columns.count, terms, C.data + i + j * C.stride);
            }
        }
}

} // namespace meshreel::linalg

#undef MESHREEL_INLINE
