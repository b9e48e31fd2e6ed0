/// Files of every format version decode to the very same positions, whatever the machine, compiler and flags.
// SPDX-License-Identifier: MIT
#include <cmath>

#include <gtest/gtest.h>

#include "meshreel/container/stream.h"
#include "meshreel/mesh/shapes.h"
#include "meshreel/meshreel.h"
#include "tests/container/generated.h"

using namespace meshreel;

namespace {

struct Golden {
    std::string codec, name;
    BasisCoding basis;
    Entropy entropy;

    std::string file() const { return "tests/golden/" + codec + "_v1_" + name + ".reel"; }
    std::string hash_file() const { return "tests/golden/" + codec + "_v1_" + name + ".xxh3"; }
};

const Golden goldens[] = {
    {"coddyac", "raw_huffman", BasisCoding::raw, Entropy::huffman},
    {"coddyac", "raw_range", BasisCoding::raw, Entropy::range},
    {"coddyac", "uniform_huffman", BasisCoding::uniform, Entropy::huffman},
    {"coddyac", "uniform_range", BasisCoding::uniform, Entropy::range},
    {"coddyac", "cobra_huffman", BasisCoding::cobra, Entropy::huffman},
    {"coddyac", "cobra_range", BasisCoding::cobra, Entropy::range},
    {"coddyac", "lpc1_huffman", BasisCoding::lpc1, Entropy::huffman},
    {"coddyac", "lpc1_range", BasisCoding::lpc1, Entropy::range},
    {"coddyac", "lpc2_huffman", BasisCoding::lpc2, Entropy::huffman},
    {"coddyac", "lpc2_range", BasisCoding::lpc2, Entropy::range},
    {"coddyac", "lpc3_huffman", BasisCoding::lpc3, Entropy::huffman},
    {"coddyac", "lpc3_range", BasisCoding::lpc3, Entropy::range},
    {"coddyac", "lpc4_huffman", BasisCoding::lpc4, Entropy::huffman},
    {"coddyac", "lpc4_range", BasisCoding::lpc4, Entropy::range},
    {"na", "cobra_huffman", BasisCoding::cobra, Entropy::huffman},
    {"na", "cobra_range", BasisCoding::cobra, Entropy::range},
    {"lsp", "cobra_huffman", BasisCoding::cobra, Entropy::huffman},
    {"lsp", "cobra_range", BasisCoding::cobra, Entropy::range},
    {"rbfp", "cobra_huffman", BasisCoding::cobra, Entropy::huffman},
    {"rbfp", "cobra_range", BasisCoding::cobra, Entropy::range},
    {"reel", "range", BasisCoding::cobra, Entropy::range},
    {"lossless", "floats", BasisCoding::cobra, Entropy::range},
    {"lossless", "text", BasisCoding::cobra, Entropy::range},
};

/// XXH3-64 of the positions' bits, little-endian, as hexadecimal digits.
std::string hash_of_positions(const Animation& animation)
{
    Bytes bits(animation.positions.size() * 4);
    for (std::size_t i = 0; i < animation.positions.size(); ++i)
        container::store_real(animation.positions[i], bits.data() + 4 * i);
    char text[20];
    std::snprintf(text, sizeof text, "%016llx\n", static_cast<unsigned long long>(container::hash_of(bits)));
    return text;
}

/// Made anew only with MESHREEL_UPDATE: an encoder may become better, old files stay.
void make(const Golden& golden)
{
    Animation cloth = *shapes::generate(*shapes::find("cloth"), {.vertices = 150, .frames = 16});
    EncodeOptions options;
    options.codec = golden.codec;
    if (golden.codec != "lossless") options.quality.max_error_relative = 0.5;
    if (golden.name == "text")
        for (float& x : cloth.positions) x = 1.7f * std::round(1e4f * x) / 1e4f;
    options.basis = golden.basis;
    options.entropy = golden.entropy;
    const Bytes reel = encode(cloth, options)->bytes;
    write_text(golden.file(), std::string(reel.begin(), reel.end()));
}

class GoldenFile : public testing::TestWithParam<Golden> {};

INSTANTIATE_TEST_SUITE_P(Version1, GoldenFile, testing::ValuesIn(goldens),
                         [](const auto& row) { return row.param.codec + "_" + row.param.name; });

} // namespace

TEST_P(GoldenFile, DecodesToTheSamePositionsBitForBit)
{
    if (updating()) make(GetParam());
    const std::string text = text_of(GetParam().file());
    const auto animation = decode({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
    ASSERT_TRUE(animation.ok()) << animation.error().sentence();
    expect_file(GetParam().hash_file(), hash_of_positions(*animation));
}
