/// The one table of codecs.
// SPDX-License-Identifier: MIT
#include <array>

#include "meshreel/codecs/average.h"
#include "meshreel/codecs/coddyac.h"
#include "meshreel/codecs/codec.h"
#include "meshreel/codecs/lsp.h"
#include "meshreel/codecs/rbfp.h"
#include "meshreel/codecs/reel.h"

namespace meshreel::codecs {

std::span<const Codec> all()
{
    static const std::array rows{reel(), coddyac(), average(), lsp(), rbfp()};
    return rows;
}

const Codec* find(std::string_view name)
{
    for (const Codec& codec : all())
        if (codec.name == name) return &codec;
    return nullptr;
}

Status decode(const Codec& codec, const Coded& coded, MatrixView<float> frames)
{
    MESHREEL_TRY(const Trajectories trajectories, codec.open(coded));
    rebuild(trajectories, frames, coded.threads);
    return Ok{};
}

Result<Opened> open(const Codec& codec, const Coded& coded)
{
    MESHREEL_TRY(Trajectories trajectories, codec.open(coded));
    return Opened{std::move(trajectories)};
}

void pose(const Opened& opened, const Mixes& mixes, MatrixView<double> frames, Threads threads)
{
    pose(opened.trajectories, mixes, frames, threads);
}

} // namespace meshreel::codecs
