/// The frames of a .reel file, of which one segment is decoded at a time.
// SPDX-License-Identifier: MIT
#include "meshreel/base/memory.h"
#include "meshreel/codecs/opening.h"
#include "meshreel/container/segments.h"
#include "meshreel/mesh/reorder.h"
#include "meshreel/meshreel.h"

namespace meshreel {

namespace {

class ReelFrames : public FrameSource {
public:
    ReelFrames(ByteSource& file, container::StreamReader head, const container::Header& header,
               const DecodeOptions& options)
        : head_(std::move(head)), header_(header), options_(options), file_bytes_(file.size()),
          segments_(file, head_, header_)
    {
    }

    /// Everything but the segments.
    Status open()
    {
        container::Budget budget(options_.limits.max_memory);
        MESHREEL_CHECK(within(options_.limits, header_.vertex_count, header_.triangle_count, 1));
        const std::uint64_t bytes = 12 * std::uint64_t{header_.vertex_count} * header_.frame_count;
        MESHREEL_CHECK(within_expansion(options_.limits, bytes, file_bytes_));
        MESHREEL_TRY(codec_, codecs::codec_of(header_));
        MESHREEL_TRY(topology_, codecs::read_topology(head_, header_, options_.base));
        still_.vertex_count = header_.vertex_count;
        still_.triangles = topology_.triangles;
        MESHREEL_TRY(still_.times_s, container::read_times(head_, header_, budget));
        MESHREEL_TRY(still_.meta, container::read_metadata(head_));
        MESHREEL_TRY(still_.appearance,
                     container::read_appearance(head_, {header_.vertex_count, still_.triangles}, budget));
        return validate_still(still_);
    }

    const Animation& still() const override { return still_; }

    Result<MatrixView<const float>> frames(std::size_t first, std::size_t count, Matrix<float>& room) override
    {
        return within_memory([&] { return decoded(first, count, room); });
    }

private:
    Result<MatrixView<const float>> decoded(std::size_t first, std::size_t count, Matrix<float>& room)
    {
        const std::size_t width = 3ul * still_.vertex_count;
        if (room.rows != count || room.cols != width) room = Matrix<float>(count, width);
        for (std::size_t i = 0; i < count; ++i) {
            if (first + i - held_first_ >= held_.rows) MESHREEL_CHECK(hold(static_cast<std::uint32_t>(first + i)));
            reorder_frame(held_.row(first + i - held_first_), topology_.surface_of, room.row(i));
        }
        return MatrixView<const float>(room.view());
    }

    /// Decodes the segment that holds a frame.
    Status hold(std::uint32_t frame)
    {
        held_ = {};
        MESHREEL_TRY(const container::Segment segment, segments_.holding(frame));
        MESHREEL_CHECK(within(options_.limits, header_.coded_vertex_count, 0, segment.frame_count));
        Matrix<float> frames(segment.frame_count, 3ul * header_.coded_vertex_count);
        MESHREEL_CHECK(codecs::decode(
            *codec_, {segment.source(), topology_.surface, segment.frame_count, options_.limits, options_.threads},
            frames.view()));
        MESHREEL_CHECK(validate_frames(segment.first_frame, frames.view()));
        held_ = std::move(frames);
        held_first_ = segment.first_frame;
        return Ok{};
    }

    container::StreamReader head_;
    container::Header header_;
    DecodeOptions options_;
    std::uint64_t file_bytes_;
    container::SegmentFetcher segments_;
    const codecs::Codec* codec_ = nullptr;
    connectivity::Topology topology_;
    Animation still_;
    Matrix<float> held_; ///< [F x 3W] frames of one segment
    std::size_t held_first_ = 0;
};

} // namespace

Result<std::unique_ptr<FrameSource>> open_frames(ByteSource& reel, const DecodeOptions& options)
{
    return within_memory([&]() -> Result<std::unique_ptr<FrameSource>> {
        const bool some = options.frames.first != 0 || options.frames.last < ~0ull || options.frames.step != 1;
        if (some || options.fps || options.level != 0)
            return Error{
                ErrorCode::usage, "frames are given as they are stored, all of them, in full detail", {}, {}, {}};
        MESHREEL_TRY(container::StreamReader head, container::StreamReader::open_head(reel, options.limits));
        MESHREEL_TRY(const container::Header header, container::read_header(head));
        auto frames = std::make_unique<ReelFrames>(reel, std::move(head), header, options);
        MESHREEL_CHECK(frames->open());
        return std::unique_ptr<FrameSource>(std::move(frames));
    });
}

} // namespace meshreel
