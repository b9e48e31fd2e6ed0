/// A file on its way: what its bytes so far allow to be shown is decoded as soon as they are there.
// SPDX-License-Identifier: MIT
//
//   Incoming file(options);
//   each time bytes come:  copy them to file.room(n);  file.receive(n);
//                          while (*file.step(false) != Incoming::Event::none) ...
//   when no more come:     the same with step(true), until Event::done
#pragma once

#include <optional>
#include <vector>

#include "meshreel/codecs/codec.h"
#include "meshreel/connectivity/topology.h"
#include "meshreel/container/package.h"
#include "meshreel/container/segments.h"
#include "meshreel/level.h"

namespace meshreel::wasm {

struct IncomingOptions {
    /// Level of detail to be shown before the first segment is there; of a coarser file its coarsest, of one without levels
    /// none. 0: none.
    std::uint32_t coarse_level = 0;
    /// Of every segment the level, and nothing else, where the file has levels.
    bool level_alone = false;
    DecodeLimits limits = {};
};

/// A run of frames, of all vertices or of a level's.
struct Piece {
    std::uint32_t first_frame = 0, frame_count = 0;
    codecs::Opened opened;                ///< of W surface vertices; of a level: of its V' vertices
    std::optional<Level> level;           ///< none: of everything
    std::optional<Appearance> appearance; ///< of the level
};

class Incoming {
public:
    enum class Event : std::uint8_t {
        none,    ///< more bytes are needed
        head,    ///< still() and topology() are there; again, if a file has some of it behind its segments
        level,   ///< piece() is the next segment, coarse
        segment, ///< piece() is the next segment
        done     ///< all bytes are there and verified
    };

    explicit Incoming(const IncomingOptions& options) : options_(options) {}

    /// Where the next `count` bytes go. @fails bad_input: more than the memory limit.
    Result<std::uint8_t*> room(std::size_t count);
    void receive(std::size_t count) { size_ += count; }

    /// The base mesh of a file made with Order::base, to be filled before the first step.
    std::span<Triangle> base(std::uint32_t vertex_count, std::size_t triangle_count);

    /// The next thing that the bytes allow. complete: no more bytes come. After an error nothing else may be asked.
    /// @fails as decode().
    Result<Event> step(bool complete);

    const container::Header& header() const { return header_; }
    const Animation& still() const { return still_; } ///< all but the positions
    const connectivity::Topology& topology() const { return topology_; }
    const Piece& piece() const { return piece_; }
    /// The piece's frames [count x 3V], bit for bit what decode() gives. @fails bad_input: infinite ones.
    Result<std::vector<float>> frames() const;

private:
    ByteView bytes() const { return ByteView(buffer_).first(size_); }
    std::size_t beginning() const;
    Status read_head(bool complete);
    Result<Event> next_chunk(bool complete);
    Result<Event> take_segment(const container::Chunk& chunk);
    Result<Event> take_level(const container::Index::Entry& entry);
    Result<Event> finish();
    Status check_segment(const container::Segment& segment, std::uint64_t at) const;
    codecs::Coded coded(const container::Segment& segment) const;

    IncomingOptions options_;
    std::optional<Animation> base_;
    Bytes buffer_;
    std::size_t size_ = 0; ///< bytes received
    bool opened_ = false;
    std::size_t chunks_ = 0; ///< that head was read from
    std::uint64_t at_ = container::Preamble::size;
    std::uint32_t next_frame_ = 0;
    bool level_shown_ = false;
    std::optional<Level> alone_; ///< shown of every segment
    container::Header header_;
    Animation still_;
    connectivity::Topology topology_;
    const codecs::Codec* codec_ = nullptr;
    Piece piece_;
};

} // namespace meshreel::wasm
