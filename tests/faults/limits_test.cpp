/// What a few bytes may ask for: little, unless `info` warns; and never more than the limits.
// SPDX-License-Identifier: MIT
#include <cstdio>
#include <random>

#include <gtest/gtest.h>

#include "meshreel/codecs/codec.h"
#include "meshreel/mesh/test_shapes.h"
#include "meshreel/meshreel.h"
#include "meshreel/player/player.h"
#include "tests/faults/file.h"
#include "tests/faults/memory.h"

using namespace meshreel;

namespace {

constexpr std::size_t a_little = 64 << 10;

/// Bytes beyond the file that decoding it, posing it or looking into it takes at most.
std::size_t taken(ByteView file)
{
    const std::size_t before = faults::held();
    faults::reset_peak();
    DecodeOptions options;
    options.threads = {1};
    (void)decode(file, options).ok();
    MemorySource source(file);
    (void)decode(source, options).ok();
    (void)open_frames(source, options).ok();
    (void)player::Player::open(file, {.threads = {1}}).ok();
    (void)levels(file, options).ok();
    (void)explain(file).ok();
    return faults::peak() - before;
}

/// Whether `info`, which takes little itself, warns of a file.
bool is_warned_of(ByteView file)
{
    const auto what = info(file);
    return what.ok() && !what->warnings.empty();
}

/// The field as the largest number that so many bytes hold, and as the one below.
std::vector<Bytes> largest_values(std::size_t size)
{
    std::vector<Bytes> all;
    for (const std::uint8_t first : Bytes{0xff, 0xfe}) {
        Bytes value(size, 0xff);
        value.front() = first;
        value.back() &= 0x7f; // as a varint it ends there
        all.push_back(value);
    }
    return all;
}

/// How many files of 100 bytes were tried, and what one of them took.
struct Taken {
    std::size_t tried = 0, most = 0;

    void look_at(Bytes file)
    {
        file.resize(100);
        ++tried;
        if (!is_warned_of(file)) most = std::max(most, taken(file));
    }
};

/// All parts that fit into 100 bytes, the head first, with a field of one of them at its largest.
void with_large_fields(const Bytes& file, Taken& sum)
{
    const std::vector<faults::Part> parts = faults::parts_of(file);
    for (const faults::Field& field : faults::fields_of(file)) {
        if (field.size > 10) continue;
        for (const Bytes& value : largest_values(field.size)) {
            std::vector<faults::Part> some = {parts[0]};
            if (field.part > 0) some.push_back(parts[field.part]);
            std::copy(value.begin(), value.end(),
                      some.back().payload.begin() + static_cast<std::ptrdiff_t>(field.begin));
            sum.look_at(faults::sealed(some));
            sum.look_at(faults::indexed(some));
        }
    }
}

/// One triangle, or as many points, that stand still.
Animation still(std::uint32_t vertex_count, std::size_t frame_count)
{
    Animation a;
    a.vertex_count = vertex_count;
    a.triangles = {{0, 1, 2}};
    a.times_s = uniform_times(frame_count, 25.0);
    a.positions.resize(3ul * vertex_count * frame_count);
    for (std::size_t f = 0; f < frame_count; ++f)
        for (std::size_t i = 0; i < 3ul * vertex_count; ++i)
            a.positions[3ul * vertex_count * f + i] = static_cast<float>(i % 3 == 0 ? i / 3 % 100 : i % 3);
    return a;
}

Bytes file_of(const Animation& a, const std::string& codec = "reel")
{
    EncodeOptions options;
    options.codec = codec;
    if (codec != "lossless") options.quality.step = 0.5;
    options.effort = 1;
    options.segment = one_segment;
    options.threads = {1};
    return (*encode(a, options)).bytes;
}

} // namespace

TEST(SmallFile, OfAHundredBytesTakesAtMost64KbMoreUnlessInfoWarns)
{
    std::mt19937 random(7);
    Taken sum;
    for (const codecs::Codec& codec : codecs::all()) {
        const std::vector<faults::Part> parts = faults::parts_of(faults::small_file(std::string(codec.name)));
        for (int i = 0; i < 3000; ++i) {
            std::vector<faults::Part> some;
            for (const faults::Part& part : parts)
                if (random() % 2 == 0) some.push_back(part);
            for (faults::Part& part : some) {
                part.payload.resize(std::min<std::size_t>(part.payload.size(), random() % 24));
                if (!part.payload.empty())
                    part.payload[random() % part.payload.size()] = static_cast<std::uint8_t>(random());
            }
            sum.look_at(i % 2 == 0 ? faults::sealed(some) : faults::indexed(some));
        }
    }
    EXPECT_LE(sum.most, a_little);
    std::printf("%zu files of 100 bytes tried; at most %zu bytes beyond their size\n", sum.tried, sum.most);
}

