/// Frames out of segments: as they are stored, some of them, or mixed at other times.
// SPDX-License-Identifier: MIT
#include "meshreel/shown_frames.h"

#include <algorithm>
#include <cmath>

#include "meshreel/io/frames.h"

namespace meshreel {

namespace {

using container::Segment;

/// One part of one frame shown, by the stored frame that it needs.
struct Need {
    std::uint32_t frame, shown;
    bool operator<(const Need& other) const { return frame != other.frame ? frame < other.frame : shown < other.shown; }
};

std::vector<Need> needs_of(const std::vector<FrameMix>& mixes)
{
    std::vector<Need> needs;
    for (std::uint32_t i = 0; i < mixes.size(); ++i)
        for (const FrameMix::Part& part : mixes[i].used()) needs.push_back({part.frame, i});
    std::sort(needs.begin(), needs.end());
    return needs;
}

bool within_segment(const FrameMix& mix, const Segment& segment)
{
    return std::all_of(mix.used().begin(), mix.used().end(), [&](const FrameMix::Part& part) {
        return part.frame >= segment.first_frame && part.frame - segment.first_frame < segment.frame_count;
    });
}

/// Poses frames segment by segment.
class Poser {
public:
    Poser(const CodedFrames& coded, const ShownFrames& shown)
        : coded_(coded), shown_(shown),
          frames_(shown.mixes.size(), 3ul * (coded.wanted ? coded.wanted->size() : coded.surface.vertex_count)),
          sums_(shown.mixes.size())
    {
    }

    Result<Matrix<float>> all()
    {
        const std::vector<Need> needs = needs_of(shown_.mixes);
        for (std::size_t n = 0; n < needs.size();) {
            report(coded_.options.progress, "decode", static_cast<double>(n) / static_cast<double>(needs.size()));
            MESHREEL_TRY(const Segment segment, coded_.segments.holding(needs[n].frame));
            std::vector<std::uint32_t> shown;
            for (; n < needs.size() && needs[n].frame - segment.first_frame < segment.frame_count; ++n)
                shown.push_back(needs[n].shown);
            MESHREEL_CHECK(shown_.as_stored ? copy(segment) : mix(segment, std::move(shown)));
        }
        for (std::size_t i = 0; i < sums_.size(); ++i)
            if (!sums_[i].empty()) std::transform(sums_[i].begin(), sums_[i].end(), frames_.row(i).begin(), rounded);
        return std::move(frames_);
    }

private:
    static float rounded(double x) { return static_cast<float>(x); }

    codecs::Coded payload_of(const Segment& segment) const
    {
        codecs::Coded payload{segment.source(), coded_.surface, segment.frame_count, coded_.options.limits,
                              coded_.options.threads};
        if (coded_.wanted != nullptr) payload.wanted = *coded_.wanted;
        return payload;
    }

    Status copy(const Segment& segment)
    {
        const MatrixView<float> part{frames_.row(segment.first_frame).data(), segment.frame_count, frames_.cols};
        return codecs::decode(coded_.codec, payload_of(segment), part);
    }

    /// A few frames at a time: what is not rounded yet takes twice the room.
    Status mix(const Segment& segment, std::vector<std::uint32_t> shown)
    {
        constexpr std::size_t batch = 64;
        std::sort(shown.begin(), shown.end());
        shown.erase(std::unique(shown.begin(), shown.end()), shown.end());
        MESHREEL_CHECK(within(coded_.options.limits, coded_.surface.vertex_count, 0, segment.frame_count));
        MESHREEL_TRY(const codecs::Opened opened, codecs::open(coded_.codec, payload_of(segment)));
        for (std::size_t first = 0; first < shown.size(); first += batch) {
            const std::size_t count = std::min(batch, shown.size() - first);
            std::vector<FrameMix> mixes;
            for (std::size_t i = first; i < first + count; ++i) mixes.push_back(shown_.mixes[shown[i]]);
            Matrix<double> posed(count, frames_.cols);
            codecs::pose(opened, {mixes, segment.first_frame}, posed.view(), coded_.options.threads);
            for (std::size_t i = 0; i < count; ++i)
                take(shown[first + i], posed.row(i), within_segment(mixes[i], segment));
        }
        return Ok{};
    }

    /// What a segment gives to a frame: all of it, or a summand.
    void take(std::uint32_t shown, std::span<const double> part, bool all)
    {
        std::vector<double>& sum = sums_[shown];
        if (all)
            std::transform(part.begin(), part.end(), frames_.row(shown).begin(), rounded);
        else if (sum.empty())
            sum.assign(part.begin(), part.end());
        else
            std::transform(part.begin(), part.end(), sum.begin(), sum.begin(), std::plus<>());
    }

    const CodedFrames& coded_;
    const ShownFrames& shown_;
    Matrix<float> frames_;                  ///< [N x 3W]
    std::vector<std::vector<double>> sums_; ///< [N] of frames that several segments share, empty for others
};

} // namespace

Result<ShownFrames> shown_frames(const std::vector<double>& times_s, const Metadata& meta, const DecodeOptions& options,
                                 std::uint64_t most)
{
    MESHREEL_TRY(const io::Selection chosen, io::select_frames(options.frames, times_s.size()));
    ShownFrames shown;
    shown.fps = meta.fps / static_cast<double>(chosen.step);
    if (!options.fps) {
        for (std::uint64_t i = 0; i < chosen.count; ++i) {
            shown.mixes.push_back(only(static_cast<std::uint32_t>(chosen[i])));
            shown.times_s.push_back(times_s[chosen[i]]);
        }
        shown.as_stored = chosen.count == times_s.size();
        return shown;
    }
    if (!(*options.fps > 0 && std::isfinite(*options.fps)))
        return Error{ErrorCode::usage, "must be a number above 0", "fps", {}, {}};
    if (chosen.step != 1)
        return Error{ErrorCode::usage, "frames at another rate cannot be taken in steps too", "frames", {}, {}};
    const Timeline timeline = timeline_of(times_s, meta);
    MESHREEL_TRY(shown.times_s, times_between(timeline, {chosen.first, chosen[chosen.count - 1]}, *options.fps, most));
    for (const double t : shown.times_s) shown.mixes.push_back(mix_at(timeline, t));
    shown.fps = *options.fps;
    return shown;
}

Result<Matrix<float>> pose_frames(const CodedFrames& coded, const ShownFrames& shown)
{
    return Poser(coded, shown).all();
}

} // namespace meshreel
