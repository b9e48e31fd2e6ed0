/// A file is refused unless every byte of it is right.
// SPDX-License-Identifier: MIT
#include "meshreel/container/stream.h"

#include <gmock/gmock.h>

#include "tests/container/clip.h"

namespace meshreel::container {
namespace {

Error stream_error_of(const Bytes& bytes, const DecodeLimits& limits = {})
{
    const auto file = StreamReader::open(bytes, limits);
    return file.ok() ? Error{ErrorCode::runtime, "no error"} : file.error();
}

/// A file of chunks as given, well closed.
Bytes file_of(const std::vector<Tag>& types)
{
    MemoryWriter file;
    for (const Tag type : types) file.add(type, ByteView{});
    return std::move(file).finish();
}

TEST(Stream, every_truncation_is_an_error_that_names_byte_and_field)
{
    const Bytes bytes = Clip().file();
    for (std::size_t size = 0; size < bytes.size(); ++size) {
        const Error error = stream_error_of({bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size)});
        ASSERT_EQ(error.code, ErrorCode::bad_input) << size;
        EXPECT_FALSE(error.field.empty()) << size;
        ASSERT_TRUE(error.place.has_value()) << size;
        EXPECT_LE(error.place->number, size);
    }
}

TEST(Stream, every_flipped_bit_is_an_error_in_skipped_chunks_too)
{
    MemoryWriter writer = Clip().writer();
    writer.add(make_tag("zzzz"), random_bytes(20, 1));
    Bytes bytes = std::move(writer).finish();
    ASSERT_TRUE(StreamReader::open(bytes).ok());
    for (std::size_t bit = 0; bit < bytes.size() * 8; ++bit) {
        bytes[bit / 8] ^= static_cast<std::uint8_t>(1 << bit % 8);
        ASSERT_NE(stream_error_of(bytes).code, ErrorCode::runtime) << "bit " << bit;
        bytes[bit / 8] ^= static_cast<std::uint8_t>(1 << bit % 8);
    }
}

TEST(Stream, says_what_is_not_a_reel_file_and_what_was_damaged_in_text_mode)
{
    EXPECT_EQ(stream_error_of({'P', 'K', 3, 4}).sentence(), "byte 0: signature: not a .reel file");
    Bytes bytes = Clip().file();
    bytes.erase(bytes.begin() + 5); // CR LF -> LF
    EXPECT_THAT(stream_error_of(bytes).sentence(), testing::HasSubstr("text mode"));
}

TEST(Stream, refuses_a_later_major_version_and_reads_a_later_minor_one)
{
    Bytes bytes = Clip().file();
    bytes[10] = 7;
    store<4>(checksum_of(ByteView(bytes).first(12)), bytes.data() + 12);
    EXPECT_TRUE(StreamReader::open(bytes).ok());
    bytes[8] = 2;
    store<4>(checksum_of(ByteView(bytes).first(12)), bytes.data() + 12);
    EXPECT_EQ(stream_error_of(bytes).code, ErrorCode::unsupported);
}

TEST(Stream, skips_a_chunk_it_does_not_know_if_its_first_letter_is_small_and_refuses_it_otherwise)
{
    MemoryWriter small = Clip().writer();
    small.add(make_tag("news"), ByteView{});
    EXPECT_EQ(stream_error_of(std::move(small).finish()).message, "no error");
    MemoryWriter large = Clip().writer();
    large.add(make_tag("News"), ByteView{});
    const Error error = stream_error_of(std::move(large).finish());
    EXPECT_EQ(error.code, ErrorCode::unsupported);
    EXPECT_EQ(error.field, "News");
}

TEST(Stream, refuses_chunks_missing_repeated_or_out_of_place)
{
    using namespace type;
    EXPECT_EQ(stream_error_of(file_of({head, time, conn, segm})).message, "no error");
    EXPECT_EQ(stream_error_of(file_of({time, head, conn, segm})).field, "HEAD");
    EXPECT_EQ(stream_error_of(file_of({head, time, conn})).field, "SEGM");
    EXPECT_EQ(stream_error_of(file_of({head, conn, segm})).field, "TIME");
    EXPECT_EQ(stream_error_of(file_of({head, time, segm})).field, "CONN");
    EXPECT_EQ(stream_error_of(file_of({head, time, time, conn, segm})).message, "a second one");
    EXPECT_EQ(stream_error_of(file_of({head, time, indx, segm})).field, "INDX");
    EXPECT_EQ(stream_error_of(file_of({})).field, "HEAD");
}

TEST(Stream, refuses_bytes_after_the_end)
{
    Bytes bytes = Clip().file();
    bytes.push_back(0);
    EXPECT_THAT(stream_error_of(bytes).sentence(), testing::HasSubstr("1 bytes follow the end"));
}

TEST(Stream, refuses_an_index_that_does_not_agree_with_the_chunks)
{
    const std::uint64_t first = Preamble::size, empty_chunk = 9, index_offset = first + 4 * empty_chunk;
    for (const std::uint64_t wrong : {0, 1}) {
        MemoryWriter forged;
        for (const Tag type : {type::head, type::time, type::conn, type::segm}) forged.add(type, ByteView{});
        const Index index{{{type::head, first, 0},
                           {type::time, first + empty_chunk, 0},
                           {type::conn, first + 2 * empty_chunk, 0},
                           {type::segm, first + 3 * empty_chunk, wrong}}};
        EXPECT_TRUE(forged.add(type::indx, index).ok());
        const std::uint64_t size = index_offset + 4 + 1 + write_fields(index)->size() + 4 + Tail::chunk_size;
        EXPECT_TRUE(forged.add(type::tail, Tail{index_offset, size}).ok());
        Bytes bytes = std::move(forged).finish();
        bytes.resize(size); // without the end that finish() wrote
        EXPECT_EQ(stream_error_of(bytes).field, wrong != 0 ? "INDX.chunks" : "");
    }
}

TEST(Stream, refuses_absurd_sizes_before_it_allocates)
{
    Bytes bytes = Clip().file();
    const Bytes absurd = *write_fields(ChunkHead{type::head, ~0ull});
    bytes.resize(Preamble::size);
    bytes.insert(bytes.end(), absurd.begin(), absurd.end());
    bytes.resize(bytes.size() + 100);
    EXPECT_EQ(stream_error_of(bytes).field, "HEAD.size");
    EXPECT_EQ(stream_error_of(Clip().file(), {.max_memory = 100}).message, "too many chunks");
}

TEST(Stream, can_be_read_in_parts_from_its_end)
{
    const Bytes bytes = Clip().file();
    const ByteView view(bytes);
    const auto tail = read_tail(view.last(Tail::chunk_size), bytes.size());
    ASSERT_TRUE(tail.ok()) << tail.error().sentence();
    const std::uint64_t at = tail->index_offset;
    const auto index_chunk = read_chunk(view.subspan(at), at);
    const auto index = read_fields<Index>(index_chunk->source(), {});
    ASSERT_TRUE(index.ok());
    for (const Index::Entry& entry : index->chunks) {
        const auto chunk = read_chunk(view.subspan(entry.offset), entry.offset);
        ASSERT_TRUE(chunk.ok());
        EXPECT_EQ(chunk->type, entry.type);
        EXPECT_EQ(chunk->payload.size(), entry.size);
    }
    EXPECT_FALSE(read_tail(view.last(Tail::chunk_size), bytes.size() + 1).ok());
    EXPECT_FALSE(read_tail(view.first(10), bytes.size()).ok());
}

TEST(Stream, is_the_same_twice)
{
    EXPECT_EQ(Clip().file(), Clip().file());
}

} // namespace
} // namespace meshreel::container
