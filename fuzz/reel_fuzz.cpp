/// Feeds any bytes to the front door's decoder, whole, in parts, coarse and at another rate, and to its inspectors.
// SPDX-License-Identifier: MIT
#include "fuzz/reel_mutator.h"
#include "meshreel/meshreel.h"

using namespace meshreel;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    DecodeOptions options;
    options.limits.max_memory = 64u << 20;
    options.threads = {1};
    const ByteView bytes{data, size};
    const auto animation = decode(bytes, options);
    if (animation.ok() && !validate(*animation).ok()) __builtin_trap();
    MemorySource source(bytes);
    const auto parts = decode(source, options);
    if (animation.ok() && !(parts.ok() && parts->positions == animation->positions)) __builtin_trap();
    options.level = 1;
    const auto coarse = decode(bytes, options), coarse_parts = decode(source, options);
    for (const auto* level : {&coarse, &coarse_parts})
        if (level->ok() && !validate(**level).ok()) __builtin_trap();
    if (coarse.ok() && !(coarse_parts.ok() && coarse_parts->positions == coarse->positions)) __builtin_trap();
    options.level = 0;
    options.frames.first = 1;
    options.fps = 37.0;
    const auto other_rate = decode(source, options);
    if (other_rate.ok() && !validate(*other_rate).ok()) __builtin_trap();
    if (info(bytes, options.limits).ok() && bytes.empty()) __builtin_trap();
    return 0;
}
