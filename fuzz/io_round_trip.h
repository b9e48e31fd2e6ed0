/// What the fuzz targets of the readers share: read, and where that works write and read again to the same bits.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdlib>
#include <cstring>

#include "meshreel/io/io.h"

namespace meshreel::io::fuzz {

inline LoadOptions small_options()
{
    LoadOptions options;
    options.limits.max_memory = 64u << 20;
    options.limits.max_frames = 10'000;
    options.warn = [](const std::string& sentence) {
        if (sentence.empty()) std::abort();
    };
    return options;
}

/// Stops the run where a broken promise is found.
inline void demand(bool kept)
{
    if (!kept) std::abort();
}

/// A reader's animation is valid but for numbers that are not finite; an error has a sentence.
inline bool is_sound(const Result<Animation>& read)
{
    if (!read.ok()) {
        demand(!read.error().message.empty());
        return false;
    }
    const Status valid = validate(*read);
    demand(valid.ok() || valid.error().field == "positions" || valid.error().field == "times");
    return valid.ok();
}

inline void demand_same(const Animation& a, const Result<Animation>& b)
{
    demand(b.ok() && a.triangles == b->triangles && a.positions.size() == b->positions.size());
    demand(std::memcmp(a.positions.data(), b->positions.data(), a.positions.size() * sizeof(float)) == 0);
    demand(a.appearance.attributes.size() == b->appearance.attributes.size());
}

} // namespace meshreel::io::fuzz
