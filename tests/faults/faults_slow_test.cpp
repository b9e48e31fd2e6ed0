/// The same of every golden file: some of the truncations and bits, all of the fields.
// SPDX-License-Identifier: MIT
#include <cstdio>

#include <gtest/gtest.h>

#include "tests/faults/faults.h"
#include "tests/faults/file.h"

using namespace meshreel;

namespace {

class EveryGoldenFile : public testing::TestWithParam<std::string> {};

INSTANTIATE_TEST_SUITE_P(Version1, EveryGoldenFile, testing::ValuesIn(faults::golden_names()),
                         [](const auto& row) { return row.param; });

} // namespace

TEST_P(EveryGoldenFile, SurvivesEveryKindOfFault)
{
    const Bytes reel = faults::golden_file(GetParam());
    const std::size_t some = std::max<std::size_t>(7, reel.size() / 500),
                      few = std::max<std::size_t>(61, reel.size() / 60);
    faults::Tally all;
    for (const faults::Tally& one :
         {faults::truncations(reel, some), faults::truncated_payloads(reel, few), faults::flipped_bits(reel, some),
          faults::flipped_payload_bits(reel, few), faults::shuffled_chunks(reel), faults::wild_fields(reel)})
        all += one;
    std::printf("%s: %s\n", GetParam().c_str(), all.sentence().c_str());
}
