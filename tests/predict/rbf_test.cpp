/// Radial basis functions, against their equations.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <vector>

#include "meshreel/base/random.h"
#include "meshreel/predict/rbf.h"

using namespace meshreel;
using predict::Rbf;

namespace {

constexpr double point_step = 1e-9;

double phi(double r)
{
    return std::pow(std::abs(r), 1.75);
}

/// f(x) of (8.7) by the system (8.10) as it is printed. points: [N x d].
double interpolated(const Eigen::MatrixXd& points, const Eigen::VectorXd& y, const Eigen::VectorXd& x)
{
    const Eigen::Index N = points.rows();
    Eigen::MatrixXd A = Eigen::MatrixXd::Ones(N + 1, N + 1);
    for (Eigen::Index i = 0; i < N; ++i)
        for (Eigen::Index j = 0; j < N; ++j) A(i, j) = phi((points.row(i) - points.row(j)).norm());
    A(N, N) = 0;
    Eigen::VectorXd right = Eigen::VectorXd::Zero(N + 1);
    right.head(N) = y;
    const Eigen::VectorXd solution = A.fullPivLu().solve(right);
    double f = solution(N);
    for (Eigen::Index i = 0; i < N; ++i) f += solution(i) * phi((points.row(i).transpose() - x).norm());
    return f;
}

} // namespace

TEST(Rbf, KernelIsThePower175)
{
    for (double r : {1e-6, 0.3, 1.0, 2.0, 1e5}) EXPECT_NEAR(predict::radial(r * r), phi(r), 1e-13 * phi(r));
    EXPECT_EQ(predict::radial(0.0), 0.0);
}

TEST(Rbf, AveragesTheFirstComponent)
{
    Rbf predictor(point_step);
    predictor.start(3);
    EXPECT_DOUBLE_EQ(predictor.guess(std::vector{1.0, 2.0, 6.0}), 3.0); // (8.4)
}

TEST(Rbf, OfTwoNeighboursIsKnownInClosedForm)
{
    // Places 0 and 2, values 10 and 20: lambda_1 = -lambda_2 = 5 / phi(2), a = 15 (8.8), (8.9).
    Rbf predictor(point_step);
    predictor.start(2);
    predictor.learn(std::vector{0.0, 2.0}, 0.5);
    EXPECT_NEAR(predictor.guess(std::vector{10.0, 20.0}), 15 + 5 * (phi(0.5) - phi(1.5)) / phi(2), 1e-12); // (8.7)
}

TEST(Rbf, SolvesTheSystemThatThePaperPrints)
{
    Random random(4);
    for (int N = 2; N <= 10; ++N) {
        Eigen::MatrixXd points(N, 5);
        Eigen::VectorXd x(5), y(N);
        Rbf predictor(point_step);
        predictor.start(static_cast<std::size_t>(N));
        for (int k = 0; k < 5; ++k) {
            for (int i = 0; i < N; ++i) points(i, k) = random.uniform(-1, 1);
            x(k) = random.uniform(-1, 1);
            const Eigen::VectorXd column = points.col(k);
            predictor.learn(std::span(column.data(), static_cast<std::size_t>(N)), x(k));
        }
        for (double& value : y) value = random.uniform(-1, 1);
        EXPECT_NEAR(predictor.guess(std::span(y.data(), static_cast<std::size_t>(N))), interpolated(points, y, x),
                    1e-9);
    }
}

TEST(Rbf, IsExactWhereANeighbourIs)
{
    Rbf predictor(point_step);
    predictor.start(4);
    predictor.learn(std::vector{0.0, 1.0, 2.0, 5.0}, 2.0);
    predictor.learn(std::vector{3.0, 1.0, -1.0, 0.0}, -1.0);
    EXPECT_NEAR(predictor.guess(std::vector{7.0, 8.0, 9.5, 3.0}), 9.5, 1e-9);
}

TEST(Rbf, KeepsConstants)
{
    Rbf predictor(point_step);
    predictor.start(3);
    predictor.learn(std::vector{0.0, 1.0, 4.0}, 20.0);
    EXPECT_NEAR(predictor.guess(std::vector{-2.5, -2.5, -2.5}), -2.5, 1e-12);
}

TEST(Rbf, TakesNeighboursWithinAStepForOnePlace)
{
    // Places 0 (twice) and 2: the values there are (10 + 14) / 2 and 20.
    Rbf predictor(0.01);
    predictor.start(3);
    predictor.learn(std::vector{0.0, 0.005, 2.0}, 1.0);
    EXPECT_NEAR(predictor.guess(std::vector{10.0, 14.0, 20.0}), 16.0, 1e-9);
    predictor.start(3);
    predictor.learn(std::vector{0.0, 0.005, -0.005}, 1.0);
    EXPECT_NEAR(predictor.guess(std::vector{1.0, 2.0, 6.0}), 3.0, 1e-12) << "one place: the average";
}
