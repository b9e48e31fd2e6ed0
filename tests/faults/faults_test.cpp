/// Whatever is wrong with a file, decoding ends in an error or a valid mesh. A small file of each codec.
// SPDX-License-Identifier: MIT
#include <cstdio>

#include <gtest/gtest.h>

#include "meshreel/codecs/codec.h"
#include "tests/faults/faults.h"
#include "tests/faults/file.h"

using namespace meshreel;

namespace {

/// Bits apart: all of them; under a sanitizer, which is slow, every seventh.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr std::size_t bit_stride = 7;
#else
constexpr std::size_t bit_stride = 1;
#endif

/// Says the sum as the program's last line.
struct Sum {
    std::uint64_t tried = 0;
    ~Sum() { std::printf("%llu faulty files tried\n", static_cast<unsigned long long>(tried)); }
};

class EveryFault : public testing::TestWithParam<codecs::Codec> {
protected:
    const Bytes file = faults::small_file(std::string(GetParam().name));

    void report(const char* what, const faults::Tally& tally) const
    {
        std::printf("%s, %s, %zu bytes: %s\n", std::string(GetParam().name).c_str(), what, file.size(),
                    tally.sentence().c_str());
        all.tried += tally.tried();
    }

private:
    static inline Sum all;
};

INSTANTIATE_TEST_SUITE_P(Registry, EveryFault, testing::ValuesIn(codecs::all().begin(), codecs::all().end()),
                         [](const auto& row) { return std::string(row.param.name); });

} // namespace

TEST_P(EveryFault, OfTruncationIsRefused)
{
    report("cut off at every byte", faults::truncations(file));
    report("every payload cut off at every byte", faults::truncated_payloads(file));
}

TEST_P(EveryFault, OfABitIsRefusedOrHarmless)
{
    report("every bit flipped", faults::flipped_bits(file, bit_stride));
    report("every bit of a payload flipped", faults::flipped_payload_bits(file, bit_stride));
}

TEST_P(EveryFault, OfTheOrderOfChunksIsRefusedOrHarmless)
{
    report("chunks swapped, repeated, missing", faults::shuffled_chunks(file));
}

TEST_P(EveryFault, OfANumberIsRefusedOrHarmless)
{
    report("every field at 0, 1, max - 1, max", faults::wild_fields(file));
}
