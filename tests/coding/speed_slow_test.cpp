/// How fast the range coder is: a floor that catches a blunder, and the figure itself in the test's properties.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <chrono>

#include "meshreel/coding/range_coder.h"
#include "tests/coding/sources.h"

namespace meshreel::coding {
namespace {

template <class Coder>
double million_decisions_a_second(Coder& coder, const std::vector<std::uint8_t>& decisions)
{
    std::vector<Bit> models(64);
    const auto start = std::chrono::steady_clock::now();
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < decisions.size(); ++i)
        wrong += coder.bit(models[i & 63u], decisions[i] != 0) != (decisions[i] != 0);
    EXPECT_EQ(wrong, 0u);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    return static_cast<double>(decisions.size()) * 1e-6 / seconds.count();
}

TEST(range_coder, takes_millions_of_decisions_a_second)
{
    Random random(1);
    std::vector<std::uint8_t> decisions(8'000'000);
    for (std::uint8_t& decision : decisions) decision = random.below(5) == 0;
    RangeEncoder encoder;
    const double writing = million_decisions_a_second(encoder, decisions);
    const Bytes bytes = encoder.finish();
    RangeDecoder decoder(bytes);
    const double reading = million_decisions_a_second(decoder, decisions);
    RecordProperty("million_decisions_a_second",
                   std::to_string(writing) + " writing, " + std::to_string(reading) + " reading");
    EXPECT_GT(std::min(writing, reading), 1.0); // a sanitizer build on a busy machine still manages this
}

} // namespace
} // namespace meshreel::coding
