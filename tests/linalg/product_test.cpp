/// Products against sums in the plainest order.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <gtest/gtest.h>

#include "meshreel/base/random.h"
#include "meshreel/linalg/product.h"

namespace meshreel::linalg {
namespace {

Matrix<double> random_matrix(std::size_t rows, std::size_t cols, std::uint64_t seed)
{
    Random random(seed);
    Matrix<double> matrix(rows, cols);
    for (double& value : matrix.values) value = random.uniform(-1, 1);
    return matrix;
}

TEST(Product, AddsWhatTermAfterTermGivesBitForBitInRunsOf256)
{
    for (const auto [m, n, depth] :
         {std::array<std::size_t, 3>{1, 1, 1}, {16, 6, 256}, {17, 7, 257}, {130, 125, 600}}) {
        const Matrix<double> A = random_matrix(m, depth, 1), B = random_matrix(depth, n, 2);
        Matrix<double> found(n, m), expected(n, m);
        add_product(rows_of(A.view()), columns_of(B.view()), depth, {found.values.data(), m});
        for (std::size_t i = 0; i < m; ++i)
            for (std::size_t j = 0; j < n; ++j)
                for (std::size_t first = 0; first < depth; first += 256) {
                    double sum = 0;
                    for (std::size_t p = first; p < std::min(depth, first + 256); ++p) sum += A(i, p) * B(p, j);
                    expected(j, i) += sum;
                }
        EXPECT_EQ(found.values, expected.values) << m << " x " << n << " x " << depth;
    }
}

TEST(Product, LeavesWhatLiesBetweenTheColumnsAlone)
{
    const Matrix<double> A = random_matrix(3, 5, 3);
    std::vector<double> C(8, 7.0);
    add_product(rows_of(A.view()), {A.values.data(), 2, A.cols, 1}, 5, {C.data(), 4});
    EXPECT_EQ(C[3], 7.0);
    EXPECT_EQ(C[7], 7.0);
}

} // namespace
} // namespace meshreel::linalg
