/// Cubic Hermite weights on uneven times, in + - * / on doubles: the same on every machine.
// SPDX-License-Identifier: MIT
#include "meshreel/mesh/frame_mix.h"

#include <algorithm>
#include <cmath>

#include "meshreel/base/text.h"

namespace meshreel {

namespace {

constexpr double same_time = 1e-6; // of the distance of two frames: a time so close to a frame is that frame's

/// The stored frames as a row that, in a loop, goes on at both ends.
class Frames {
public:
    explicit Frames(const Timeline& timeline)
        : timeline_(timeline), F_(static_cast<std::int64_t>(timeline.times_s.size()))
    {
    }

    bool has(std::int64_t f) const { return timeline_.period_s > 0 || (f >= 0 && f < F_); }
    std::uint32_t number(std::int64_t f) const { return static_cast<std::uint32_t>((f % F_ + F_) % F_); }
    double time(std::int64_t f) const
    {
        const std::int64_t turn = (f - number(f)) / F_;
        return timeline_.times_s[number(f)] + static_cast<double>(turn) * timeline_.period_s;
    }

private:
    const Timeline& timeline_;
    std::int64_t F_;
};

/// Weights of frames f - 1 .. f + 2.
using Weights = std::array<double, 4>;

/// Adds `scale` times the speed at the near end of an interval, times its length. Positions: the frame before the near
/// end, the near end, the far end, the one after it; r and s: the distance of the frame before, and of the frame after,
/// in units of the interval, 0 where there is none.
void add_speed(Weights& weights, const std::array<std::size_t, 4>& place, double scale, std::array<double, 2> distance)
{
    const auto [r, s] = distance;
    if (r > 0) { // the parabola through before, near and far
        weights[place[0]] -= scale / (r * (1 + r));
        weights[place[1]] += scale * (1 - r) / r;
        weights[place[2]] += scale * r / (1 + r);
    } else if (s > 0) { // an end of the animation: through near, far and after
        weights[place[1]] -= scale * (2 + s) / (1 + s);
        weights[place[2]] += scale * (1 + s) / s;
        weights[place[3]] -= scale / (s * (1 + s));
    } else { // two frames in all
        weights[place[1]] -= scale;
        weights[place[2]] += scale;
    }
}

/// The cubic at u in (0, 1) between frames f and f + 1.
Weights cubic(double u, double before, double after)
{
    const double v = 1 - u;
    Weights weights{0, (1 + 2 * u) * v * v, u * u * (3 - 2 * u), 0};
    add_speed(weights, {0, 1, 2, 3}, u * v * v, {before, after});
    add_speed(weights, {3, 2, 1, 0}, u * u * v, {after, before}); // seen from the other end time runs backwards
    return weights;
}

/// Distances may differ so much that a cubic would fly off; a straight line cannot.
bool tame(const Weights& weights)
{
    constexpr double most = 16;
    return std::all_of(weights.begin(), weights.end(), [](double w) { return w >= -most && w <= most; });
}

FrameMix between(const Frames& frames, std::int64_t f, double u)
{
    const double h = frames.time(f + 1) - frames.time(f);
    const double before = frames.has(f - 1) ? (frames.time(f) - frames.time(f - 1)) / h : 0;
    const double after = frames.has(f + 2) ? (frames.time(f + 2) - frames.time(f + 1)) / h : 0;
    Weights weights = cubic(u, before, after);
    if (!tame(weights)) weights = {0, 1 - u, u, 0};
    FrameMix mix;
    for (int i = 0; i < 4; ++i) {
        if (weights[i] == 0) continue;
        const std::uint32_t frame = frames.number(f - 1 + i);
        std::uint32_t p = 0;
        while (p < mix.count && mix.parts[p].frame != frame) ++p; // a short loop meets a frame twice
        mix.parts[p].frame = frame;
        mix.parts[p].weight += weights[i];
        mix.count = std::max(mix.count, p + 1);
    }
    return mix;
}

} // namespace

FrameMix only(std::uint32_t frame)
{
    FrameMix mix;
    mix.parts[0] = {frame, 1.0};
    mix.count = 1;
    return mix;
}

void mix(MatrixView<const float> stored, const Mixes& mixes, MatrixView<double> frames)
{
    for (std::size_t i = 0; i < mixes.wanted.size(); ++i) {
        const std::span<double> sum = frames.row(i);
        std::ranges::fill(sum, -0.0); // unlike 0, it changes nothing that is added to it
        for (const FrameMix::Part& part : mixes.wanted[i].used()) {
            if (part.frame < mixes.first || part.frame - mixes.first >= stored.rows) continue;
            const std::span<const float> from = stored.row(part.frame - mixes.first);
            for (std::size_t j = 0; j < sum.size(); ++j) sum[j] += part.weight * static_cast<double>(from[j]);
        }
    }
}

Timeline timeline_of(std::span<const double> times_s, const Metadata& meta)
{
    Timeline timeline{times_s};
    if (!meta.loop || times_s.size() < 2) return timeline;
    const double length = times_s.back() - times_s.front();
    timeline.period_s = length + (meta.fps > 0 ? 1 / meta.fps : length / static_cast<double>(times_s.size() - 1));
    if (!std::isfinite(timeline.period_s)) timeline.period_s = 0;
    return timeline;
}

FrameMix mix_at(const Timeline& timeline, double t)
{
    const std::span<const double> times = timeline.times_s;
    const auto after = std::upper_bound(times.begin(), times.end(), t);
    const auto f = static_cast<std::int64_t>(after - times.begin()) - 1;
    const Frames frames(timeline);
    if (f < 0) return only(0);
    if (!frames.has(f + 1)) return only(frames.number(f));
    const double h = frames.time(f + 1) - frames.time(f), u = (t - frames.time(f)) / h;
    if (!(u > same_time)) return only(frames.number(f));
    if (!(u < 1 - same_time)) return only(frames.number(f + 1));
    return between(frames, f, u);
}

Result<std::vector<double>> times_between(const Timeline& timeline, std::array<std::uint64_t, 2> first_last, double fps,
                                          std::uint64_t most)
{
    const auto [first, last] = first_last;
    const std::span<const double> times = timeline.times_s;
    const double start = times[first],
                 spacing =
                     times.size() < 2 ? 0 : (times.back() - times.front()) / static_cast<double>(times.size() - 1);
    const bool round = timeline.period_s > 0 && first == 0 && last + 1 == times.size();
    const double slack = same_time * spacing, end = round ? start + timeline.period_s - 2 * slack : times[last] + slack;
    const double count = std::floor((end - start) * fps) + 1;
    if (!(count <= static_cast<double>(most)))
        return Error{ErrorCode::usage, concat(fps, " frames a second make more than ", most, " frames"), "fps", {}, {}};
    std::vector<double> samples(static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < samples.size(); ++i) samples[i] = start + static_cast<double>(i) / fps;
    return samples;
}

} // namespace meshreel
