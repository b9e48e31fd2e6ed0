/// Rows of chunks: building them, and refusing everything that is not one.
// SPDX-License-Identifier: MIT
#include "meshreel/container/stream.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "meshreel/base/text.h"

namespace meshreel::container {

namespace {

/// How often a chunk type may occur.
struct Kind {
    Tag type;
    bool required;
    bool many;
};
constexpr Kind kinds[] = {
    {type::head, true, false},  {type::time, true, false},  {type::conn, true, false},
    {type::segm, true, true},   {type::meta, false, false}, {type::attr, false, true},
    {type::matl, false, false}, {type::grup, false, false}, {type::aset, false, true},
};

const Kind* kind_of(Tag type)
{
    for (const Kind& kind : kinds)
        if (kind.type == type) return &kind;
    return nullptr;
}

bool is_letter(std::uint8_t c)
{
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}
bool may_be_skipped(Tag type)
{
    return (type & 0x20) != 0;
}

/// Of what stands before a payload and of the payload.
std::uint32_t checksum_of(ByteView head, ByteView payload)
{
    XXH3_state_t state;
    XXH3_64bits_reset(&state);
    XXH3_64bits_update(&state, head.data(), head.size());
    XXH3_64bits_update(&state, payload.data(), payload.size());
    return static_cast<std::uint32_t>(XXH3_64bits_digest(&state));
}

Error damaged_signature(ByteView bytes)
{
    const bool looks_right = bytes.size() >= 5 && std::memcmp(bytes.data() + 1, "REEL", 4) == 0;
    return bad_input(looks_right ? "a .reel file damaged by a transfer in text mode" : "not a .reel file", "signature",
                     at_byte(0));
}

} // namespace

std::uint64_t hash_of(ByteView bytes)
{
    return XXH3_64bits(bytes.data(), bytes.size());
}
std::uint32_t checksum_of(ByteView bytes)
{
    return static_cast<std::uint32_t>(hash_of(bytes));
}

StreamWriter::StreamWriter(Spool& spool) : spool_(&spool)
{
    Preamble preamble;
    Writer first;
    preamble.fields(first);
    Bytes bytes = *std::move(first).finish();
    preamble.checksum = checksum_of(ByteView(bytes).first(Preamble::size - 4));
    store<4>(preamble.checksum, bytes.data() + Preamble::size - 4);
    put(bytes);
}

void StreamWriter::put(ByteView bytes)
{
    if (written_.ok()) written_ = spool_->write(bytes);
}

void StreamWriter::add(Tag type, ByteView payload)
{
    index_.chunks.push_back({type, spool_->size(), payload.size()});
    const Bytes head = *write_fields(ChunkHead{type, payload.size()});
    std::uint8_t checksum[4];
    store<4>(checksum_of(head, payload), checksum);
    for (const ByteView part : {ByteView(head), payload, ByteView(checksum)}) put(part);
}

Status StreamWriter::finish()
{
    const std::uint64_t index_offset = spool_->size();
    const Bytes index = *write_fields(index_);
    add(type::indx, ByteView(index));
    const Bytes tail = *write_fields(Tail{index_offset, spool_->size() + Tail::chunk_size});
    add(type::tail, ByteView(tail));
    return written_;
}

Bytes MemoryWriter::finish() &&
{
    static_cast<void>(StreamWriter::finish().ok()); // memory takes everything
    return std::move(*spool_).take();
}

Result<Preamble> read_preamble(ByteView first_bytes)
{
    const std::size_t known = std::min(first_bytes.size(), sizeof Preamble::signature);
    if (!std::equal(first_bytes.begin(), first_bytes.begin() + static_cast<std::ptrdiff_t>(known), Preamble::signature))
        return damaged_signature(first_bytes);
    const ByteView all = first_bytes.first(std::min(first_bytes.size(), Preamble::size));
    MESHREEL_TRY(const Preamble preamble, read_fields<Preamble>({all, 0, "preamble"}, {}));
    if (preamble.checksum != checksum_of(all.first(Preamble::size - 4)))
        return bad_input("its bytes are damaged: the checksum differs", "preamble", at_byte(0));
    if (preamble.major > version_major)
        return unsupported(concat("version ", preamble.major, ".", preamble.minor,
                                  " of the format; this library reads up to ", version_major, ".x"),
                           "preamble.major");
    return preamble;
}

Result<Chunk> read_chunk(ByteView bytes, std::uint64_t begin)
{
    Reader reader({bytes, begin, "chunk"}, {});
    ChunkHead head;
    head.fields(reader);
    if (reader.failed()) return reader.failure();
    for (std::size_t i = 0; i < 4; ++i)
        if (!is_letter(bytes[i]))
            return bad_input("a chunk's type must be four letters", "chunk.type", at_byte(begin + i));
    const std::uint64_t left = reader.left();
    if (left < 4 || head.size > left - 4)
        return bad_input(concat("the data end ", left, " bytes after the chunk's length, but the payload of ",
                                head.size, " and the checksum of 4 were to come"),
                         name_of(head.type) + ".size", at_byte(reader.offset()));
    const std::size_t head_size = bytes.size() - static_cast<std::size_t>(left);
    const std::size_t size = static_cast<std::size_t>(head.size);
    Chunk chunk{head.type, begin, begin + head_size, bytes.subspan(head_size, size), 0};
    chunk.checksum = static_cast<std::uint32_t>(load<4>(bytes.data() + head_size + size));
    if (chunk.checksum == checksum_of(bytes.first(head_size + size))) return chunk;
    return bad_input("its bytes are damaged: the checksum differs", name_of(head.type) + ".checksum",
                     at_byte(chunk.end() - 4));
}

Result<Tail> read_tail(ByteView last_bytes, std::uint64_t file_size)
{
    if (last_bytes.size() < Tail::chunk_size || file_size < last_bytes.size())
        return bad_input("too short to end in a TAIL chunk", "TAIL", at_byte(file_size));
    const std::uint64_t begin = file_size - Tail::chunk_size;
    MESHREEL_TRY(const Chunk chunk, read_chunk(last_bytes.last(Tail::chunk_size), begin));
    if (chunk.type != type::tail || chunk.end() != file_size)
        return bad_input("the file does not end in a TAIL chunk", "TAIL", at_byte(begin));
    MESHREEL_TRY(const Tail tail, read_fields<Tail>(chunk.source(), {}));
    if (tail.file_size != file_size)
        return bad_input(concat("the file has ", file_size, " bytes, but was written with ", tail.file_size),
                         "TAIL.file_size", at_byte(chunk.offset + 8));
    if (tail.index_offset < Preamble::size || tail.index_offset >= begin)
        return bad_input("points outside the file", "TAIL.index_offset", at_byte(chunk.offset));
    return tail;
}

Result<StreamReader> StreamReader::open(ByteView file, const DecodeLimits& limits)
{
    StreamReader reader;
    reader.file_ = file;
    reader.limits_ = limits;
    MESHREEL_TRY(reader.preamble_, read_preamble(file));
    MESHREEL_CHECK(reader.walk());
    MESHREEL_CHECK(reader.check_index());
    MESHREEL_CHECK(reader.check_known());
    MESHREEL_CHECK(reader.check_counts());
    return reader;
}

/// Cuts the file into chunks, up to TAIL.
Status StreamReader::walk()
{
    std::vector<Chunk> found;
    std::uint64_t at = Preamble::size;
    while (found.empty() || found.back().type != type::tail) {
        if (found.size() >= limits_.max_memory / sizeof(Chunk))
            return bad_input("too many chunks", "chunk", at_byte(at));
        MESHREEL_TRY(const Chunk chunk, read_chunk(file_.subspan(static_cast<std::size_t>(at)), at));
        at = chunk.end();
        found.push_back(chunk);
    }
    if (at != file_.size())
        return bad_input(concat(file_.size() - at, " bytes follow the end of the file"), "TAIL", at_byte(at));
    tail_chunk_ = found.back();
    found.pop_back();
    if (found.empty() || found.back().type != type::indx)
        return bad_input("the chunk before TAIL must be INDX", "INDX", at_byte(tail_chunk_.begin));
    index_chunk_ = found.back();
    found.pop_back();
    chunks_ = std::move(found);
    return Ok{};
}

/// Refuses types that we do not know and may not skip, and a first chunk that is not HEAD.
Status StreamReader::check_known() const
{
    if (index_.chunks.empty() || index_.chunks.front().type != type::head)
        return bad_input("the first chunk must be HEAD", "HEAD", at_byte(Preamble::size));
    for (const Index::Entry& chunk : index_.chunks) {
        if (chunk.type == type::indx) return bad_input("a second INDX", "INDX", at_byte(chunk.offset));
        if (kind_of(chunk.type) != nullptr || may_be_skipped(chunk.type)) continue;
        Error error = unsupported("a chunk that this library does not know and may not skip", name_of(chunk.type));
        error.place = at_byte(chunk.offset);
        return error;
    }
    return Ok{};
}

Status StreamReader::check_counts() const
{
    for (const Kind& kind : kinds) {
        std::size_t count = 0;
        for (const Index::Entry& chunk : index_.chunks) {
            if (chunk.type != kind.type) continue;
            if (++count > 1 && !kind.many) return bad_input("a second one", name_of(kind.type), at_byte(chunk.offset));
        }
        if (count == 0 && kind.required) return missing(kind.type);
    }
    return Ok{};
}

/// The index must say what the walk found, so that a reader that trusts it sees the same file.
Status StreamReader::check_index()
{
    MESHREEL_TRY(const Tail tail, read_tail(file_, file_.size()));
    if (tail.index_offset != index_chunk_.begin)
        return bad_input(concat("INDX is at byte ", index_chunk_.begin), "TAIL.index_offset",
                         at_byte(tail_chunk_.offset));
    MESHREEL_TRY(index_, read_fields<Index>(index_chunk_.source(), limits_));
    bool same = index_.chunks.size() == chunks_.size();
    for (std::size_t i = 0; same && i < chunks_.size(); ++i) {
        const Index::Entry& entry = index_.chunks[i];
        same = entry.type == chunks_[i].type && entry.offset == chunks_[i].begin &&
               entry.size == chunks_[i].payload.size();
    }
    if (same) return Ok{};
    return bad_input("does not agree with the chunks of the file", "INDX.chunks", at_byte(index_chunk_.offset));
}

const Chunk* StreamReader::find(Tag type) const
{
    for (const Chunk& chunk : chunks_)
        if (chunk.type == type) return &chunk;
    return nullptr;
}

std::vector<Chunk> StreamReader::all(Tag type) const
{
    std::vector<Chunk> found;
    for (const Chunk& chunk : chunks_)
        if (chunk.type == type) found.push_back(chunk);
    return found;
}

Error StreamReader::missing(Tag type)
{
    return bad_input("there is no such chunk", name_of(type));
}

} // namespace meshreel::container
