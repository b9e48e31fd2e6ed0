/// Files of every format version decode to the very same meaning, whatever the machine, compiler and flags.
// SPDX-License-Identifier: MIT
#include <filesystem>

#include <gtest/gtest.h>

#include "tests/container/generated.h"
#include "tests/determinism/goldens.h"
#include "tests/determinism/meaning.h"

using namespace meshreel;

namespace {

ByteView bytes_of(const std::string& text)
{
    return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

/// The base mesh of a golden file, if it has one.
std::optional<Animation> base_of(const golden::Golden& row)
{
    if (row.base.empty()) return std::nullopt;
    return *decode(bytes_of(text_of("tests/golden/" + row.base + ".reel")));
}

void make(const golden::Golden& row, const Animation* base)
{
    if (std::filesystem::exists(std::string(MESHREEL_SOURCE_DIR) + "/" + row.file())) return;
    EncodeOptions options = row.options;
    options.base = base;
    const auto encoded = encode(row.make(), options);
    ASSERT_TRUE(encoded.ok()) << encoded.error().sentence();
    const Bytes file = row.change ? row.change(row.make(), encoded->bytes) : encoded->bytes;
    write_text(row.file(), std::string(file.begin(), file.end()));
}

class GoldenFile : public testing::TestWithParam<golden::Golden> {};

INSTANTIATE_TEST_SUITE_P(Version1, GoldenFile, testing::ValuesIn(golden::all()),
                         [](const auto& row) { return row.param.name; });

} // namespace

TEST_P(GoldenFile, DecodesToTheSameMeaningBitForBit)
{
    const golden::Golden& row = GetParam();
    const std::optional<Animation> base = base_of(row);
    if (updating()) make(row, base ? &*base : nullptr);
    const std::string file = text_of(row.file());
    auto meaning = golden::meaning_of(bytes_of(file), base ? &*base : nullptr);
    ASSERT_TRUE(meaning.ok()) << meaning.error().sentence();
    if (!row.base.empty()) (*meaning)["base"] = row.base;
    expect_file(row.meaning_file(), meaning->dump(1) + "\n");
}
