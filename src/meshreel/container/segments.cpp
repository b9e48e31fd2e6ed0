/// Segments out of memory, and out of a file that is read in parts.
// SPDX-License-Identifier: MIT
#include "meshreel/container/segments.h"

#include <algorithm>

#include "meshreel/base/text.h"
#include "meshreel/container/package.h"

namespace meshreel::container {

Result<SegmentList> SegmentList::open(const StreamReader& file, const Header& header)
{
    SegmentList list;
    MESHREEL_TRY(list.segments_, read_segments(file, header));
    return list;
}

Result<Segment> SegmentList::holding(std::uint32_t frame)
{
    const auto next = std::upper_bound(segments_.begin(), segments_.end(), frame,
                                       [](std::uint32_t f, const Segment& segment) { return f < segment.first_frame; });
    return *(next - 1);
}

SegmentFetcher::SegmentFetcher(ByteSource& file, const StreamReader& head, const Header& header)
    : file_(file), head_(head), frame_count_(header.frame_count)
{
    for (const Index::Entry& entry : head.index().chunks)
        if (entry.type == type::segm) entries_.push_back(entry);
}

namespace {

constexpr std::uint64_t longest_segment_head = 4 + 10 + 5 + 5; // type, size, first_frame, frame_count
constexpr std::uint64_t payload_head = 256;

} // namespace

Result<Segment> beginning_of(const Index::Entry& entry, ByteView bytes, const DecodeLimits& limits)
{
    Reader reader({bytes, entry.offset, name_of(entry.type)}, limits);
    ChunkHead chunk;
    Segment segment;
    chunk.fields(reader);
    segment.fields(reader);
    if (reader.failed()) return reader.failure();
    segment.payload_offset = entry.offset + static_cast<std::uint64_t>(segment.payload.data() - bytes.data());
    return segment;
}

/// The numbers of segment s, from its first bytes; its checksum waits until all of it is fetched.
Result<Segment> SegmentFetcher::look(std::size_t s)
{
    const auto known = looked_.find(s);
    if (known != looked_.end()) return known->second;
    const Index::Entry& entry = entries_[s];
    const auto size = static_cast<std::size_t>(std::min(longest_segment_head, there(entry)));
    MESHREEL_TRY(const Bytes bytes, file_.fetch(entry.offset, size));
    MESHREEL_TRY(Segment segment, beginning_of(entry, bytes, head_.limits()));
    segment.payload = {};
    segment.payload_offset = 0;
    return looked_.emplace(s, segment).first->second;
}

/// Bytes of a chunk that the file has.
std::uint64_t SegmentFetcher::there(const Index::Entry& entry) const
{
    return std::min(chunk_size(entry.size), file_.size() - entry.offset);
}

Result<Segment> SegmentFetcher::fetch(std::size_t s)
{
    const std::uint64_t size = chunk_size(entries_[s].size);
    if (size > there(entries_[s])) return bad_input("the file ends too early", "SEGM", at_byte(file_.size()));
    MESHREEL_CHECK(within(size, head_.limits().max_memory, "SEGM"));
    MESHREEL_TRY(bytes_, file_.fetch(entries_[s].offset, static_cast<std::size_t>(size)));
    MESHREEL_TRY(const Chunk chunk, read_entry(bytes_, entries_[s]));
    return read_segment(chunk, head_.limits());
}

/// As much of a segment as is needed.
Result<Segment> SegmentFetcher::fetch_beginning(std::size_t s)
{
    const Index::Entry& entry = entries_[s];
    const std::uint64_t all = std::min(chunk_size(entry.size) - 4, there(entry)); // without the checksum
    auto size = static_cast<std::size_t>(std::min(longest_segment_head + payload_head, all));
    MESHREEL_TRY(bytes_, file_.fetch(entry.offset, size));
    MESHREEL_TRY(const Segment head, beginning_of(entry, bytes_, head_.limits()));
    MESHREEL_TRY(const std::uint64_t needed, needed_(head));
    const std::uint64_t begin = head.payload_offset - entry.offset;
    if (needed > all - begin) return fetch(s); // it will be found to end too early
    size = static_cast<std::size_t>(begin + needed);
    MESHREEL_CHECK(within(size, head_.limits().max_memory, "SEGM"));
    if (size > bytes_.size()) {
        MESHREEL_TRY(const Bytes more, file_.fetch(entry.offset + bytes_.size(), size - bytes_.size()));
        bytes_.insert(bytes_.end(), more.begin(), more.end());
    }
    bytes_.resize(size);
    return beginning_of(entry, bytes_, head_.limits());
}

Result<Segment> SegmentFetcher::holding(std::uint32_t frame)
{
    const auto has = [&](const Segment& segment) {
        return segment.first_frame <= frame && frame - segment.first_frame < segment.frame_count &&
               segment.frame_count <= frame_count_ - segment.first_frame;
    };
    if (last_ && has(*last_)) return *last_;
    last_.reset();
    std::size_t low = 0, high = entries_.size(); // the segment is in [low, high)
    while (high - low > 1) {
        const std::size_t middle = low + (high - low) / 2;
        MESHREEL_TRY(const Segment segment, look(middle));
        (segment.first_frame <= frame ? low : high) = middle;
    }
    MESHREEL_TRY(const Segment segment, needed_ ? fetch_beginning(low) : fetch(low));
    if (has(segment)) return *(last_ = segment);
    return bad_input(concat("frame ", frame, " is not where the segments' numbers lead"), "SEGM.first_frame",
                     at_byte(entries_[low].offset));
}

} // namespace meshreel::container
