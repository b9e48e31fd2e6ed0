/// The decoder's own zstd unpacks what libzstd packs, and takes any bytes without harm.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <zstd.h>

#include "meshreel/base/random.h"
#include "wasm/unzstd.cpp"

using namespace meshreel;

namespace {

/// Bytes of several kinds: noise, few values, text, repetitions from afar.
Bytes unzstd_sample(std::uint64_t kind, std::size_t size, Random& random)
{
    static constexpr std::string_view text = "the quick brown fox jumps over the lazy dog, ";
    Bytes bytes(size);
    for (std::size_t i = 0; i < size; ++i) switch (kind) {
        case 0:
            bytes[i] = static_cast<std::uint8_t>(random.bits());
            break;
        case 1:
            bytes[i] = static_cast<std::uint8_t>(random.below(9) == 0 ? random.below(4) : 0);
            break;
        case 2:
            bytes[i] = static_cast<std::uint8_t>(text[(7 * i + (random.below(9) == 0)) % text.size()]);
            break;
        case 3:
            bytes[i] = i > 300 && random.below(50) != 0 ? bytes[i - 300] : static_cast<std::uint8_t>(i);
            break;
        default:
            bytes[i] = static_cast<std::uint8_t>(random.below(16) * random.below(16));
            break;
        }
    return bytes;
}

Bytes unzstd_packed(const Bytes& bytes, int level)
{
    Bytes packed(ZSTD_compressBound(bytes.size()));
    packed.resize(ZSTD_compress(packed.data(), packed.size(), bytes.data(), bytes.size(), level));
    return packed;
}

} // namespace

TEST(Unzstd, UnpacksWhatLibzstdPacks)
{
    Random random(1);
    for (int i = 0; i < 200; ++i) {
        const std::size_t size = i < 40 ? static_cast<std::size_t>(i) : random.below(i % 40 == 0 ? 600'000 : 5'000);
        const Bytes bytes = unzstd_sample(random.below(5), size, random);
        const Bytes packed = unzstd_packed(bytes, 1 + static_cast<int>(random.below(19)));
        const auto frame = wasm::look_at_zstd(packed);
        ASSERT_TRUE(frame.has_value());
        EXPECT_EQ(frame->content_size, bytes.size());
        EXPECT_EQ(frame->compressed_size, packed.size());
        Bytes unpacked(size);
        ASSERT_TRUE(wasm::unpack_zstd(packed, unpacked)) << "size " << size << ", sample " << i;
        ASSERT_EQ(unpacked, bytes);
    }
}

TEST(Unzstd, RefusesAnotherSizeAndCutOffFrames)
{
    Random random(2);
    const Bytes bytes = unzstd_sample(2, 4000, random), packed = unzstd_packed(bytes, 19);
    Bytes less(bytes.size() - 1), more(bytes.size() + 1), same(bytes.size());
    EXPECT_FALSE(wasm::unpack_zstd(packed, less));
    EXPECT_FALSE(wasm::unpack_zstd(packed, more));
    for (std::size_t size = 0; size < packed.size(); ++size)
        EXPECT_FALSE(wasm::unpack_zstd(ByteView(packed).first(size), same));
}

TEST(Unzstd, TakesAnyBytesWithoutHarm)
{
    Random random(3);
    for (int i = 0; i < 600; ++i) {
        const Bytes bytes = unzstd_sample(random.below(5), 1 + random.below(3000), random);
        Bytes packed = unzstd_packed(bytes, 1 + static_cast<int>(random.below(19))), out(bytes.size());
        for (std::uint64_t flips = 1 + random.below(3); flips > 0; --flips)
            packed[random.below(packed.size())] ^= static_cast<std::uint8_t>(1u << random.below(8));
        wasm::unpack_zstd(packed, out); // the sanitizers watch
    }
    SUCCEED();
}
