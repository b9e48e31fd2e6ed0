/// Opening a file by its end: tail, index, and every chunk that is no segment.
// SPDX-License-Identifier: MIT
#include "meshreel/base/text.h"
#include "meshreel/container/stream.h"

namespace meshreel::container {

namespace {

/// A type, a length as varint, the payload, a checksum: no bytes between chunks, so sizes tell where each one is.
Status check_row(const Index& index, std::uint64_t index_offset, const Chunk& where)
{
    std::uint64_t next = Preamble::size;
    for (const Index::Entry& entry : index.chunks) {
        if (entry.offset != next || entry.size > index_offset || chunk_size(entry.size) > index_offset - next)
            return bad_input(concat("a chunk at byte ", entry.offset, ", but the one before ends at ", next),
                             "INDX.chunks", at_byte(where.offset));
        next += chunk_size(entry.size);
    }
    if (next == index_offset) return Ok{};
    return bad_input(concat("its chunks end at byte ", next, ", itself it is at ", index_offset), "INDX.chunks",
                     at_byte(where.offset));
}

} // namespace

std::uint64_t chunk_size(std::uint64_t payload_size)
{
    std::uint64_t length_size = 1;
    for (std::uint64_t rest = payload_size >> 7; rest != 0; rest >>= 7) ++length_size;
    return 4 + length_size + payload_size + 4;
}

Result<Chunk> read_entry(ByteView bytes, const Index::Entry& entry)
{
    MESHREEL_TRY(const Chunk chunk, read_chunk(bytes, entry.offset));
    if (chunk.type == entry.type && chunk.payload.size() == entry.size) return chunk;
    return bad_input("is not the chunk that INDX says", name_of(entry.type), at_byte(entry.offset));
}

Result<StreamReader> StreamReader::open_head(ByteSource& file, const DecodeLimits& limits)
{
    return open_with(&StreamReader::fetch_index, file, limits);
}

Result<StreamReader> StreamReader::open_beginning(ByteSource& file, const DecodeLimits& limits)
{
    return open_with(&StreamReader::collect_index, file, limits);
}

/// find_index: fills index_.
Result<StreamReader> StreamReader::open_with(Status (StreamReader::*find_index)(ByteSource&), ByteSource& file,
                                             const DecodeLimits& limits)
{
    StreamReader reader;
    reader.limits_ = limits;
    MESHREEL_CHECK(reader.fetch_preamble(file));
    MESHREEL_CHECK((reader.*find_index)(file));
    MESHREEL_CHECK(reader.check_known());
    MESHREEL_CHECK(reader.check_counts());
    MESHREEL_CHECK(reader.fetch_head(file));
    return reader;
}

Status StreamReader::fetch_preamble(ByteSource& file)
{
    MESHREEL_TRY(const Bytes first,
                 file.fetch(0, static_cast<std::size_t>(std::min<std::uint64_t>(file.size(), Preamble::size))));
    MESHREEL_TRY(preamble_, read_preamble(first));
    return Ok{};
}

/// Goes from chunk to chunk, up to the index or the end of what is there.
Status StreamReader::collect_index(ByteSource& file)
{
    constexpr std::uint64_t longest_head = 4 + 10;
    for (std::uint64_t at = Preamble::size; at < file.size();) {
        if (index_.chunks.size() >= limits_.max_memory / sizeof(Index::Entry))
            return bad_input("too many chunks", "chunk", at_byte(at));
        MESHREEL_TRY(const Bytes bytes,
                     file.fetch(at, static_cast<std::size_t>(std::min(longest_head, file.size() - at))));
        Reader reader({bytes, at, "chunk"}, limits_);
        ChunkHead head;
        head.fields(reader);
        if (reader.failed() || head.type == type::indx) break;
        const bool cut = head.size > file.size() || chunk_size(head.size) > file.size() - at;
        if (cut && head.type != type::segm) break;
        MESHREEL_CHECK(within(head.size, limits_.max_memory, name_of(head.type)));
        index_.chunks.push_back({head.type, at, head.size});
        if (cut) break;
        at += chunk_size(head.size);
    }
    return Ok{};
}

Status StreamReader::fetch_index(ByteSource& file)
{
    const std::uint64_t size = file.size();
    const std::size_t tail_size = static_cast<std::size_t>(std::min<std::uint64_t>(size, Tail::chunk_size));
    MESHREEL_TRY(Bytes end, file.fetch(size - tail_size, tail_size));
    MESHREEL_TRY(const Tail tail, read_tail(end, size));
    const std::uint64_t index_size = size - Tail::chunk_size - tail.index_offset;
    MESHREEL_CHECK(within(index_size, limits_.max_memory, "INDX"));
    MESHREEL_TRY(Bytes bytes, file.fetch(tail.index_offset, static_cast<std::size_t>(index_size)));
    MESHREEL_TRY(index_chunk_, read_chunk(bytes, tail.index_offset));
    if (index_chunk_.type != type::indx || index_chunk_.end() != size - Tail::chunk_size)
        return bad_input("does not point at INDX", "TAIL.index_offset", at_byte(size - Tail::chunk_size));
    MESHREEL_TRY(tail_chunk_, read_chunk(end, size - Tail::chunk_size));
    fetched_.push_back(std::move(end)); // moving a vector leaves its bytes where they are
    fetched_.push_back(std::move(bytes));
    MESHREEL_TRY(index_, read_fields<Index>(index_chunk_.source(), limits_));
    return check_row(index_, tail.index_offset, index_chunk_);
}

Status StreamReader::fetch_head(ByteSource& file)
{
    std::uint64_t left = limits_.max_memory;
    for (const Index::Entry& entry : index_.chunks) {
        if (entry.type == type::segm) continue;
        MESHREEL_CHECK(within(chunk_size(entry.size), left, name_of(entry.type)));
        left -= chunk_size(entry.size);
        MESHREEL_TRY(Bytes bytes, file.fetch(entry.offset, static_cast<std::size_t>(chunk_size(entry.size))));
        MESHREEL_TRY(const Chunk chunk, read_entry(bytes, entry));
        fetched_.push_back(std::move(bytes));
        chunks_.push_back(chunk);
    }
    return Ok{};
}

} // namespace meshreel::container
