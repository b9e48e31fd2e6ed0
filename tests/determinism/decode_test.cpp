/// The decoder and the generators compute the same bits in every build: -O0, -O3 -march=native, sanitizers.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "meshreel/base/file.h"
#include "meshreel/meshreel.h"

using namespace meshreel;
namespace fs = std::filesystem;

namespace {

const fs::path golden = fs::path(MESHREEL_SOURCE_DIR) / "tests/golden";

/// FNV-1a over the bytes of the positions: written here, so that no library stands between the bits and the number.
std::string hash_of(const Animation& animation)
{
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (std::uint8_t byte : std::span(reinterpret_cast<const std::uint8_t*>(animation.positions.data()),
                                       animation.positions.size() * sizeof(float)))
        hash = (hash ^ byte) * 0x100000001b3u;
    std::ostringstream text;
    text << std::hex << hash;
    return text.str();
}

/// The lines "NAME HASH" of tests/golden/hashes.txt.
std::map<std::string, std::string> golden_hashes()
{
    std::ifstream file(golden / "hashes.txt");
    std::map<std::string, std::string> hashes;
    for (std::string name, hash; file >> name >> hash;) hashes[name] = hash;
    return hashes;
}

std::vector<fs::path> golden_files()
{
    std::vector<fs::path> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(golden))
        if (entry.path().extension() == ".reel") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

} // namespace

TEST(Determinism, EveryGoldenFileHasItsHashAndEveryHashItsFile)
{
    const auto hashes = golden_hashes();
    EXPECT_FALSE(hashes.empty());
    for (const fs::path& file : golden_files()) EXPECT_TRUE(hashes.contains(file.filename().string())) << file;
    for (const auto& [name, hash] : hashes) EXPECT_TRUE(fs::exists(golden / name)) << name;
}

TEST(Determinism, TheDecoderGivesTheGoldenPositionsBitForBit)
{
    const auto hashes = golden_hashes();
    for (const fs::path& file : golden_files()) {
        const auto bytes = read_file(file.string());
        ASSERT_TRUE(bytes.ok()) << bytes.error().sentence();
        const auto decoded = decode(*bytes);
        ASSERT_TRUE(decoded.ok()) << file << ": " << decoded.error().sentence();
        EXPECT_EQ(hash_of(*decoded), hashes.at(file.filename().string())) << file;
    }
}
