/// What each level of detail of a file holds, costs and misses.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "meshreel/base/memory.h"
#include "meshreel/codecs/opening.h"
#include "meshreel/container/package.h"
#include "meshreel/container/segments.h"
#include "meshreel/level.h"
#include "meshreel/meshreel.h"
#include "meshreel/metrics/surface_distance.h"

namespace meshreel {

namespace {

constexpr std::uint64_t most_measured_frames = 16;

/// Of a frame's vertices, squared model units.
struct FrameDistance {
    double sum = 0.0, largest = 0.0;
};

FrameDistance distance_to_level(std::span<const float> fine, const Animation& coarse, std::size_t f)
{
    const metrics::SurfaceDistance surface(coarse.triangles, coarse.frame(f));
    FrameDistance result;
    for (std::size_t i = 0; i < fine.size(); i += 3) {
        const double square = surface.squared({fine[i], fine[i + 1], fine[i + 2]});
        result.sum += square;
        result.largest = std::max(result.largest, square);
    }
    return result;
}

/// Fills in how far the finest animation is from a coarser one.
void measure(const Animation& fine, const Animation& coarse, Threads threads, LevelInfo& level)
{
    std::vector<FrameDistance> frames(fine.frame_count());
    parallel_for(frames.size(), threads,
                 [&](std::size_t f) { frames[f] = distance_to_level(fine.frame(f), coarse, f); });
    FrameDistance all;
    for (const FrameDistance& frame : frames) {
        all.sum += frame.sum;
        all.largest = std::max(all.largest, frame.largest);
    }
    const double length = body_diagonal(fine), percent = 100 / (length > 0 ? length : 1.0);
    level.rms_error = percent * std::sqrt(all.sum / (static_cast<double>(fine.positions.size()) / 3));
    level.max_error = percent * std::sqrt(all.largest);
}

} // namespace

Result<std::vector<std::uint64_t>> level_bytes(const container::StreamReader& file, const container::Header& header,
                                               const codecs::Codec& codec)
{
    std::vector<std::uint64_t> bytes{file.file().size()};
    if (codec.level_bytes == nullptr) return bytes;
    MESHREEL_TRY(const std::vector<container::Segment> segments, container::read_segments(file, header));
    std::uint64_t besides = file.file().size();
    for (const container::Segment& segment : segments) besides -= segment.payload.size();
    for (std::size_t s = 0; s < segments.size(); ++s) {
        MESHREEL_TRY(const std::vector<std::uint64_t> ends, codec.level_bytes(segments[s].source(), file.limits()));
        if (s == 0) bytes.resize(ends.size(), besides);
        for (std::size_t level = 1; level < bytes.size(); ++level) bytes[level] += s == 0 ? ends[level] : ends[0];
    }
    return bytes;
}

Result<std::vector<LevelInfo>> levels(ByteView reel, const DecodeOptions& options)
{
    return within_memory([&]() -> Result<std::vector<LevelInfo>> {
        MESHREEL_TRY(const container::StreamReader file, container::StreamReader::open(reel, options.limits));
        MESHREEL_TRY(const container::Header header, container::read_header(file));
        MESHREEL_TRY(const codecs::Codec* codec, codecs::codec_of(header));
        MESHREEL_TRY(const std::vector<std::uint64_t> bytes, level_bytes(file, header, *codec));
        DecodeOptions some = options;
        some.fps = {};
        some.frames = {0, header.frame_count - 1, (header.frame_count - 1) / most_measured_frames + 1};
        some.level = 0;
        MESHREEL_TRY(const Animation fine, decode(reel, some));
        std::vector<LevelInfo> result{{fine.vertex_count, fine.triangles.size(), bytes[0], 0.0, 0.0}};
        for (some.level = 1; some.level < bytes.size(); ++some.level) {
            MESHREEL_TRY(const Animation coarse, decode(reel, some));
            result.push_back({coarse.vertex_count, coarse.triangles.size(), bytes[some.level], 0.0, 0.0});
            measure(fine, coarse, options.threads, result.back());
        }
        return result;
    });
}

} // namespace meshreel
