/// Guesses that keep distances: nearer to what does not stretch, nothing where nothing is measured, always defined.
// SPDX-License-Identifier: MIT
#include "meshreel/codecs/length_guess.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "meshreel/codecs/codec.h"
#include "meshreel/mesh/shapes.h"
#include "tests/codecs/fixture.h"
#include "tests/codecs/strip.h"

using namespace meshreel;

namespace {

using codecs::Interpolation;
using codecs::LengthGuess;

constexpr std::uint32_t guessed_vertex = 5 * rows + 1;
constexpr std::size_t known = 3;

/// The vertices around one, and another 13th and so not measured that has all the weight: what is guessed.
Interpolation::Weights around(std::uint32_t v, std::uint32_t guess)
{
    Interpolation::Weights weights;
    for (std::uint32_t u = v - 1 - rows; weights.count < 12; ++u)
        if (u != v) weights.vertices[weights.count++] = u;
    weights.values[weights.count] = 1.0;
    weights.vertices[weights.count++] = guess;
    return weights;
}

/// What is added to a vertex' guesses from all 13 vertices, or fewer; vertex 0 is what is guessed.
std::vector<double> corrections_of(const Posed& posed, std::size_t count = 13, Threads threads = {1})
{
    LengthGuess lengths(posed.basis, posed.C.rows, threads);
    std::vector<std::uint32_t> all(posed.C.rows);
    std::iota(all.begin(), all.end(), 0u);
    lengths.know(all, posed.C.view());
    const std::vector<std::uint32_t> vertices(40, guessed_vertex);
    Interpolation::Weights near = around(guessed_vertex, 0);
    near.count = count;
    const std::vector<Interpolation::Weights> weights(40, near);
    const Matrix<double> found = lengths.corrections(vertices, weights, posed.C.view(), {known, posed.C.cols});
    EXPECT_TRUE(std::ranges::equal(found.row(0), found.row(39)));
    return {found.row(0).begin(), found.row(0).end()};
}

} // namespace

TEST(LengthGuess, AVertexOfAStripThatBendsButDoesNotStretchIsGuessedNearerToTheTruth)
{
    Posed posed = rolling(40, unstretched);
    std::ranges::copy(noisy(posed, 0.2).C.row(guessed_vertex), posed.C.row(0).begin());
    const std::vector<double> more = corrections_of(posed);
    double plain = 0, corrected = 0;
    for (std::size_t i = 0; i < more.size(); ++i) {
        const double missed = posed.C(0, known + i) - posed.C(guessed_vertex, known + i);
        plain += missed * missed;
        corrected += (missed + more[i]) * (missed + more[i]);
    }
    EXPECT_LT(corrected, 0.5 * plain);
}

TEST(LengthGuess, ThereIsNothingToMeasureWithFewerThanTwoNeighbours)
{
    const Posed bent = rolling(9, unstretched);
    for (std::size_t count : {0u, 1u})
        for (double more : corrections_of(bent, count)) EXPECT_EQ(more, 0.0);
}

TEST(LengthGuess, VerticesThatAreOneGiveNumbers)
{
    Posed posed = rolling(9, unstretched);
    for (const std::uint32_t u : {0u, guessed_vertex - rows, guessed_vertex + rows})
        std::ranges::copy(posed.C.row(guessed_vertex), posed.C.row(u).begin());
    for (double more : corrections_of(posed)) EXPECT_TRUE(std::isfinite(more));
    std::ranges::fill(posed.C.values, 0.0);
    for (double more : corrections_of(posed)) EXPECT_EQ(more, 0.0);
    std::ranges::fill(posed.C.values, 1e30);
    posed.C(guessed_vertex, 0) = -1e30;
    for (double more : corrections_of(posed)) EXPECT_TRUE(std::isfinite(more));
}

TEST(LengthGuess, TheSameBitsForAnyNumberOfThreads)
{
    const Posed posed = noisy(rolling(43, unstretched), 0.05);
    for (unsigned threads : {2u, 5u}) EXPECT_EQ(corrections_of(posed, 13, {threads}), corrections_of(posed));
}

TEST(LengthGuess, TheSameNumbersOnEveryMachine)
{
    Posed posed(columns * rows, 11);
    for (std::size_t v = 0; v < columns * rows; ++v)
        for (std::size_t f = 0; f < 11; ++f) {
            posed.C(v, f) = static_cast<double>(v / rows);
            posed.C(v, 11 + f) = static_cast<double>(v % rows * f) / 8;
        }
    double sum = 0;
    for (double more : corrections_of(noisy(posed, 0.25))) sum = 0.5 * sum + more;
    EXPECT_EQ(sum, -0x1.46a200148e855p-7);
}

TEST(LengthGuess, WhatDoesNotFitInTheMemoryLimitIsRefusedAtTheField)
{
    const Prepared cloth(*shapes::generate(*shapes::find("cloth"), {.vertices = 400, .frames = 30}));
    const codecs::Codec& reel = *codecs::find("reel");
    const Bytes payload = reel.prepare(cloth.sequence(), 9, {1})
                              ->encode({.step = 1e-3, .bases = 9, .lengths = true, .threads = {1}})
                              .payload;
    EXPECT_TRUE(decoded(reel, payload, cloth).ok());
    const Result<Matrix<float>> refused = decoded(reel, payload, cloth, {.max_memory = 300'000});
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().field, "SEGM.ways");
}

TEST(LengthGuess, MoreWorkThanAFewBytesMayCauseIsRefused)
{
    const Prepared cloth(*shapes::generate(*shapes::find("cloth"), {.vertices = 400, .frames = 100}));
    const codecs::Codec& reel = *codecs::find("reel");
    const auto encoder = reel.prepare(cloth.sequence(), 12, {1});
    const auto payload = [&](double step, bool lengths) {
        return encoder->encode({.step = step, .bases = 12, .lengths = lengths, .threads = {1}}).payload;
    };
    const Bytes fine = payload(1e-3, true);
    EXPECT_NE(fine, payload(1e-3, false));
    EXPECT_TRUE(decoded(reel, fine, cloth).ok());
    const Result<Matrix<float>> refused = decoded(reel, fine, cloth, {.max_work = 100});
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().field, "SEGM.ways");
}
