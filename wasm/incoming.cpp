/// From chunk to chunk, each as soon as it is whole; of the first segment, or of each, a level as soon as that is.
// SPDX-License-Identifier: MIT
#include "incoming.h"

#include <algorithm>

#include "meshreel/base/text.h"
#include "meshreel/codecs/opening.h"
#include "meshreel/mesh/reorder.h"

namespace meshreel::wasm {

namespace {

using container::Chunk;
using container::ChunkHead;
using container::Segment;
using container::StreamReader;
namespace type = container::type;

constexpr std::uint64_t longest_chunk_head = 4 + 10;

/// The head of a chunk; none: its bytes are not there yet, or are wrong.
std::optional<ChunkHead> chunk_head(ByteView bytes, std::uint64_t at)
{
    if (at > bytes.size() || bytes.size() - at < longest_chunk_head) return {};
    container::Reader reader({bytes.subspan(static_cast<std::size_t>(at)), at, "chunk"}, {});
    ChunkHead head;
    head.fields(reader);
    if (reader.failed()) return {};
    return head;
}

bool is_whole(const ChunkHead& head, std::uint64_t left)
{
    return head.size < left && container::chunk_size(head.size) <= left;
}

std::size_t still_chunks(const StreamReader& file)
{
    return static_cast<std::size_t>(std::count_if(file.chunks().begin(), file.chunks().end(),
                                                  [](const Chunk& chunk) { return chunk.type != type::segm; }));
}

} // namespace

Result<std::uint8_t*> Incoming::room(std::size_t count)
{
    MESHREEL_CHECK(within(std::uint64_t{size_} + count, options_.limits.max_memory, "file"));
    if (size_ + count > buffer_.size()) buffer_.resize(std::max(size_ + count, buffer_.size() + buffer_.size() / 2));
    return buffer_.data() + size_;
}

std::span<Triangle> Incoming::base(std::uint32_t vertex_count, std::size_t triangle_count)
{
    base_.emplace();
    base_->vertex_count = vertex_count;
    base_->triangles.resize(triangle_count);
    return base_->triangles;
}

Result<Incoming::Event> Incoming::step(bool complete)
{
    if (opened_) return next_chunk(complete);
    if (!complete && beginning() == 0) return Event::none;
    MESHREEL_CHECK(read_head(complete));
    opened_ = true;
    return Event::head;
}

/// Up to which byte all is there that this library writes before the first segment, and that one's head; 0: not yet.
std::size_t Incoming::beginning() const
{
    bool time = false, conn = false;
    for (std::uint64_t at = container::Preamble::size;;) {
        const auto head = chunk_head(bytes(), at);
        if (!head) return 0;
        if (head->type == type::segm) return time && conn ? static_cast<std::size_t>(at + longest_chunk_head) : 0;
        if (head->type == type::indx || !is_whole(*head, size_ - at)) return 0;
        time |= head->type == type::time;
        conn |= head->type == type::conn;
        at += container::chunk_size(head->size);
    }
}

Status Incoming::read_head(bool complete)
{
    MemorySource source(bytes().first(beginning()));
    MESHREEL_TRY(const StreamReader file, complete ? StreamReader::open(bytes(), options_.limits)
                                                   : StreamReader::open_beginning(source, options_.limits));
    chunks_ = still_chunks(file);
    MESHREEL_TRY(header_, container::read_header(file));
    MESHREEL_CHECK(within(options_.limits, header_.vertex_count + std::uint64_t{header_.coded_vertex_count},
                          header_.triangle_count, 1));
    container::Budget budget(options_.limits.max_memory);
    still_.vertex_count = header_.vertex_count;
    MESHREEL_TRY(still_.times_s, container::read_times(file, header_, budget));
    MESHREEL_TRY(still_.meta, container::read_metadata(file));
    MESHREEL_TRY(codec_, codecs::codec_of(header_));
    MESHREEL_TRY(topology_, codecs::read_topology(file, header_, base_ ? &*base_ : nullptr));
    MESHREEL_TRY(still_.appearance,
                 container::read_appearance(file, {header_.vertex_count, topology_.triangles}, budget));
    still_.triangles = topology_.triangles;
    return validate_still(still_);
}

Result<Incoming::Event> Incoming::next_chunk(bool complete)
{
    while (next_frame_ < header_.frame_count) {
        const auto head = chunk_head(bytes(), at_);
        if (!head || head->type == type::indx) break;
        const bool whole = is_whole(*head, size_ - at_);
        if (head->type == type::segm && !level_shown_) {
            MESHREEL_TRY(const Event event, take_level({head->type, at_, head->size}));
            if (event != Event::none) return event;
        }
        if (!whole) break;
        MESHREEL_TRY(const Chunk chunk, container::read_chunk(bytes().subspan(static_cast<std::size_t>(at_)), at_));
        at_ = chunk.end();
        if (chunk.type == type::segm) return take_segment(chunk);
    }
    return complete ? finish() : Event::none;
}

codecs::Coded Incoming::coded(const Segment& segment) const
{
    return {segment.source(), topology_.surface, segment.frame_count, options_.limits, {1}};
}

Status Incoming::check_segment(const Segment& segment, std::uint64_t at) const
{
    if (segment.first_frame != next_frame_ || segment.frame_count > header_.frame_count - next_frame_)
        return bad_input(concat("frames ", segment.first_frame, " and ", segment.frame_count - 1ull,
                                " more, but frame ", next_frame_, " of ", header_.frame_count, " is next"),
                         "SEGM.first_frame", at_byte(at));
    return within(options_.limits, topology_.surface.vertex_count, 0, codec_->exact() ? segment.frame_count : 1);
}

Result<Incoming::Event> Incoming::take_segment(const Chunk& chunk)
{
    piece_ = {};
    MESHREEL_TRY(const Segment segment, container::read_segment(chunk, options_.limits));
    MESHREEL_CHECK(check_segment(segment, chunk.offset));
    codecs::Coded wanted = coded(segment);
    if (alone_) { // its vertices may stand anywhere in a later segment
        wanted.wanted = alone_->wanted;
        piece_.level = alone_;
        piece_.appearance = appearance_of(*alone_, still_.appearance);
    }
    MESHREEL_TRY(piece_.opened, codecs::open(*codec_, wanted));
    const auto* trajectories = std::get_if<codecs::Trajectories>(&piece_.opened);
    if (trajectories != nullptr && !codecs::float_holds(*trajectories))
        return bad_input("has positions that float32 cannot hold", "SEGM", at_byte(segment.payload_offset));
    piece_.first_frame = segment.first_frame;
    piece_.frame_count = segment.frame_count;
    next_frame_ += segment.frame_count;
    return alone_ ? Event::level : Event::segment;
}

/// None: it is not there yet, or there is none.
Result<Incoming::Event> Incoming::take_level(const container::Index::Entry& entry)
{
    constexpr std::uint64_t payload_head = 256;
    level_shown_ = options_.coarse_level == 0 || codec_->detail == nullptr;
    const std::uint64_t chunk = container::chunk_size(entry.size) - 4; // without the checksum
    const std::uint64_t there = std::min<std::uint64_t>(chunk, size_ - at_);
    if (level_shown_ || there < std::min(chunk, payload_head)) return Event::none;
    const ByteView part = bytes().subspan(static_cast<std::size_t>(at_), static_cast<std::size_t>(there));
    MESHREEL_TRY(Segment segment, container::beginning_of(entry, part, options_.limits));
    MESHREEL_CHECK(check_segment(segment, entry.offset));
    MESHREEL_TRY(const std::vector<std::uint64_t> ends, codec_->level_bytes(segment.source(), options_.limits));
    const auto level = static_cast<std::uint32_t>(std::min<std::size_t>(options_.coarse_level, ends.size() - 1));
    if (ends[level] > segment.payload.size() && level > 0) return Event::none;
    level_shown_ = true;
    if (level == 0) return Event::none;
    segment.payload = segment.payload.first(static_cast<std::size_t>(ends[level]));
    codecs::Coded first = coded(segment);
    MESHREEL_TRY(Level kept, level_of(*codec_, first, {topology_, still_.appearance}, level));
    first.wanted = kept.wanted;
    MESHREEL_TRY(codecs::Opened opened, codecs::open(*codec_, first));
    Appearance appearance = appearance_of(kept, still_.appearance);
    if (options_.level_alone) {
        alone_ = kept;
        at_ += container::chunk_size(entry.size);
        next_frame_ += segment.frame_count;
    }
    piece_ = {0, segment.frame_count, std::move(opened), std::move(kept), std::move(appearance)};
    return Event::level;
}

/// Verifies what was not looked at yet. A file may have more to say of its surface behind its segments.
Result<Incoming::Event> Incoming::finish()
{
    MESHREEL_TRY(const StreamReader file, StreamReader::open(bytes(), options_.limits));
    MESHREEL_TRY(const std::vector<Segment> segments, container::read_segments(file, header_));
    if (still_chunks(file) == chunks_) return Event::done;
    MESHREEL_CHECK(read_head(true));
    return Event::head;
}

Result<std::vector<float>> Incoming::frames() const
{
    const std::size_t F = piece_.frame_count;
    const auto* trajectories = std::get_if<codecs::Trajectories>(&piece_.opened);
    const std::size_t rows = trajectories != nullptr ? trajectories->C.rows : topology_.surface.vertex_count;
    MESHREEL_CHECK(within(options_.limits, rows + still_.vertex_count, 0, F));
    Matrix<float> frames(F, 3 * rows);
    if (trajectories != nullptr)
        codecs::rebuild(*trajectories, frames.view(), {1});
    else
        frames = std::get<Matrix<float>>(piece_.opened);
    MESHREEL_CHECK(validate_frames(piece_.first_frame, frames.view()));
    if (piece_.level) return std::move(frames.values);
    const std::size_t width = 3ul * still_.vertex_count;
    std::vector<float> positions(F * width);
    for (std::size_t f = 0; f < F; ++f)
        reorder_frame(frames.row(f), topology_.surface_of, std::span(positions).subspan(f * width, width));
    return positions;
}

} // namespace meshreel::wasm
