/// One pass over two sources, run after run, each run shown to every measurement.
// SPDX-License-Identifier: MIT
#include "meshreel/metrics/measure.h"

#include <algorithm>

#include "meshreel/base/text.h"

namespace meshreel::metrics {

namespace {

Status all_possible(const Animation& original, const Animation& distorted, std::span<const Wanted> wanted)
{
    for (const Wanted& one : wanted) {
        Status status = comparable(original, distorted, one.metric->common);
        if (status.ok()) continue;
        Error error = std::move(status).error();
        error.message = concat(one.metric->name, " needs ",
                               one.metric->common == Common::frames ? "equally many frames"
                                                                    : "each vertex' counterpart in the other animation",
                               ": ", error.message);
        return error;
    }
    return Ok{};
}

/// Frames first .. first + count - 1, or those of them that the source has.
Result<MatrixView<const float>> next_frames(FrameSource& source, std::size_t first, std::size_t count,
                                            Matrix<float>& room)
{
    const std::size_t F = source.frame_count();
    if (first >= F) return MatrixView<const float>{nullptr, 0, 3ul * source.still().vertex_count};
    return source.frames(first, std::min(count, F - first), room);
}

} // namespace

Result<std::vector<Measured>> measure(FrameSource& original, FrameSource& distorted, std::span<const Wanted> wanted,
                                      const MeasureOptions& options)
{
    MESHREEL_CHECK(all_possible(original.still(), distorted.still(), wanted));
    std::vector<std::unique_ptr<Measurement>> measurements;
    for (const Wanted& one : wanted)
        measurements.push_back(one.metric->start(
            {*one.metric, original.still(), distorted.still(), one.parameters, options.threads, one.vertex_errors}));
    Matrix<float> room, other_room;
    const std::size_t F = std::max(original.frame_count(), distorted.frame_count());
    const std::size_t run =
        frames_a_run(std::max({original.still().vertex_count, distorted.still().vertex_count, std::uint32_t{1}}));
    for (std::size_t first = 0; first < F; first += run) {
        report(options.progress, "measuring", static_cast<double>(first) / static_cast<double>(F));
        MESHREEL_TRY(const MatrixView<const float> frames, next_frames(original, first, run, room));
        MESHREEL_TRY(const MatrixView<const float> others, next_frames(distorted, first, run, other_room));
        for (auto& measurement : measurements) measurement->add({frames, others});
    }
    std::vector<Measured> all;
    for (auto& measurement : measurements) {
        std::vector<double> values = measurement->finish(options.progress);
        all.push_back({std::move(values), measurement->per_frame()});
    }
    return all;
}

Result<Measured> measure(const Animation& original, const Animation& distorted, const Wanted& wanted,
                         const MeasureOptions& options)
{
    HeldFrames frames(original), others(distorted);
    MESHREEL_TRY(std::vector<Measured> all, measure(frames, others, std::span(&wanted, 1), options));
    return std::move(all.front());
}

Result<double> measured(std::string_view value, const Animation& original, const Animation& distorted)
{
    const FoundValue found = find_value(value);
    if (found.metric == nullptr) return Error{ErrorCode::usage, concat("no measure has a value ", value)};
    MESHREEL_TRY(const Measured all, measure(original, distorted, Wanted{found.metric}));
    return all.values[found.index];
}

} // namespace meshreel::metrics
