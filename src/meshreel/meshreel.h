/// The front door: load, save, encode, decode, measure.
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "meshreel/base/file.h"
#include "meshreel/base/limits.h"
#include "meshreel/base/order.h"
#include "meshreel/base/parallel.h"
#include "meshreel/base/progress.h"
#include "meshreel/base/result.h"
#include "meshreel/codecs/settings.h"
#include "meshreel/io/io.h"
#include "meshreel/mesh/frame_source.h"
#include "meshreel/metrics/measure.h"
#include "meshreel/tune/effort.h"

namespace meshreel {

/// The quality asked for: at most one of the targets, or bases and step by hand. Each target is met, and verified on the
/// decoded file; where the data allow, within 3 % of it. Nothing set: visually lossless, docs/quality.md.
struct Quality {
    std::optional<double> kg;                 ///< KG error of at most so many percent, > 0 (thesis (5.2))
    std::optional<double> sted;               ///< STED of at most this, > 0 (thesis 7.3)
    std::optional<double> max_error;          ///< largest distance of any vertex in any frame, model units, > 0
    std::optional<double> max_error_relative; ///< the same in percent of the first frame's body diagonal, > 0
    std::optional<double> psnr;               ///< PSNR of at least so many dB, > 0, as metrics::psnr has it
    std::optional<std::uint64_t> size;        ///< a file of at most so many bytes, > 0, as good as possible
    std::optional<double> bpfv;               ///< the same in bits a frame and vertex, > 0 (thesis (9.1))
    std::optional<std::uint32_t> bases;       ///< K, the number of eigentrajectories, > 0; none: as the step suggests
    std::optional<double> step;               ///< quantisation step of the coefficients as a fraction of the body
                                              ///< diagonal, > 0; none: as the number of bases suggests
};

struct EncodeOptions {
    std::string codec = "reel";
    Quality quality;
    std::optional<Tune> tune; ///< what should look best; none: what the target measures, STED where there is none
    int effort = tune::usual_effort; ///< 1 fastest .. 9 smallest, docs/effort.md
    bool fast_decode = false;        ///< opens in half the time, some percent larger (reel)
    Order order = Order::keep;
    const Animation* base = nullptr; ///< for Order::base: V and triangles that the reader will have
    BasisCoding basis = BasisCoding::cobra;
    Entropy entropy = Entropy::range;
    /// Frames that share a basis, at most: a reader that wants one of them reads them all. 0: the encoder decides;
    /// one_segment: never cut.
    std::uint32_t segment = 0;
    Threads threads;
    Progress progress;
};
inline constexpr std::uint32_t one_segment = 0xffffffff;

/// What an encoding reached, measured on the decoded file.
struct Reached {
    std::uint64_t file_bytes = 0;
    double bpfv = 0.0;          ///< bits of the whole file over F V (9.1)
    double kg = 0.0;            ///< KG error, percent
    double max_error = 0.0;     ///< model units
    double psnr = 0.0;          ///< dB; infinite where nothing was lost
    std::optional<double> sted; ///< where it was asked for, by target or tune
    std::uint32_t bases = 0;    ///< K
    double step = 0.0;          ///< coefficient step, fraction of the body diagonal
};

struct Encoded : Reached {
    Bytes bytes; ///< the whole .reel file
};

struct DecodeOptions {
    const Animation* base = nullptr; ///< the base mesh of a file made with Order::base
    io::FrameRange frames = {};      ///< stored frames to take; default: all
    /// Show the time from the first to the last of them (of a loop: up to its next turn) at so many frames a second,
    /// > 0: between stored frames motion is interpolated, cubic in time and exactly through them. None: as stored.
    std::optional<double> fps = {};
    /// Level of detail: 0 is everything, each further one has about a quarter of the vertices, and triangles of its own
    /// (see docs/format.md). Of a file read in parts only the beginning of a segment is read.
    std::uint32_t level = 0;
    DecodeLimits limits = {};
    Threads threads = {};
    Progress progress = {};
};

/// Compresses an animation. A quality target is verified on the decoded bytes before this returns.
/// @fails bad_input: the animation is not valid; usage: the options contradict each other; missed: no setting of the
/// codec reaches the target, or coordinates near float32's largest would be decoded beyond it.
Result<Encoded> encode(const Animation& animation, const EncodeOptions& options = {});

/// The same of frames that are read when they are needed, again and again: of a long animation one segment is in memory
/// at a time, and the file. @fails as above; as the source does.
Result<Encoded> encode(FrameSource& frames, const EncodeOptions& options = {});

/// The same into an empty spool, such as an AtomicFile: of a codec that loses nothing not even the file is in memory. Where
/// it fails, what the spool holds is no file. @fails as above; as the spool does.
Result<Reached> encode(FrameSource& frames, Spool& spool, const EncodeOptions& options = {});

/// Rebuilds an animation. Any bytes may be given. @fails bad_input, unsupported, naming byte and field.
Result<Animation> decode(ByteView reel, const DecodeOptions& options = {});

/// The same from a file of which only what is needed is fetched: index and head, and of the segments those that hold a
/// frame asked for. Unlike decode(ByteView) it does not verify the others. For a level above 0 the file may have been cut
/// off behind what the level needs: after LevelInfo::bytes, if it has one segment. @fails as decode; io.
Result<Animation> decode(ByteSource& reel, const DecodeOptions& options = {});

/// All stored frames of a file, decoded when they are asked for, of which one segment is in memory at a time. The file must
/// outlive it; of the options frames, fps and level stay at their defaults. @fails as decode.
Result<std::unique_ptr<FrameSource>> open_frames(ByteSource& reel, const DecodeOptions& options = {});

/// The animation numbered as Order::free would give it back: to compare a decoded file with its original.
Animation in_free_order(const Animation& animation, Threads threads = {});
/// The same of frames that are read when they are needed. The source must outlive it. @fails as the source does.
Result<std::unique_ptr<FrameSource>> in_free_order(FrameSource& source, Threads threads = {});

/// What a .reel file says of itself, without decoding the positions.
struct Info {
    std::string codec, encoder; ///< encoder: program and version that wrote the file
    std::uint16_t version_major = 0, version_minor = 0;
    std::uint64_t vertices = 0, coded_vertices = 0, triangles = 0, frames = 0; ///< coded: after welding
    Order order = Order::keep;
    Metadata meta;
    double start_s = 0.0, end_s = 0.0;
    std::vector<std::string> attributes, materials, groups, assets;
    struct Chunk {
        std::string type;
        std::uint64_t offset = 0, size = 0;
    };
    std::vector<Chunk> chunks;
    std::vector<std::uint64_t> level_bytes; ///< of the file that each level of detail takes, as LevelInfo::bytes
    std::uint64_t decoded_bytes = 0;        ///< that all frames and triangles take: 12 (V F + T)
    /// What a reader should know before it decodes: that the file unpacks to more than usual_expansion times its size (64 KB
    /// for 100 bytes), or that these limits refuse it.
    std::vector<std::string> warnings;
    static constexpr std::uint64_t usual_expansion = 655;
};
Result<Info> info(ByteView reel, const DecodeLimits& limits = {});

/// A level of detail of a file. Errors: how far the vertices of level 0 are from the nearest points of this level's
/// triangles in the same frame, over all vertices of up to 16 frames spread evenly over the file; percent of the first
/// frame's body diagonal; infinite where no triangle is left.
struct LevelInfo {
    std::uint64_t vertices = 0, triangles = 0;
    std::uint64_t bytes = 0; ///< of the file that the level takes: less than all of it from level 1 on
    double rms_error = 0.0, max_error = 0.0;
};
/// All levels, finest first; decodes each. Of the options frames, fps and level are ignored. @fails as decode().
Result<std::vector<LevelInfo>> levels(ByteView reel, const DecodeOptions& options = {});

/// Every field of a .reel file with its byte offset, size, value and meaning, a line each.
Result<std::string> explain(ByteView reel, const DecodeLimits& limits = {});

/// Checks every byte of a .reel file: structure, checksums, a full decode.
Status check_reel(ByteView reel, const DecodeOptions& options = {});

} // namespace meshreel
