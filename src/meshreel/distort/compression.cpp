/// Weld, trace, encode, and take what the decoder would see.
// SPDX-License-Identifier: MIT
#include "meshreel/distort/compression.h"

#include <algorithm>

#include "meshreel/codecs/codec.h"
#include "meshreel/coding/quantiser.h"
#include "meshreel/connectivity/topology.h"
#include "meshreel/mesh/reorder.h"
#include "meshreel/mesh/weld.h"

namespace meshreel::distort {

namespace {

constexpr std::size_t enough_bases = 1000; // for a step that is coarse

/// What Coddyac decodes to, with as many of the bases asked for as there are.
Animation after_coddyac(const Animation& animation, std::size_t max_bases, codecs::Settings settings)
{
    const Weld welded = weld(animation, settings.threads);
    const connectivity::Encoded mesh =
        connectivity::encode({animation.vertex_count, animation.triangles, welded.unique_of}, Order::keep);
    const connectivity::Topology& topology = mesh.topology;
    Matrix<float> frames(animation.frame_count(), 3ul * topology.surface.vertex_count);
    for (std::size_t f = 0; f < frames.rows; ++f) reorder_frame(animation.frame(f), mesh.original_of, frames.row(f));
    const auto encoder =
        codecs::find("coddyac")->prepare({topology.surface, frames.view()}, max_bases, settings.threads);
    const std::span<const double> largest = encoder->singular_values(); // no coefficient is above the first
    if (!largest.empty()) settings.step = std::max(settings.step, 4 * largest[0] / coding::Quantiser::largest_level);
    codecs::rebuild(encoder->encode(settings).decoded, frames.view(), settings.threads);
    Animation result = animation;
    for (std::size_t f = 0; f < frames.rows; ++f) reorder_frame(frames.row(f), topology.surface_of, result.frame(f));
    return result;
}

} // namespace

Result<Animation> coarse_quantisation(const Animation& animation, const Request& request)
{
    codecs::Settings settings;
    settings.step = request.amount;
    settings.threads = request.threads;
    return after_coddyac(animation, enough_bases, settings);
}

Result<Animation> few_bases(const Animation& animation, const Request& request)
{
    constexpr double fine_step = 1e-4; // of the body diagonal
    if (request.amount < 1) return Error{ErrorCode::usage, "at least one eigentrajectory is needed", "amount"};
    const double length = body_diagonal(animation);
    codecs::Settings settings;
    settings.step = fine_step * (length > 0 ? length : 1.0);
    settings.bases = static_cast<std::uint32_t>(request.amount);
    settings.threads = request.threads;
    return after_coddyac(animation, *settings.bases, settings);
}

} // namespace meshreel::distort
