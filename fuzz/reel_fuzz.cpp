/// Feeds any bytes to the front door's decoder: whole, in parts, by frames, coarse, at another rate; and to its inspectors.
// SPDX-License-Identifier: MIT
#include <algorithm>

#include "fuzz/reel_mutator.h"
#include "meshreel/meshreel.h"

using namespace meshreel;

namespace {

/// Frames that stay in their file are those of the whole decode.
void ask_for_frames(ByteSource& source, const DecodeOptions& options, const Result<Animation>& whole)
{
    const auto opened = open_frames(source, options);
    if (!opened.ok()) {
        if (whole.ok()) __builtin_trap();
        return;
    }
    if ((*opened)->frame_count() * (*opened)->still().vertex_count > 1u << 20) return; // slow, and nothing new
    Matrix<float> room;
    const auto frames = (*opened)->frames(0, (*opened)->frame_count(), room);
    if (whole.ok() && !(frames.ok() && std::ranges::equal(frames->values(), whole->positions))) __builtin_trap();
}

/// A sentence goes with every refusal.
template <class T>
void look(const Result<T>& seen, bool readable)
{
    if (!seen.ok() && (readable || seen.error().message.empty())) __builtin_trap();
}

} // namespace

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
    options.frames = {};
    options.fps.reset();
    ask_for_frames(source, options, animation);
    look(info(bytes, options.limits), animation.ok());
    look(explain(bytes, options.limits), false);
    look(levels(bytes, options), false);
    return 0;
}
