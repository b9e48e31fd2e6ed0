/// What the tests of the player share: small files, and how far it is from the exact decode.
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "meshreel/mesh/shapes.h"
#include "meshreel/meshreel.h"
#include "meshreel/player/player.h"

namespace meshreel {

inline Bytes reel_of(const Animation& animation, EncodeOptions options = {})
{
    options.threads = {1};
    return encode(animation, options)->bytes;
}

/// Segments of so many frames.
inline EncodeOptions cut_into(std::uint32_t frames)
{
    EncodeOptions options;
    options.segment = frames;
    return options;
}

/// Coddyac by hand: bases, and a step so fine that none of them is lost.
inline EncodeOptions with_bases(std::uint32_t bases)
{
    EncodeOptions options;
    options.codec = "coddyac";
    options.quality.bases = bases;
    options.quality.step = 1e-5;
    return options;
}

inline Animation shape(const std::string& name, const shapes::ShapeOptions& options)
{
    return *shapes::generate(*shapes::find(name), options);
}

/// The largest difference of a coordinate, in body diagonals. posed: frames of the animation, one after the other.
inline double farthest(const Animation& exact, std::span<const float> posed)
{
    if (posed.size() != exact.positions.size()) return HUGE_VAL;
    double most = 0;
    for (std::size_t i = 0; i < posed.size(); ++i) {
        const double difference = std::abs(static_cast<double>(posed[i]) - exact.positions[i]);
        most = difference <= most ? most : difference;
    }
    return most == 0 ? 0 : most / body_diagonal(exact);
}

inline std::vector<float> played(const player::Player& player)
{
    std::vector<float> all(player.frame_count() * player.vertex_count() * 3ul);
    player.pose_frames(0, all);
    return all;
}

/// The player at each time of an animation.
inline std::vector<float> played_at(player::Player& player, const std::vector<double>& times_s)
{
    const std::size_t numbers = 3ul * player.vertex_count();
    std::vector<float> all(times_s.size() * numbers);
    for (std::size_t i = 0; i < times_s.size(); ++i) {
        player.seek(times_s[i]);
        player.pose(std::span(all).subspan(i * numbers, numbers));
    }
    return all;
}

} // namespace meshreel
