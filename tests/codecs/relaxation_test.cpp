/// Relaxation towards edge lengths: nearer to what does not stretch, hardly any change to what does, always defined.
// SPDX-License-Identifier: MIT
#include "meshreel/codecs/relaxation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "meshreel/codecs/codec.h"
#include "meshreel/mesh/shapes.h"
#include "tests/codecs/fixture.h"
#include "tests/codecs/strip.h"

using namespace meshreel;

namespace {

constexpr double usual_noise = 0.05 * 0.05 / 6; // of lengths between places noisy by 0.05: twice that of a coordinate

Posed relaxed(Posed posed, std::span<const Triangle> triangles, double noise = usual_noise, Threads threads = {1})
{
    codecs::Relaxation(triangles, posed.basis, threads).relax(posed.C.view(), noise);
    return posed;
}

/// Frames [F x 3W] as an encoder has them.
Matrix<float> frames_of(const Posed& posed)
{
    const std::size_t W = posed.C.rows, F = posed.C.cols / 3;
    Matrix<float> frames(F, 3 * W);
    for (std::size_t f = 0; f < F; ++f)
        for (std::size_t v = 0; v < W; ++v)
            for (std::size_t c = 0; c < 3; ++c) frames(f, 3 * v + c) = static_cast<float>(posed.C(v, c * F + f));
    return frames;
}

} // namespace

TEST(Relaxation, AStripThatBendsButDoesNotStretchComesNearerToTheTruth)
{
    const Posed truth = rolling(40, unstretched), decoded = noisy(truth, 0.05);
    EXPECT_LT(relaxed(decoded, strip()).distance(truth), 0.85 * decoded.distance(truth));
}

TEST(Relaxation, TheNoiseOfLengthsIsThatOfTheirEndsAlongThem)
{
    const Posed truth = rolling(100, unstretched), decoded = noisy(truth, 0.05);
    const double noise =
        codecs::Relaxation(strip(), decoded.basis, {2}).noise_of(decoded.C.view(), frames_of(truth).view());
    EXPECT_NEAR(noise, usual_noise, 0.1 * usual_noise);
}

TEST(Relaxation, ThePartThatStretchesFarBeyondTheNoiseIsLeftNearlyAlone)
{
    const Posed truth = rolling(40, [](double time) { return 1.0 + 0.5 * time; }), decoded = noisy(truth, 0.01);
    EXPECT_LT(relaxed(decoded, strip(), usual_noise / 25).distance(truth), 1.05 * decoded.distance(truth));
}

TEST(Relaxation, TheSameBitsForAnyNumberOfThreads)
{
    const Posed decoded = noisy(rolling(301, unstretched), 0.05); // several runs of blocks, the last block not full
    const Posed one = relaxed(decoded, strip());
    for (unsigned threads : {2u, 5u})
        EXPECT_EQ(relaxed(decoded, strip(), usual_noise, {threads}).C.values, one.C.values);
}

TEST(Relaxation, TheSameNumbersOnEveryMachine)
{
    Posed flat(columns * rows, 21);
    for (std::size_t v = 0; v < columns * rows; ++v)
        for (std::size_t f = 0; f < 21; ++f) {
            flat.C(v, f) = static_cast<double>(v / rows);
            flat.C(v, 42 + f) = static_cast<double>(v % rows);
        }
    const Posed after = relaxed(noisy(flat, 0.1), strip());
    double sum = 0;
    for (std::size_t i = 0; i < after.C.values.size(); ++i) sum += after.C.values[i] * static_cast<double>(i % 7);
    EXPECT_EQ(sum, 0x1.4aa55aa7fefadp+14);
}

TEST(Relaxation, NothingChangesWithoutNoiseTrianglesComponentsOrFurtherFrames)
{
    const Posed decoded = noisy(rolling(9, unstretched), 0.05), still = noisy(rolling(1, unstretched), 0.05);
    EXPECT_EQ(relaxed(decoded, strip(), 0).C.values, decoded.C.values);
    EXPECT_EQ(relaxed(decoded, {}).C.values, decoded.C.values);
    EXPECT_EQ(relaxed(still, strip()).C.values, still.C.values);
    codecs::Basis mean{std::vector<double>(27), Matrix<double>(0, 27)};
    Matrix<double> none(columns * rows, 0);
    codecs::Relaxation(strip(), mean, {}).relax(none.view(), usual_noise);
}

TEST(Relaxation, DegenerateTrianglesAndEdgesWithoutLengthGiveNumbers)
{
    Posed decoded = noisy(rolling(9, unstretched), 0.05);
    std::ranges::copy(decoded.C.row(0), decoded.C.row(1).begin()); // an edge of length 0 in every frame
    for (std::size_t f = 0; f < 27; ++f) decoded.C(2, f) = f % 2 == 0 ? decoded.C(0, f) : decoded.C(2, f);
    std::vector<Triangle> triangles = strip();
    triangles.push_back({3, 3, 3});
    triangles.push_back({5, 5, 9});
    for (double c : relaxed(decoded, triangles).C.values) ASSERT_TRUE(std::isfinite(c));
}

TEST(Relaxation, VerticesWithoutTrianglesStayWhereTheyAre)
{
    const Posed decoded = noisy(rolling(9, unstretched), 0.05);
    std::vector<Triangle> triangles = strip();
    std::erase_if(triangles, [](const Triangle& t) { return std::ranges::find(t, 0u) != t.end(); });
    const Posed after = relaxed(decoded, triangles);
    EXPECT_TRUE(std::ranges::equal(after.C.row(0), decoded.C.row(0)));
    EXPECT_FALSE(std::ranges::equal(after.C.row(20), decoded.C.row(20)));
}

TEST(Relaxation, WhatDoesNotFitInTheMemoryLimitIsRefusedAtTheField)
{
    const Prepared cloth(*shapes::generate(*shapes::find("cloth"), {.vertices = 400, .frames = 30}));
    const codecs::Codec& reel = *codecs::find("reel");
    const Bytes payload = reel.prepare(cloth.sequence(), 9, {1})
                              ->encode({.step = 1e-3, .bases = 3, .relax = true, .threads = {1}})
                              .payload;
    EXPECT_TRUE(decoded(reel, payload, cloth).ok());
    const Result<Matrix<float>> refused = decoded(reel, payload, cloth, {.max_memory = 200'000});
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().field, "SEGM.length_noise");
}
