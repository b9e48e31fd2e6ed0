/// Decoded segments against runs of their originals.
// SPDX-License-Identifier: MIT
#include "meshreel/verification.h"

#include <algorithm>

#include "meshreel/base/text.h"
#include "meshreel/codecs/opening.h"
#include "meshreel/container/segments.h"
#include "meshreel/mesh/reorder.h"
#include "meshreel/metrics/kg.h"
#include "meshreel/metrics/sted.h"

namespace meshreel {

namespace {

/// Coordinates near float32's largest may be decoded beyond it, which no reader takes.
Status still_finite(std::size_t first, MatrixView<const float> decoded)
{
    const Status finite = validate_frames(first, decoded);
    if (finite.ok()) return finite;
    return Error{ErrorCode::missed,
                 concat("decoded, ", finite.error().message, "; so large coordinates need a finer step, or lossless"),
                 finite.error().field};
}

class Verifier {
public:
    Verifier(FrameSource& source, const VerificationOptions& options)
        : source_(source), options_(options), kg_(options.threads), error_(options.threads)
    {
        const Animation& still = source.still();
        metrics::StedOptions sted;
        sted.threads = options.threads;
        if (options.sted) sted_.emplace(still.vertex_count, still.triangles, sted);
    }

    void number(const connectivity::Topology& topology)
    {
        surface_of_.resize(topology.surface_of.size());
        for (std::size_t i = 0; i < surface_of_.size(); ++i)
            surface_of_[options_.vertex_of[i]] = topology.surface_of[i];
    }

    /// The next decoded frames, [N x 3W], of which the first has the number `first`.
    Status add(std::size_t first, MatrixView<const float> decoded)
    {
        const std::size_t run = frames_a_run(source_.still().vertex_count);
        for (std::size_t f = 0; f < decoded.rows; f += run) {
            const std::size_t count = std::min(run, decoded.rows - f);
            MESHREEL_TRY(const MatrixView<const float> original, source_.frames(first + f, count, room_));
            const Matrix<float> distorted = spread({decoded.row(f).data(), count, decoded.cols});
            MESHREEL_CHECK(still_finite(first + f, distorted.view()));
            const metrics::Pair<float> pair{original, distorted.view(), source_.still().triangles};
            kg_.add(pair);
            error_.add(pair);
            if (sted_) sted_->add(pair);
        }
        return Ok{};
    }

    Difference finish()
    {
        return {kg_.value(), error_.value(), sted_ ? std::optional(sted_->finish().total) : std::nullopt};
    }

private:
    /// From surface vertices to the source's.
    Matrix<float> spread(MatrixView<const float> decoded) const
    {
        Matrix<float> all(decoded.rows, 3 * surface_of_.size());
        parallel_for(decoded.rows, options_.threads,
                     [&](std::size_t f) { reorder_frame(decoded.row(f), surface_of_, all.row(f)); });
        return all;
    }

    FrameSource& source_;
    const VerificationOptions& options_;
    std::vector<std::uint32_t> surface_of_; ///< [V] of each of the source's vertices
    Matrix<float> room_;
    metrics::RunningKg kg_;
    metrics::RunningVertexError error_;
    std::optional<metrics::RunningSted> sted_;
};

/// What is not positions must be readable too.
Status check_rest(const container::StreamReader& file, const container::Header& header,
                  const connectivity::Topology& topology)
{
    container::Budget budget(file.limits().max_memory);
    MESHREEL_TRY(const std::vector<double> times, container::read_times(file, header, budget));
    MESHREEL_TRY(const Metadata meta, container::read_metadata(file));
    MESHREEL_TRY(const Appearance appearance,
                 container::read_appearance(file, {header.vertex_count, topology.triangles}, budget));
    return Ok{};
}

} // namespace

Result<Difference> difference(ByteSource& bytes, FrameSource& source, const VerificationOptions& options)
{
    MESHREEL_TRY(const container::StreamReader file, container::StreamReader::open_head(bytes));
    MESHREEL_TRY(const container::Header header, container::read_header(file));
    container::SegmentFetcher segments(bytes, file, header);
    MESHREEL_TRY(const codecs::Codec* codec, codecs::codec_of(header));
    MESHREEL_TRY(const connectivity::Topology topology, codecs::read_topology(file, header, options.base));
    MESHREEL_CHECK(check_rest(file, header, topology));
    Verifier verifier(source, options);
    verifier.number(topology);
    for (std::uint32_t f = 0; f < header.frame_count;) {
        MESHREEL_TRY(const container::Segment segment, segments.holding(f));
        Matrix<float> frames(segment.frame_count, 3ul * header.coded_vertex_count);
        MESHREEL_CHECK(codecs::decode(
            *codec, {segment.source(), topology.surface, segment.frame_count, file.limits(), options.threads},
            frames.view()));
        MESHREEL_CHECK(verifier.add(f, frames.view()));
        f += segment.frame_count;
    }
    return verifier.finish();
}

} // namespace meshreel
