/// A .reel file as a row of chunks: signature and version, chunks with checksums, an index, an end.
// SPDX-License-Identifier: MIT
//
//     Preamble | HEAD | ... chunks ... | INDX | TAIL
//
// A chunk is: type (four letters), payload length (varint), payload, checksum (the low 32 bits of XXH3-64 over type,
// length and payload). TAIL has a fixed size, so a reader that can seek fetches the end of the file first, finds the
// index there, and then only what it wants.
#pragma once

#include <memory>
#include <vector>

#include "meshreel/base/spool.h"
#include "meshreel/container/fields.h"

namespace meshreel::container {

/// The version of the format that this library writes, and the highest major version that it reads.
inline constexpr std::uint16_t version_major = 1;
inline constexpr std::uint16_t version_minor = 0;

/// The chunk types of version 1. A first letter that is small: a reader that does not know the type skips the chunk.
namespace type {
inline constexpr Tag head = make_tag("HEAD"); ///< what the file holds; first, once
inline constexpr Tag time = make_tag("TIME"); ///< frame times; once
inline constexpr Tag conn = make_tag("CONN"); ///< connectivity, order, and which vertices are coded as one; once
inline constexpr Tag segm = make_tag("SEGM"); ///< a run of frames; in time order, covering 0 .. F-1
inline constexpr Tag meta = make_tag("meta"); ///< name, loop, axis, units, fps; at most once
inline constexpr Tag attr = make_tag("attr"); ///< one attribute table; any number
inline constexpr Tag matl = make_tag("matl"); ///< names of materials; at most once
inline constexpr Tag grup = make_tag("grup"); ///< names of groups; at most once
inline constexpr Tag aset = make_tag("aset"); ///< a file that travels along; any number
inline constexpr Tag indx = make_tag("INDX"); ///< where the chunks are; once, last but one
inline constexpr Tag tail = make_tag("TAIL"); ///< where the index is; once, last
} // namespace type

/// The first 16 bytes.
struct Preamble {
    std::uint16_t major = version_major;
    std::uint16_t minor = version_minor;
    std::uint32_t checksum = 0; ///< of the 12 bytes before it

    static constexpr std::size_t size = 16;
    static constexpr std::uint8_t signature[8] = {0x8d, 'R', 'E', 'E', 'L', 0x0d, 0x0a, 0x0a};

    void fields(auto& io)
    {
        io.constant("signature", signature, "says that this is a .reel file, undamaged by text-mode transfer");
        io.u16("major", major, {1, 0xffff}, "version; a reader refuses a major version it does not know");
        io.u16("minor", minor, any, "version; a reader accepts every minor version");
        io.u32("checksum", checksum, any, "low 32 bits of XXH3-64 of the 12 bytes above");
    }
};

/// What stands before a payload.
struct ChunkHead {
    Tag type = 0;
    std::uint64_t size = 0;

    void fields(auto& io)
    {
        io.tag("type", type, "type of the chunk");
        io.varint("size", size, any, "of the payload, bytes");
    }
};

/// What stands after a payload.
struct ChunkEnd {
    std::uint32_t checksum = 0;

    void fields(auto& io) { io.u32("checksum", checksum, any, "low 32 bits of XXH3-64 of type, size and payload"); }
};

/// The payload of INDX.
struct Index {
    struct Entry {
        Tag type = 0;
        std::uint64_t offset = 0; ///< of the chunk's first byte (its type) in the file
        std::uint64_t size = 0;   ///< of the payload

        void fields(auto& io)
        {
            io.tag("type", type, "type of the chunk");
            io.varint("offset", offset, any, "of the chunk's first byte in the file");
            io.varint("size", size, any, "of its payload, bytes");
        }
    };
    std::vector<Entry> chunks;

    void fields(auto& io) { io.list("chunks", chunks, any, "all chunks before this one, in file order"); }
};

/// The payload of TAIL.
struct Tail {
    std::uint64_t index_offset = 0;
    std::uint64_t file_size = 0;

    static constexpr std::size_t chunk_size = 4 + 1 + 16 + 4; ///< of the whole TAIL chunk: the last bytes of every file

    void fields(auto& io)
    {
        io.u64("index_offset", index_offset, any, "of INDX' first byte in the file");
        io.u64("file_size", file_size, any, "of the whole file, this chunk included, bytes");
    }
};

/// One chunk, its checksum verified. Views into the file's bytes.
struct Chunk {
    Tag type = 0;
    std::uint64_t begin = 0;  ///< of its first byte (the type) in the file
    std::uint64_t offset = 0; ///< of its payload in the file
    ByteView payload;
    std::uint32_t checksum = 0;

    std::uint64_t end() const { return offset + payload.size() + 4; }
    Source source() const { return {payload, offset, name_of(type)}; }
};

/// Low 32 bits of XXH3-64: enough to notice an accident (one in four billion slips through), and small clips stay small.
std::uint32_t checksum_of(ByteView bytes);
/// XXH3-64, seed 0.
std::uint64_t hash_of(ByteView bytes);

/// Builds a file: add() each chunk in order, then finish().
class StreamWriter {
public:
    /// Into an empty spool, which must outlive it.
    explicit StreamWriter(Spool& spool);

