/// Least squares prediction, against its equations.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <limits>
#include <vector>

#include "meshreel/base/random.h"
#include "meshreel/predict/lsp.h"

using namespace meshreel;
using predict::Lsp;

namespace {

constexpr double tiny_step = 1e-9;

std::vector<double> random_values(Random& random, std::size_t n)
{
    std::vector<double> y(n);
    for (double& value : y) value = random.uniform(-5, 5);
    return y;
}

double weighted(const std::vector<double>& y, const std::vector<double>& w)
{
    double sum = 0;
    for (std::size_t i = 0; i < y.size(); ++i) sum += w[i] * y[i];
    return sum;
}

} // namespace

TEST(Lsp, AveragesUntilThereAreAsManyRowsAsNeighbours)
{
    Lsp predictor(tiny_step);
    predictor.start(2);
    EXPECT_DOUBLE_EQ(predictor.guess(std::vector{1.0, 3.0}), 2.0); // (8.4)
    predictor.learn(std::vector{1.0, 3.0}, 1.5);
    EXPECT_DOUBLE_EQ(predictor.guess(std::vector{5.0, 7.0}), 6.0); // one row, two neighbours
}

TEST(Lsp, SolvesTheRowsItKnows)
{
    // w1 + 3 w2 = 1 and 2 w1 - w2 = 2 have w = (1, 0): (8.5); the next component is the first neighbour's: (8.6).
    Lsp predictor(tiny_step);
    predictor.start(2);
    predictor.learn(std::vector{1.0, 3.0}, 1.0);
    predictor.learn(std::vector{2.0, -1.0}, 2.0);
    EXPECT_NEAR(predictor.guess(std::vector{40.0, 17.0}), 40.0, 1e-9);
}

TEST(Lsp, FindsWeightsThatFitEverything)
{
    Random random(2);
    const std::vector<double> w{0.4, 0.3, 0.5, -0.1, -0.2, 0.15};
    Lsp predictor(tiny_step);
    predictor.start(w.size());
    for (int k = 0; k < 20; ++k) {
        const std::vector<double> y = random_values(random, w.size());
        if (k >= 6) {
            EXPECT_NEAR(predictor.guess(y), weighted(y, w), 1e-6);
        }
        predictor.learn(y, weighted(y, w));
    }
}

TEST(Lsp, IsTheLeastSquaresFitOfAllRowsDrawnToTheAverage)
{
    Random random(3);
    const double step = 0.5;
    Eigen::MatrixXd A(9, 4);
    Eigen::VectorXd v(9);
    Lsp predictor(step);
    predictor.start(4);
    for (int k = 0; k < 9; ++k) {
        const std::vector<double> y = random_values(random, 4);
        for (int i = 0; i < 4; ++i) A(k, i) = y[static_cast<std::size_t>(i)];
        v(k) = random.uniform(-5, 5);
        predictor.learn(y, v(k));
    }
    const Eigen::Matrix4d normal = A.transpose() * A + step * step * Eigen::Matrix4d::Identity();
    const Eigen::Vector4d right = A.transpose() * v + Eigen::Vector4d::Constant(step * step / 4);
    const Eigen::Vector4d w = normal.ldlt().solve(right);
    const std::vector<double> y = random_values(random, 4);
    EXPECT_NEAR(predictor.guess(y), weighted(y, {w(0), w(1), w(2), w(3)}), 1e-9);
}

TEST(Lsp, CountsNeighboursThatWereEqualSoFarOnce)
{
    // Neighbours 0 and 1 are equal: one row is enough for one weight, 2 w = 3.
    Lsp predictor(tiny_step);
    predictor.start(2);
    predictor.learn(std::vector{2.0, 2.0}, 3.0);
    EXPECT_NEAR(predictor.guess(std::vector{4.0, 4.0}), 6.0, 1e-9);
    predictor.learn(std::vector{4.0, 5.0}, 6.0); // now they differ: 2 w1 + 2 w2 = 3, 4 w1 + 5 w2 = 6
    EXPECT_NEAR(predictor.guess(std::vector{1.0, 100.0}), 1.5, 1e-6);
}

TEST(Lsp, KeepsNeighboursApartThatAreNoNumbers)
{
    const double none = std::numeric_limits<double>::quiet_NaN();
    Lsp predictor(tiny_step);
    predictor.start(2);
    predictor.learn(std::vector{none, none}, 1.0);
    EXPECT_DOUBLE_EQ(predictor.guess(std::vector{1.0, 3.0}), 2.0) << "two neighbours, one row: the average";
}

TEST(Lsp, ForgetsTheVertexBefore)
{
    Lsp predictor(tiny_step);
    predictor.start(1);
    predictor.learn(std::vector{1.0}, 7.0);
    predictor.start(3);
    EXPECT_DOUBLE_EQ(predictor.guess(std::vector{1.0, 2.0, 3.0}), 2.0);
}
