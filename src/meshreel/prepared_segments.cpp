/// Segments read, prepared, kept and dropped.
// SPDX-License-Identifier: MIT
#include "meshreel/prepared_segments.h"

#include <algorithm>

#include "meshreel/mesh/reorder.h"

namespace meshreel {

namespace {

constexpr std::size_t no_segment = ~std::size_t{0};
constexpr std::size_t most_kept_bytes = 64 << 20; ///< of preparations

} // namespace

PreparedSegments::PreparedSegments(const SegmentInput& input) : input_(input), loose_(no_segment), held_(no_segment) {}

void PreparedSegments::cut(std::vector<FrameSpan> spans)
{
    spans_ = std::move(spans);
    spectra_.resize(count());
    encoders_.resize(count());
}

std::size_t PreparedSegments::longest() const
{
    return std::ranges::max(spans_, {}, &FrameSpan::count).count;
}

Status PreparedSegments::prepare(std::size_t max_bases)
{
    max_bases_ = max_bases;
    kept_bytes_ = 0;
    loose_ = no_segment;
    for (auto& encoder : encoders_) encoder.reset();
    for (std::size_t s = 0; s < count(); ++s) {
        MESHREEL_TRY(const Visit visited, visit(s));
        const std::span<const double> values = visited.encoder.singular_values();
        spectra_[s] = {spans_[s].count, visited.encoder.energy(), {values.begin(), values.end()}};
    }
    return Ok{};
}

Result<PreparedSegments::Visit> PreparedSegments::visit(std::size_t s)
{
    MESHREEL_CHECK(load(s));
    if (!encoders_[s]) {
        if (loose_ != no_segment) encoders_[loose_].reset();
        encoders_[s] = input_.codec.prepare({input_.topology.topology.surface, held(s)}, max_bases_, input_.threads);
        keep_or_drop(s);
    }
    return Visit{*encoders_[s], held(s)};
}

MatrixView<const float> PreparedSegments::held(std::size_t s) const
{
    return {frames_.data(), spans_[s].count, 3ul * input_.topology.topology.surface.vertex_count};
}

Status PreparedSegments::load(std::size_t s)
{
    if (held_ == s) return Ok{};
    held_ = no_segment;
    const auto [begin, size] = spans_[s];
    const std::size_t width = 3ul * input_.topology.topology.surface.vertex_count;
    frames_.resize(longest() * width);
    Matrix<float> room;
    const std::size_t run = frames_a_run(input_.source.still().vertex_count);
    for (std::size_t first = 0; first < size; first += run) {
        MESHREEL_TRY(const auto frames, input_.source.frames(begin + first, std::min(run, size - first), room));
        parallel_for(frames.rows, input_.threads, [&](std::size_t f) {
            reorder_frame(frames.row(f), input_.topology.original_of, {frames_.data() + (first + f) * width, width});
        });
    }
    held_ = s;
    return Ok{};
}

/// What a preparation takes: its basis, and what some codecs remember of each vertex.
void PreparedSegments::keep_or_drop(std::size_t s)
{
    constexpr std::size_t bytes_a_vertex = 200;
    const std::size_t bytes = 8 * encoders_[s]->singular_values().size() * 3 * spans_[s].count +
                              bytes_a_vertex * input_.topology.topology.surface.vertex_count;
    loose_ = no_segment;
    if (kept_bytes_ + bytes > most_kept_bytes)
        loose_ = s;
    else
        kept_bytes_ += bytes;
}

} // namespace meshreel
