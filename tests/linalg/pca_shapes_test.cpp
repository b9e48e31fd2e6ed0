/// Modes of shapes: they give back the frames, in the order of their weight, within the tolerance.
// SPDX-License-Identifier: MIT
#include "meshreel/linalg/pca_shapes.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace meshreel;
using namespace meshreel::linalg;

namespace {

/// F frames of N vertices made of `rank` shapes.
Matrix<float> shapes_of_rank(std::size_t F, std::size_t N, std::size_t rank)
{
    Matrix<float> frames(F, 3 * N);
    for (std::size_t f = 0; f < F; ++f)
        for (std::size_t i = 0; i < 3 * N; ++i) {
            double value = std::cos(double(i));
            for (std::size_t k = 1; k <= rank; ++k)
                value += std::sin(0.37 * double(k * f)) * std::sin(0.11 * double(k * i)) / double(k * k);
            frames(f, i) = static_cast<float>(value);
        }
    return frames;
}

double rebuilt_error(const Matrix<float>& frames, const ShapeModes& shapes)
{
    double largest = 0;
    for (std::size_t f = 0; f < frames.rows; ++f)
        for (std::size_t v = 0; v < frames.cols / 3; ++v) {
            double square = 0;
            for (std::size_t i = 3 * v; i < 3 * v + 3; ++i) {
                double value = shapes.base[i];
                for (std::size_t k = 0; k < shapes.modes.rows; ++k)
                    value += double(shapes.weights(f, k)) * double(shapes.modes(k, i));
                square += (value - frames(f, i)) * (value - frames(f, i));
            }
            largest = std::max(largest, std::sqrt(square));
        }
    return largest;
}

} // namespace

TEST(PcaOfShapes, FindsTheRankAndGivesTheFramesBack)
{
    const Matrix<float> frames = shapes_of_rank(40, 700, 3);
    const ShapeModes shapes = pca_of_shapes(frames.view(), {0, 1e-5, {}, {}});
    EXPECT_EQ(shapes.modes.rows, 3u);
    EXPECT_LT(rebuilt_error(frames, shapes), 1.1e-5);
    EXPECT_NEAR(rebuilt_error(frames, shapes), shapes.largest_error, 1e-9);
}

TEST(PcaOfShapes, TakesAsFewModesAsTheToleranceAllows)
{
    const Matrix<float> frames = shapes_of_rank(60, 200, 20);
    const ShapeModes shapes = pca_of_shapes(frames.view(), {0, 0.05, {}, {}});
    EXPECT_LE(shapes.largest_error, 0.05 + 1e-6);
    const ShapeModes fewer = pca_of_shapes(frames.view(), {shapes.modes.rows - 1, 0, {}, {}});
    EXPECT_GT(fewer.largest_error, 0.05);
}

TEST(PcaOfShapes, EachModesWeightsReachFromZeroToOne)
{
    const ShapeModes shapes = pca_of_shapes(shapes_of_rank(30, 50, 4).view(), {4, 0, {}, {}});
    for (std::size_t k = 0; k < shapes.weights.cols; ++k) {
        float low = 9, high = -9;
        for (std::size_t f = 0; f < 30; ++f) {
            low = std::min(low, shapes.weights(f, k));
            high = std::max(high, shapes.weights(f, k));
        }
        EXPECT_EQ(low, 0.0f);
        EXPECT_EQ(high, 1.0f);
    }
}

TEST(PcaOfShapes, WithoutMotionThereIsNoMode)
{
    const ShapeModes shapes = pca_of_shapes(shapes_of_rank(5, 10, 0).view(), {0, 0, {}, {}});
    EXPECT_EQ(shapes.modes.rows, 0u);
    EXPECT_EQ(shapes.largest_error, 0.0);
}

TEST(PcaOfShapes, IsTheSameForAnyNumberOfThreads)
{
    const Matrix<float> frames = shapes_of_rank(150, 1500, 9);
    const ShapeModes one = pca_of_shapes(frames.view(), {0, 1e-4, {1}, {}}),
                     three = pca_of_shapes(frames.view(), {0, 1e-4, {3}, {}});
    EXPECT_EQ(one.modes.values, three.modes.values);
    EXPECT_EQ(one.weights.values, three.weights.values);
    EXPECT_EQ(one.base, three.base);
}
