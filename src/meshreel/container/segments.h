/// The segments of a file, found by the frames they hold.
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "meshreel/container/chunks.h"
#include "meshreel/container/stream.h"

namespace meshreel::container {

/// Gives the segment that holds a frame.
class SegmentSource {
public:
    virtual ~SegmentSource() = default;
    /// @param frame  0 .. F-1.  @return the segment, valid until the next call.  @fails bad_input, io.
    virtual Result<Segment> holding(std::uint32_t frame) = 0;
};

/// All segments of a file in memory, verified to cover 0 .. F-1. The file must outlive it.
class SegmentList : public SegmentSource {
public:
    static Result<SegmentList> open(const StreamReader& file, const Header& header);
    Result<Segment> holding(std::uint32_t frame) override;

private:
    std::vector<Segment> segments_;
};

/// A segment from the first bytes of its chunk, its payload as far as they go; no checksum is verified. @fails bad_input.
Result<Segment> beginning_of(const Index::Entry& entry, ByteView bytes, const DecodeLimits& limits);

/// Segments that are fetched when they are asked for. Which one holds a frame is found by halving, at a few bytes a
/// look. The file and its head must outlive it.
class SegmentFetcher : public SegmentSource {
public:
    /// head: of StreamReader::open_head(file), or open_beginning.
    SegmentFetcher(ByteSource& file, const StreamReader& head, const Header& header);
    Result<Segment> holding(std::uint32_t frame) override;

    /// How many first bytes of a segment's payload are needed, from the first 256 of them, or all.
    using Needed = std::function<Result<std::uint64_t>(const Segment& beginning)>;
    /// From now on fetches no more of a segment than that. What is cut off is not verified by a checksum.
    void fetch_only(Needed needed)
    {
        needed_ = std::move(needed);
        last_.reset();
    }

private:
    Result<Segment> look(std::size_t s);
    Result<Segment> fetch(std::size_t s);
    Result<Segment> fetch_beginning(std::size_t s);
    std::uint64_t there(const Index::Entry& entry) const;

    ByteSource& file_;
    const StreamReader& head_;
    std::uint32_t frame_count_;
    std::vector<Index::Entry> entries_;     ///< the SEGM of the index
    std::map<std::size_t, Segment> looked_; ///< what was found out: numbers of frames, no payload
    Bytes bytes_;                           ///< of the segment fetched last
    std::optional<Segment> last_;           ///< that segment
    Needed needed_;                         ///< empty: all of it
};

} // namespace meshreel::container
