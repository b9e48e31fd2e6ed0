/// Levels of detail in a payload: where they end, and what is refused.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "meshreel/coding/varint.h"
#include "meshreel/mesh/shapes.h"
#include "tests/codecs/fixture.h"

using namespace meshreel;

namespace {

/// A payload with levels, and what it takes to decode it.
struct Leveled {
    explicit Leveled(const Animation& animation)
        : prepared(animation),
          payload(codec.prepare(prepared.sequence(), 100, {1})->encode({.step = 0.001, .threads = {1}}).payload)
    {
    }
    codecs::Coded coded(ByteView bytes) const
    {
        return {{bytes, 0, "SEGM"}, prepared.surface, prepared.frames.rows, {.max_memory = 1 << 26}, Threads{1}};
    }
    codecs::Detail detail() const { return *codec.detail(coded(payload)); }
    std::vector<std::uint64_t> ends() const { return *codec.level_bytes({payload, 0, "SEGM"}, {}); }
    Result<codecs::Trajectories> opened(ByteView bytes, std::span<const std::uint32_t> wanted) const
    {
        codecs::Coded part = coded(bytes);
        part.wanted = wanted;
        MESHREEL_TRY(codecs::Opened all, codecs::open(codec, part));
        return std::get<codecs::Trajectories>(std::move(all));
    }

    const codecs::Codec& codec = *codecs::find("reel");
    Prepared prepared;
    Bytes payload;
};

const Leveled& leveled_jelly()
{
    static const Leveled one(*shapes::generate(*shapes::find("jelly"), {.vertices = 2500, .frames = 12}));
    return one;
}

/// A number in the payload.
struct PlacedNumber {
    std::size_t place = 0, size = 0;
    std::string name;
    std::uint64_t value = 0;
};

PlacedNumber number_of(const Leveled& reel, const std::string& field)
{
    std::string lines;
    EXPECT_TRUE(reel.codec.explain({reel.payload, 0, "SEGM"}, {}, lines).ok());
    std::istringstream line(lines.substr(lines.rfind('\n', lines.find(field)) + 1));
    PlacedNumber number;
    line >> number.place >> number.size >> number.name >> number.value;
    EXPECT_EQ(number.name, field);
    return number;
}

/// Another number where that one stands.
Bytes replaced(Bytes payload, const PlacedNumber& number, std::uint64_t value)
{
    Bytes written;
    coding::put_varint(written, value);
    const auto at = payload.begin() + static_cast<std::ptrdiff_t>(number.place);
    payload.insert(payload.erase(at, at + static_cast<std::ptrdiff_t>(number.size)), written.begin(), written.end());
    return payload;
}

} // namespace

TEST(Detail, OfAPayloadCutAtALevelsEndIsTheSameToTheBit)
{
    const codecs::Detail detail = leveled_jelly().detail();
    const std::vector<std::uint64_t> ends = leveled_jelly().ends();
    ASSERT_EQ(ends.size(), detail.counts.size());
    ASSERT_EQ(ends.front(), leveled_jelly().payload.size());
    ASSERT_GE(ends.size(), 3u);
    for (std::size_t n = 0; n < ends.size(); ++n) {
        const auto kept = detail.kept(n);
        const auto part = leveled_jelly().opened(ByteView(leveled_jelly().payload).first(ends[n]), kept);
        ASSERT_TRUE(part.ok()) << part.error().sentence();
        EXPECT_EQ(part->C.values, leveled_jelly().opened(leveled_jelly().payload, kept)->C.values);
    }
}

TEST(Detail, OfAPayloadCutBeforeALevelsEndIsRefused)
{
    const codecs::Detail detail = leveled_jelly().detail();
    const std::vector<std::uint64_t> ends = leveled_jelly().ends();
    for (std::size_t n = 0; n < ends.size(); ++n) {
        const auto part = leveled_jelly().opened(ByteView(leveled_jelly().payload).first(ends[n] - 1), detail.kept(n));
        ASSERT_FALSE(part.ok());
        EXPECT_EQ(part.error().field, "SEGM.level_bits");
        EXPECT_FALSE(leveled_jelly().opened(ByteView(leveled_jelly().payload).first(ends[n] - 1), detail.kept(0)).ok());
    }
}

