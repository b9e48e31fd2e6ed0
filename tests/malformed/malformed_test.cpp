/// What fuzzing found, by number: once it made a reader, decoder, writer or player fail; README.md says how.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include <gtest/gtest.h>

#include "meshreel/base/file.h"
#include "meshreel/io/obj.h"
#include "meshreel/io/off.h"
#include "meshreel/io/ply.h"
#include "meshreel/meshreel.h"
#include "meshreel/player/player.h"

using namespace meshreel;

namespace {

const std::filesystem::path malformed_folder = MESHREEL_SOURCE_DIR "/tests/malformed";

struct TextFormat {
    Result<Animation> (*parse)(ByteView, const io::LoadOptions&);
    Result<Bytes> (*write)(const Animation&, std::size_t frame, const io::SaveOptions&);
};
const std::map<std::string, TextFormat> formats{{".obj", {io::parse_obj, io::write_obj}},
                                                {".off", {io::parse_off, io::write_off}},
                                                {".ply", {io::parse_ply, io::write_ply}}};

/// Refused with a sentence, or written so that it is read again with everything that it has.
void read_and_written(const TextFormat& format, ByteView bytes)
{
    const auto read = format.parse(bytes, {});
    EXPECT_TRUE(read.ok() || !read.error().sentence().empty());
    if (!read.ok()) return;
    const auto written = format.write(*read, 0, {});
    ASSERT_TRUE(written.ok()) << written.error().sentence();
    const auto again = format.parse(*written, {});
    ASSERT_TRUE(again.ok()) << again.error().sentence();
    EXPECT_EQ(again->positions, read->positions);
    EXPECT_EQ(again->triangles, read->triangles);
    ASSERT_EQ(again->appearance.attributes.size(), read->appearance.attributes.size());
    for (std::size_t i = 0; i < read->appearance.attributes.size(); ++i)
        EXPECT_EQ(again->appearance.attributes[i].values, read->appearance.attributes[i].values) << i;
}

/// Refused with a sentence, or valid; the player's frames, if it opens, have no number that is not finite.
void decoded_and_played(ByteView bytes)
{
    const auto decoded = decode(bytes);
    EXPECT_TRUE(decoded.ok() ? validate(*decoded).ok() : !decoded.error().sentence().empty());
    EXPECT_TRUE(info(bytes).ok());
    auto player = player::Player::open(bytes);
    EXPECT_EQ(player.ok(), decoded.ok());
    if (!player.ok()) return;
    std::vector<float> frame(3ul * player->vertex_count());
    player->pose(frame);
    EXPECT_TRUE(std::ranges::all_of(frame, [](float x) { return std::isfinite(x); }));
}

std::vector<std::string> all_findings()
{
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(malformed_folder))
        if (std::isdigit(static_cast<unsigned char>(entry.path().filename().string().front())) != 0)
            names.push_back(entry.path().filename().string());
    std::ranges::sort(names);
    return names;
}

class EveryFinding : public testing::TestWithParam<std::string> {};

} // namespace

INSTANTIATE_TEST_SUITE_P(Malformed, EveryFinding, testing::ValuesIn(all_findings()), [](const auto& finding) {
    std::string name = finding.param;
    std::ranges::replace_if(
        name, [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
    return name;
});

TEST_P(EveryFinding, IsRefusedInASentenceOrKeepsItsPromise)
{
    const std::filesystem::path path = malformed_folder / GetParam();
    const auto bytes = read_file(path.string());
    ASSERT_TRUE(bytes.ok()) << bytes.error().sentence();
    if (path.extension() == ".reel") return decoded_and_played(*bytes);
    const auto format = formats.find(path.extension().string());
    ASSERT_NE(format, formats.end()) << "of which kind is it?";
    read_and_written(format->second, *bytes);
}

TEST(Malformed, AFileWhosePositionsOverflowIsRefusedByFrameAndVertex)
{
    const auto bytes = read_file((malformed_folder / "011-decoded-beyond-float32.reel").string());
    ASSERT_TRUE(bytes.ok()) << bytes.error().sentence();
    EXPECT_EQ(decode(*bytes).error().sentence(), "positions: frame 0, vertex 0, y is infinite");
}