    /// Appends a chunk of ready bytes. What cannot be written finish() tells, or the next chunk made from a struct.
    void add(Tag type, ByteView payload);
    /// Appends a chunk from a struct. @fails usage: a field is outside its range; as the spool does.
    template <class Struct>
    requires requires(Struct& value, Writer& writer) { value.fields(writer); }
    Status add(Tag type, const Struct& value)
    {
        MESHREEL_TRY(const Bytes payload, write_fields(value));
        add(type, ByteView(payload));
        return written_;
    }
    /// Appends index and tail. @fails as the spool does.
    Status finish();

private:
    void put(ByteView bytes);

    Spool* spool_;
    Index index_;
    Status written_ = Ok{}; ///< so far
};

/// The same in memory.
class MemoryWriter : public StreamWriter {
public:
    MemoryWriter() : MemoryWriter(std::make_unique<MemorySpool>()) {}

    /// Appends index and tail; the whole file.
    Bytes finish() &&;

private:
    explicit MemoryWriter(std::unique_ptr<MemorySpool> spool) : StreamWriter(*spool), spool_(std::move(spool)) {}

    std::unique_ptr<MemorySpool> spool_;
};

/// A file taken apart: every length, checksum, order and number of chunks verified.
class StreamReader {
public:
    /// The bytes must outlive the reader. @fails bad_input: not a .reel file, cut off, damaged, out of order;
    /// unsupported: a later major version, or a chunk that may not be skipped and that we do not know.
    static Result<StreamReader> open(ByteView file, const DecodeLimits& limits = {});

    /// Fetches everything but the segments, on the word of the index: HEAD, TIME, CONN and what travels along, each
    /// chunk verified. chunks() then has no SEGM. @fails as above; io.
    static Result<StreamReader> open_head(ByteSource& file, const DecodeLimits& limits = {});

    /// The same from a file that may have been cut off within a segment, or is still on its way: on the word of the chunks
    /// themselves, one after the other. index() has what is there, the segment that was cut too.
    static Result<StreamReader> open_beginning(ByteSource& file, const DecodeLimits& limits = {});

    StreamReader(const StreamReader&) = delete; // views into itself
    StreamReader(StreamReader&&) = default;
    StreamReader& operator=(StreamReader&&) = default;

    const Preamble& preamble() const { return preamble_; }
    /// What INDX says: every chunk before it, in file order.
    const Index& index() const { return index_; }
    /// All chunks but INDX and TAIL, in file order; unknown ones that may be skipped too.
    const std::vector<Chunk>& chunks() const { return chunks_; }
    /// The chunk of a type that occurs at most once; null where it is absent.
    const Chunk* find(Tag type) const;
    /// All chunks of a type, in file order.
    std::vector<Chunk> all(Tag type) const;
    /// The struct in a chunk of a type that must be there. @fails bad_input: absent, or a field is wrong.
    template <class Struct>
    Result<Struct> read(Tag type) const
    {
        const Chunk* chunk = find(type);
        if (chunk == nullptr) return missing(type);
        return read_fields<Struct>(chunk->source(), limits_);
    }
    const DecodeLimits& limits() const { return limits_; }
    /// All bytes; none after open_head().
    ByteView file() const { return file_; }
    const Chunk& index_chunk() const { return index_chunk_; }
    const Chunk& tail_chunk() const { return tail_chunk_; }

private:
    StreamReader() = default;
    static Error missing(Tag type);
    Status walk();
    Status check_known() const;
    Status check_counts() const;
    Status check_index();
    static Result<StreamReader> open_with(Status (StreamReader::*find_index)(ByteSource&), ByteSource& file,
                                          const DecodeLimits& limits);
    Status fetch_index(ByteSource& file);
    Status collect_index(ByteSource& file);
    Status fetch_preamble(ByteSource& file);
    Status fetch_head(ByteSource& file);

    ByteView file_;
    std::vector<Bytes> fetched_; ///< what chunks_ look into after open_head()
    DecodeLimits limits_;
    Preamble preamble_;
    Index index_;
    std::vector<Chunk> chunks_;
    Chunk index_chunk_, tail_chunk_;
};

/// For readers that fetch parts of a file. The first bytes of the file: 16 are enough. @fails bad_input, unsupported.
Result<Preamble> read_preamble(ByteView first_bytes);
/// The last Tail::chunk_size bytes (or more) of a file. @fails bad_input: no tail, or another file size.
Result<Tail> read_tail(ByteView last_bytes, std::uint64_t file_size);
/// Bytes of a whole chunk, type to checksum, whose payload has so many.
std::uint64_t chunk_size(std::uint64_t payload_size);
/// The chunk that an entry of an index names, from its bytes. @fails bad_input: damaged, or not the one.
Result<Chunk> read_entry(ByteView bytes, const Index::Entry& entry);
/// One chunk at the start of `bytes`, which stand at `begin` in the file. @fails bad_input: cut off or damaged.
Result<Chunk> read_chunk(ByteView bytes, std::uint64_t begin);

} // namespace meshreel::container