TEST(Detail, KnowsWhereLevelsEndFromAPayloadsFirstBytes)
{
    const ByteView beginning = ByteView(leveled_jelly().payload).first(256);
    EXPECT_EQ(*leveled_jelly().codec.level_bytes({beginning, 0, "SEGM"}, {}), leveled_jelly().ends());
}

TEST(Detail, ThatEndsElsewhereThanItSaysIsRefused)
{
    Bytes moved = leveled_jelly().payload; // one byte from one level to the next: the low bytes of two varints
    ++moved[number_of(leveled_jelly(), "SEGM.levels[0].bytes").place];
    --moved[number_of(leveled_jelly(), "SEGM.levels[1].bytes").place];
    const auto whole = codecs::open(leveled_jelly().codec, leveled_jelly().coded(moved));
    ASSERT_FALSE(whole.ok());
    EXPECT_EQ(whole.error().sentence(), "byte 0: SEGM.levels: a level of detail ends at another byte than said");
}

TEST(Detail, OfFewerLevelsThanTheVerticesMakeIsRefused)
{
    const PlacedNumber coarse = number_of(leveled_jelly(), "SEGM.levels[0].bytes"),
                       fine = number_of(leveled_jelly(), "SEGM.levels[1].bytes");
    const PlacedNumber both{coarse.place, coarse.size + fine.size, {}, 0}; // two levels become one
    Bytes payload = replaced(leveled_jelly().payload, both, coarse.value + fine.value);
    --payload[coarse.place - 1];
    const auto detail = leveled_jelly().codec.detail(leveled_jelly().coded(payload));
    ASSERT_FALSE(detail.ok());
    EXPECT_EQ(detail.error().field, "SEGM.levels");
    EXPECT_EQ(codecs::open(leveled_jelly().codec, leveled_jelly().coded(payload)).error().field, "SEGM.levels");
}

TEST(Detail, ThatGoesBeyondThePayloadIsRefused)
{
    const Bytes payload =
        replaced(leveled_jelly().payload, number_of(leveled_jelly(), "SEGM.levels[0].bytes"), 1u << 30);
    const auto whole = codecs::open(leveled_jelly().codec, leveled_jelly().coded(payload));
    ASSERT_FALSE(whole.ok());
    EXPECT_EQ(whole.error().field, "SEGM.level_bits");
}

TEST(Detail, IsOneLevelOfWhateverIsSmall)
{
    for (const auto& [name, animation] : test_shapes::all()) {
        const Leveled reel(animation);
        EXPECT_EQ(reel.detail().counts.front(), reel.prepared.surface.vertex_count) << name;
        if (reel.prepared.surface.vertex_count < 96) {
            EXPECT_EQ(reel.ends(), std::vector<std::uint64_t>{reel.payload.size()}) << name;
        }
    }
}

TEST(Detail, OfAnyBytesIsAnErrorOrValid)
{
    const Leveled reel(test_shapes::torus());
    for (std::size_t bit = 0; bit < 8 * std::min<std::size_t>(reel.payload.size(), 90); ++bit) {
        Bytes broken = reel.payload;
        broken[bit / 8] ^= static_cast<std::uint8_t>(1u << bit % 8);
        const auto detail = reel.codec.detail(reel.coded(broken));
        if (!detail.ok()) continue;
        EXPECT_EQ(detail->order.size(), reel.prepared.surface.vertex_count);
        const auto part = reel.opened(broken, detail->kept(detail->counts.size() - 1));
        if (part.ok()) {
            EXPECT_EQ(part->C.rows, detail->counts.back());
        }
    }
}
