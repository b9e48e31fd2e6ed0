/// The ledger of sizes: no codec's files grow unnoticed. MESHREEL_UPDATE=1 renews tests/ledger/sizes.csv.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <string>

#include "meshreel/codecs/codec.h"
#include "meshreel/mesh/shapes.h"
#include "meshreel/meshreel.h"

using namespace meshreel;

namespace {

const std::string ledger_path = MESHREEL_SOURCE_DIR "/tests/ledger/sizes.csv";

/// Bytes of a made sequence's file at a fixed setting.
std::size_t size_of(const codecs::Codec& codec, const std::string& shape)
{
    const Animation animation = *shapes::generate(*shapes::find(shape), {.vertices = 400, .frames = 40});
    EncodeOptions options;
    options.codec = codec.name;
    options.order = Order::free;
    if (!codec.exact()) {
        options.quality.step = 0.0005;
        options.quality.bases = 20;
    }
    const auto encoded = encode(animation, options);
    EXPECT_TRUE(encoded.ok()) << encoded.error().sentence();
    return encoded.ok() ? encoded->bytes.size() : 0;
}

std::map<std::string, std::size_t> ledger()
{
    std::map<std::string, std::size_t> sizes;
    std::ifstream file(ledger_path);
    for (std::string line; std::getline(file, line);) {
        const std::size_t comma = line.rfind(',');
        sizes[line.substr(0, comma)] = std::stoul(line.substr(comma + 1));
    }
    return sizes;
}

} // namespace

TEST(Ledger, HoldsTheSizeOfEveryCodecOnMadeSequences)
{
    const bool updating = std::getenv("MESHREEL_UPDATE") != nullptr;
    const auto known = ledger();
    std::ostringstream renewed;
    for (const codecs::Codec& codec : codecs::all())
        for (const std::string shape : {"cloth", "jelly", "walker", "snake"}) {
            const std::string key = std::string(codec.name) + "," + shape;
            const std::size_t size = size_of(codec, shape);
            renewed << key << ',' << size << '\n';
            if (updating) continue;
            ASSERT_TRUE(known.contains(key)) << key << " is not in the ledger";
            EXPECT_LE(size, known.at(key)) << key << " has grown";
        }
    if (updating) std::ofstream(ledger_path) << renewed.str();
}
