/// Small systems against Eigen, and what dependent rows give.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <vector>

#include "meshreel/base/random.h"
#include "meshreel/predict/small_solve.h"

using namespace meshreel;

TEST(SmallSolve, SolvesPositiveSystemsOfEverySize)
{
    Random random(1);
    for (std::size_t n = 1; n <= predict::most_neighbours; ++n) {
        const auto size = static_cast<Eigen::Index>(n);
        const Eigen::MatrixXd half = Eigen::MatrixXd::NullaryExpr(size, size, [&] { return random.uniform(-1, 1); });
        const Eigen::MatrixXd A = half * half.transpose() + 0.1 * Eigen::MatrixXd::Identity(size, size);
        const Eigen::VectorXd b = Eigen::VectorXd::NullaryExpr(size, [&] { return random.uniform(-1, 1); });
        predict::SmallSolve system;
        system.resize(n);
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j <= i; ++j) system(i, j) = A(static_cast<int>(i), static_cast<int>(j));
        std::vector<double> x(b.data(), b.data() + n);
        system.solve(x);
        const Eigen::VectorXd wanted = A.ldlt().solve(b);
        for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(x[i], wanted(static_cast<int>(i)), 1e-9) << n;
    }
}

TEST(SmallSolve, GivesNothingToRowsThatDependOnThoseBefore)
{
    predict::SmallSolve system; // (2 2; 2 2) x = (6 6)
    system.resize(2);
    system(0, 0) = system(1, 0) = system(1, 1) = 2.0;
    std::vector<double> x{6.0, 6.0};
    system.solve(x);
    EXPECT_EQ(x, (std::vector{3.0, 0.0}));
}

TEST(SmallSolve, GivesZeroForTheZeroMatrix)
{
    predict::SmallSolve system;
    system.resize(1);
    system(0, 0) = 0.0;
    std::vector<double> x{1.0};
    system.solve(x);
    EXPECT_EQ(x[0], 0.0);
}
