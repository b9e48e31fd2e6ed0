/// Feeds any bytes to the player; what it opens it must pose, at any time, in finite numbers.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "fuzz/reel_mutator.h"
#include "meshreel/player/player.h"

using namespace meshreel;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    player::OpenOptions options;
    options.limits.max_memory = 64u << 20;
    options.threads = {1};
    auto opened = player::Player::open({data, size}, options);
    if (!opened.ok()) return 0;
    std::vector<float> frame(3ul * opened->vertex_count());
    const double start = opened->times_s().front(), end = opened->times_s().back();
    for (const double t : {start - 1, start, 0.7 * start + 0.3 * end, end, end + 0.013, 1e300}) {
        opened->seek(t);
        opened->pose(frame);
        if (!std::all_of(frame.begin(), frame.end(), [](float x) { return std::isfinite(x); })) __builtin_trap();
    }
    opened->pose_frames(opened->frame_count() - 1, frame);
    return 0;
}