TEST(SmallFile, WithTheHeadOfAnyGoldenFileAndAnyFieldAtItsLargestTakesAtMost64KbMoreUnlessInfoWarns)
{
    Taken sum;
    for (const std::string& name : faults::golden_names()) {
        const Bytes file = faults::golden_file(name);
        sum.look_at(file);
        with_large_fields(file, sum);
    }
    EXPECT_GT(sum.tried, 1000u);
    EXPECT_LE(sum.most, a_little);
    std::printf("%zu files of 100 bytes tried; at most %zu bytes beyond their size\n", sum.tried, sum.most);
}

TEST(SmallFile, ThatIsValidIsLongerThanAHundredBytes)
{
    std::size_t least = 1000;
    for (const codecs::Codec& codec : codecs::all())
        least = std::min(least, file_of(still(3, 1), std::string(codec.name)).size());
    EXPECT_GT(least, 100u);
    std::printf("the smallest file has %zu bytes\n", least);
}

TEST(SmallFile, ThatBecomesMuchIsWarnedOf)
{
    for (const std::size_t frames : {1u, 10u, 1000u, 3000u}) {
        const Animation a = still(100, frames);
        const Bytes file = file_of(a);
        const Info what = *info(file);
        const std::size_t bytes = 12 * (100 * frames + 1);
        EXPECT_EQ(what.decoded_bytes, bytes);
        EXPECT_EQ(what.warnings.empty(), bytes <= Info::usual_expansion * file.size() + file.size()) << frames;
        std::printf("%zu bytes become %zu%s\n", file.size(), bytes, what.warnings.empty() ? "" : ", warned");
    }
}

TEST(SmallFile, ThatBecomesMoreThanItsLimitIsRefusedBeforeItIsHeld)
{
    const Bytes file = file_of(still(3000, 2000));
    DecodeOptions options;
    options.threads = {1};
    const std::uint64_t beyond = 12 * (3000ul * 2000 + 1) - DecodeLimits::free_bytes;
    options.limits.max_expansion = beyond / file.size();
    const std::size_t before = faults::held();
    faults::reset_peak();
    const auto refused = decode(file, options);
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().code, ErrorCode::bad_input);
    EXPECT_LE(faults::peak() - before, 1u << 20);
    MemorySource source(file);
    EXPECT_FALSE(decode(source, options).ok());
    EXPECT_FALSE(open_frames(source, options).ok());
    EXPECT_EQ((*info(file, options.limits)).warnings.size(), 2u);
    ++options.limits.max_expansion;
    EXPECT_TRUE(decode(file, options).ok());
}

TEST(Work, BeyondItsLimitIsRefused)
{
    const std::uint64_t many = ~std::uint64_t{0};
    EXPECT_TRUE(within_work({}, many, 256, 1).ok());
    EXPECT_TRUE(within_work({}, 1000, 4256, 1).ok());
    EXPECT_FALSE(within_work({}, 1000, 4257, 1).ok());
    EXPECT_FALSE(within_work({}, many, 257, 1).ok());
    EXPECT_FALSE(within_work({}, many, many, many).ok());
    EXPECT_FALSE(within_work({.max_work = 0}, 1, 257, 1).ok());
    EXPECT_TRUE(within_expansion({}, DecodeLimits::free_bytes + 1'000'000, 1).ok());
    EXPECT_FALSE(within_expansion({}, DecodeLimits::free_bytes + 1'000'001, 1).ok());
    EXPECT_FALSE(within_expansion({}, many, 0).ok());
}

TEST(Work, OfTheComponentsOfAFileIsLimited)
{
    for (const codecs::Codec& codec : codecs::of_trajectories()) {
        Animation a = still(300, 100);
        std::mt19937 random(3);
        for (float& x : a.positions) x += 0.1f * static_cast<float>(random() % 1000);
        EncodeOptions options;
        options.codec = codec.name;
        options.quality.step = 0.01;
        options.quality.bases = 280;
        options.effort = 1;
        options.segment = one_segment;
        const auto encoded = encode(a, options);
        ASSERT_TRUE(encoded.ok()) << encoded.error().sentence();
        ASSERT_GT(encoded->bases, DecodeLimits::free_work) << codec.name;
        const std::uint64_t work = 3ull * 300 * 100 * (encoded->bases - DecodeLimits::free_work);
        DecodeOptions limited;
        limited.limits.max_work = work / encoded->bytes.size() / 2;
        const auto refused = decode(encoded->bytes, limited);
        ASSERT_FALSE(refused.ok()) << codec.name;
        EXPECT_NE(refused.error().sentence().find("multiplications a byte"), std::string::npos) << codec.name;
        EXPECT_TRUE(decode(encoded->bytes).ok()) << codec.name;
    }
}
