/// Fingerprints, and exact times.
// SPDX-License-Identifier: MIT
#include "meshreel/container/chunks.h"

#include <cmath>

#include "meshreel/base/text.h"
#include "meshreel/container/stream.h"

namespace meshreel::container {

namespace {

/// Doubles as integers in the same order, so that neighbours differ by one.
std::uint64_t rank_of(double value)
{
    std::uint64_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    return bits >> 63 ? ~bits : bits | 1ull << 63;
}

double of_rank(std::uint64_t rank)
{
    const std::uint64_t bits = rank >> 63 ? rank & ~(1ull << 63) : ~rank;
    double value;
    std::memcpy(&value, &bits, sizeof value);
    return value;
}

bool is_uniform(const std::vector<double>& times_s, double fps)
{
    if (!(fps > 0) || !std::isfinite(fps)) return false;
    const std::vector<double> expected = uniform_times(times_s.size(), fps, times_s.front());
    return std::memcmp(expected.data(), times_s.data(), times_s.size() * sizeof(double)) == 0;
}

/// The rate at which the times run, as a round number where that is exact.
double rate_of(const std::vector<double>& times_s, double nominal_fps)
{
    const double steps = static_cast<double>(times_s.size()) - 1, span = times_s.back() - times_s.front();
    const double mean = steps > 0 && span > 0 ? steps / span : 0.0;
    for (const double fps : {nominal_fps, std::floor(mean + 0.5), mean, std::floor(mean * 1001 + 0.5) / 1001})
        if (is_uniform(times_s, fps)) return fps;
    const double best = mean > 0 && std::isfinite(mean) ? mean : nominal_fps;
    return best > 0 && std::isfinite(best) ? best : 1.0;
}

} // namespace

std::uint64_t fingerprint_of(std::uint32_t vertex_count, const std::vector<Triangle>& triangles)
{
    Bytes bytes(4 + triangles.size() * 12);
    store<4>(vertex_count, bytes.data());
    for (std::size_t c = 0; c < triangles.size() * 3; ++c) store<4>(triangles[c / 3][c % 3], bytes.data() + 4 + 4 * c);
    return hash_of(bytes);
}

TimeChunk pack_times(const std::vector<double>& times_s, double nominal_fps)
{
    TimeChunk chunk;
    chunk.start_s = times_s.front();
    chunk.fps = rate_of(times_s, nominal_fps);
    if (is_uniform(times_s, chunk.fps)) return chunk;
    chunk.mode = TimeChunk::Mode::corrected;
    const std::vector<double> guess = uniform_times(times_s.size(), chunk.fps, chunk.start_s);
    Bytes planes(times_s.size() * 8);
    for (std::size_t f = 0; f < times_s.size(); ++f) {
        const std::uint64_t correction = zigzag(static_cast<std::int64_t>(rank_of(times_s[f]) - rank_of(guess[f])));
        for (std::size_t b = 0; b < 8; ++b)
            planes[b * times_s.size() + f] = static_cast<std::uint8_t>(correction >> (8 * b));
    }
    chunk.corrections = squeeze(std::move(planes));
    return chunk;
}

Result<std::vector<double>> unpack_times(const TimeChunk& chunk, std::uint32_t frame_count, Budget& budget)
{
    MESHREEL_CHECK(budget.take(frame_count * 8ull, "TIME"));
    std::vector<double> times = uniform_times(frame_count, chunk.fps, chunk.start_s);
    if (chunk.mode == TimeChunk::Mode::corrected) {
        MESHREEL_TRY(const Bytes planes, unsqueeze(chunk.corrections, frame_count * 8ull, budget));
        for (std::size_t f = 0; f < frame_count; ++f) {
            std::uint64_t correction = 0;
            for (std::size_t b = 0; b < 8; ++b)
                correction |= static_cast<std::uint64_t>(planes[b * frame_count + f]) << (8 * b);
            times[f] = of_rank(rank_of(times[f]) + static_cast<std::uint64_t>(unzigzag(correction)));
        }
    }
    for (std::size_t f = 0; f < frame_count; ++f) {
        if (!std::isfinite(times[f])) return bad_input(concat("the time of frame ", f, " is not finite"), "TIME");
        if (f > 0 && !(times[f] > times[f - 1]))
            return bad_input(concat("frame ", f, " is not later than the frame before it"), "TIME");
    }
    return times;
}

} // namespace meshreel::container
