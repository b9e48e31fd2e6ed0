/// The one table of codecs.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>

#include "meshreel/codecs/average.h"
#include "meshreel/codecs/coddyac.h"
#include "meshreel/codecs/codec.h"
#include "meshreel/codecs/lossless.h"
#include "meshreel/codecs/lsp.h"
#include "meshreel/codecs/rbfp.h"
#include "meshreel/codecs/reel.h"

namespace meshreel::codecs {

std::span<const Codec> all()
{
#ifdef MESHREEL_REEL_ALONE
    static const std::array rows{reel()};
#else
    static const std::array rows{reel(), coddyac(), average(), lsp(), rbfp(), lossless()}; // exact ones last
#endif
    return rows;
}

std::span<const Codec> of_trajectories()
{
    const std::span<const Codec> rows = all();
    return rows.first(static_cast<std::size_t>(
        std::ranges::find_if(rows, [](const Codec& codec) { return codec.exact(); }) - rows.begin()));
}

const Codec* find(std::string_view name)
{
    for (const Codec& codec : all())
        if (codec.name == name) return &codec;
    return nullptr;
}

namespace {

/// The rows of the vertices wanted.
Result<Trajectories> open_wanted(const Codec& codec, const Coded& coded)
{
    MESHREEL_TRY(Trajectories trajectories, codec.open(coded));
    if (!coded.wanted) return trajectories;
    const Matrix<double> all = std::move(trajectories.C);
    trajectories.C = Matrix<double>(coded.wanted->size(), all.cols);
    for (std::size_t i = 0; i < coded.wanted->size(); ++i)
        std::ranges::copy(all.row((*coded.wanted)[i]), trajectories.C.row(i).begin());
    return trajectories;
}

} // namespace

Status decode(const Codec& codec, const Coded& coded, MatrixView<float> frames)
{
    if (codec.exact()) return codec.frames(coded, frames);
    MESHREEL_TRY(const Trajectories trajectories, open_wanted(codec, coded));
    rebuild(trajectories, frames, coded.threads);
    return Ok{};
}

Result<Opened> open(const Codec& codec, const Coded& coded)
{
    if (!codec.exact()) {
        MESHREEL_TRY(Trajectories trajectories, open_wanted(codec, coded));
        return Opened{std::move(trajectories)};
    }
    Matrix<float> frames(coded.frame_count, 3ul * coded.surface.vertex_count);
    MESHREEL_CHECK(codec.frames(coded, frames.view()));
    return Opened{std::move(frames)};
}

void pose(const Opened& opened, const Mixes& mixes, MatrixView<double> frames, Threads threads)
{
    if (const auto* trajectories = std::get_if<Trajectories>(&opened))
        pose(*trajectories, mixes, frames, threads);
    else
        mix(std::get<Matrix<float>>(opened).view(), mixes, frames);
}

} // namespace meshreel::codecs
