/// Least squares: exact where it can be, the nearest where not, the shortest where many are.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "meshreel/linalg/least_squares.h"

using namespace meshreel;

namespace {

Matrix<double> matrix(std::size_t cols, std::vector<double> values)
{
    Matrix<double> A(values.size() / cols, cols);
    A.values = std::move(values);
    return A;
}

} // namespace

TEST(LeastSquares, SolvesWhatHasASolution)
{
    const Matrix<double> A = matrix(2, {1, 0, 1, 1, 1, 2});
    const auto x = linalg::least_squares(A.view(), std::vector<double>{1, 3, 5});
    EXPECT_NEAR(x[0], 1, 1e-12);
    EXPECT_NEAR(x[1], 2, 1e-12);
}

TEST(LeastSquares, OfAColumnOfOnesIsTheMean)
{
    const Matrix<double> A = matrix(1, {1, 1, 1, 1});
    EXPECT_NEAR(linalg::least_squares(A.view(), std::vector<double>{1, 2, 3, 6})[0], 3, 1e-12);
}

TEST(LeastSquares, ChoosesTheShortestWhereColumnsAgree)
{
    const Matrix<double> A = matrix(2, {1, 1, 2, 2});
    const auto x = linalg::least_squares(A.view(), std::vector<double>{2, 4});
    EXPECT_NEAR(x[0], 1, 1e-12);
    EXPECT_NEAR(x[1], 1, 1e-12);
}
