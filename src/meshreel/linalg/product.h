/// Products of matrices whose sums have one order: the same bits whatever registers, caches and threads there are.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "meshreel/base/views.h"

namespace meshreel::linalg {

/// A matrix [count x depth] as it lies: element (i, p) is data[i * along + p * across].
struct Factor {
    const double* data = nullptr;
    std::size_t count = 0, along = 0, across = 0;
};

/// The rows of a matrix, and its columns: [rows x cols] and [cols x rows].
inline Factor rows_of(MatrixView<const double> matrix)
{
    return {matrix.data, matrix.rows, matrix.cols, 1};
}
inline Factor columns_of(MatrixView<const double> matrix)
{
    return {matrix.data, matrix.cols, 1, matrix.cols};
}

/// A matrix by columns, to be added to: element (i, j) is data[i + j * stride].
struct Sums {
    double* data = nullptr;
    std::size_t stride = 0;
};

/// C += A B^T: 256 terms are summed up as p rises, then added.
/// @cost A.count B.count depth, near what the processor can do; memory half a megabyte.
void add_product(const Factor& A, const Factor& B, std::size_t depth, const Sums& C);

} // namespace meshreel::linalg
