/// Files that are read in parts: the head first, then the segment that holds a frame.
// SPDX-License-Identifier: MIT
#include "meshreel/container/segments.h"
#include "tests/container/clip.h"
#include "tests/container/counted_source.h"

namespace meshreel::container {
namespace {

/// 100 segments of 10 frames, each of 1000 bytes that say which one it is.
Bytes long_file(Clip& clip)
{
    clip.header.frame_count = 1000;
    MemoryWriter file;
    EXPECT_TRUE(add_head(file, clip.header, uniform_times(1000, 24), clip.meta).ok());
    file.add(type::conn, ByteView(clip.connectivity));
    for (std::uint32_t s = 0; s < 100; ++s) {
        const Bytes payload(1000, static_cast<std::uint8_t>(s));
        EXPECT_TRUE(file.add(type::segm, Segment{10 * s, 10, payload}).ok());
    }
    return std::move(file).finish();
}

Error error_of_parts(const Bytes& bytes)
{
    MemorySource source(bytes);
    const auto head = StreamReader::open_head(source);
    if (!head.ok()) return head.error();
    const auto header = read_header(*head);
    if (!header.ok()) return header.error();
    SegmentFetcher segments(source, *head, *header);
    for (std::uint32_t f = 0; f < header->frame_count; ++f) {
        const auto segment = segments.holding(f);
        if (!segment.ok()) return segment.error();
    }
    return {ErrorCode::runtime, "no error"};
}

} // namespace

TEST(Segments, AreFoundByFrameInMemoryAndInParts)
{
    Clip clip;
    const Bytes bytes = long_file(clip);
    const auto file = StreamReader::open(bytes);
    auto list = *SegmentList::open(*file, clip.header);
    MemorySource source(bytes);
    const auto head = StreamReader::open_head(source);
    SegmentFetcher fetcher(source, *head, clip.header);
    for (const std::uint32_t f : {0u, 9u, 10u, 555u, 999u, 3u}) {
        const auto a = list.holding(f), b = fetcher.holding(f);
        ASSERT_TRUE(a.ok() && b.ok());
        EXPECT_EQ(a->first_frame, f / 10 * 10);
        EXPECT_EQ(b->first_frame, a->first_frame);
        EXPECT_EQ(b->payload_offset, a->payload_offset);
        EXPECT_TRUE(std::ranges::equal(a->payload, b->payload));
    }
}

TEST(Segments, CostTheHeadTheIndexAndOneSegmentForOneFrame)
{
    Clip clip;
    const Bytes bytes = long_file(clip);
    CountedSource source(bytes);
    const auto head = StreamReader::open_head(source);
    SegmentFetcher segments(source, *head, clip.header);
    ASSERT_TRUE(segments.holding(777).ok());
    const std::uint64_t index = head->index_chunk().payload.size();
    EXPECT_LT(source.fetched, index + 1000 + 500);
    EXPECT_LT(source.fetched, bytes.size() / 40);
}

TEST(Segments, InPartsRefuseWhatTheWholeFileRefuses)
{
    const Clip clip;
    const Bytes whole = clip.file();
    EXPECT_EQ(error_of_parts(whole).message, "no error");
    for (std::size_t size = 0; size < whole.size(); ++size)
        EXPECT_NE(error_of_parts(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size))).message,
                  "no error");
    for (std::size_t i = 0; i < whole.size(); ++i) {
        Bytes broken = whole;
        broken[i] ^= 0x55;
        EXPECT_NE(error_of_parts(broken).message, "no error") << "byte " << i;
    }
}

} // namespace meshreel::container
