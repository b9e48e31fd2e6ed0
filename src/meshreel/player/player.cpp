/// Segments into blocks of float32 coefficients, and out of them frames.
// SPDX-License-Identifier: MIT
#include "meshreel/player/player.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "meshreel/base/memory.h"
#include "meshreel/codecs/opening.h"
#include "meshreel/container/squeeze.h"

namespace meshreel::player {

namespace {

/// Parts a mean into a float32 and what float32 could not say of it.
void set_mean(FrameTerms& frame, const double* mean)
{
    for (std::size_t c = 0; c < 3; ++c) {
        frame.mean[c] = static_cast<float>(mean[c]);
        frame.mean_rest[c] = static_cast<float>(mean[c] - static_cast<double>(frame.mean[c]));
    }
}

} // namespace

Result<Player> Player::opened(ByteView reel, const OpenOptions& options)
{
    MESHREEL_TRY(const container::StreamReader file, container::StreamReader::open(reel, options.limits));
    MESHREEL_TRY(const container::Header header, container::read_header(file));
    MESHREEL_TRY(container::SegmentList segments, container::SegmentList::open(file, header));
    Player player;
    player.kernel_ = options.kernel == nullptr ? kernels().back() : *options.kernel;
    container::Budget budget(options.limits.max_memory);
    MESHREEL_TRY(player.times_s_, container::read_times(file, header, budget));
    MESHREEL_TRY(player.metadata_, container::read_metadata(file));
    player.period_s_ = timeline_of(player.times_s_, player.metadata_).period_s;
    MESHREEL_TRY(const codecs::Codec* codec, codecs::codec_of(header));
    if (codec->exact()) return unsupported("is exact: its frames can be decoded, not posed", "HEAD.codec");
    MESHREEL_TRY(connectivity::Topology topology, codecs::read_topology(file, header, options.base));
    player.vertex_count_ = topology.vertex_count;
    player.triangles_ = std::move(topology.triangles);
    player.order_vertices(topology.surface_of, topology.surface.vertex_count);
    MESHREEL_CHECK(player.open_segments(segments, *codec, topology.surface, options));
    player.seek_frame(0);
    return player;
}

Result<Player> Player::open(ByteView reel, const OpenOptions& options)
{
    return within_memory([&] { return opened(reel, options); });
}

void Player::order_vertices(std::span<const std::uint32_t> surface_of, std::uint32_t surface_vertices)
{
    constexpr std::uint32_t unseen = 0xffffffff;
    std::vector<std::uint32_t> place(surface_vertices, unseen);
    unique_of_.reserve(surface_of.size());
    for (const std::uint32_t w : surface_of) {
        if (place[w] == unseen) {
            place[w] = static_cast<std::uint32_t>(unique_.size());
            unique_.push_back(w);
        }
        unique_of_.push_back(place[w]);
    }
    if (4 * surface_of.size() > 5 * unique_.size()) return;
    unique_.assign(surface_of.begin(), surface_of.end()); // posing a few vertices twice is faster than copying them
    unique_of_.clear();
}

Status Player::open_segments(container::SegmentSource& segments, const codecs::Codec& codec,
                             const connectivity::Surface& surface, const OpenOptions& options)
{
    container::Budget budget(options.limits.max_memory);
    MESHREEL_CHECK(budget.take(24ull * frame_count(), "SEGM"));
    means_ = Matrix<double>(frame_count(), 3);
    for (std::size_t f = 0; f < frame_count(); f += pieces_.back().count) {
        MESHREEL_TRY(const container::Segment segment, segments.holding(static_cast<std::uint32_t>(f)));
        MESHREEL_TRY(const codecs::Opened opened, codecs::open(codec, {segment.source(), surface, segment.frame_count,
                                                                       options.limits, options.threads}));
        const codecs::Trajectories& trajectories = std::get<codecs::Trajectories>(opened);
        const std::uint64_t K = trajectories.C.cols;
        MESHREEL_CHECK(budget.take(4 * K * (blocks() * kernel_.block + 3ull * segment.frame_count + 12), "SEGM"));
        if (!codecs::float_holds(trajectories))
            return bad_input("has positions that float32 cannot hold", "SEGM", at_byte(segment.payload_offset));
        add(trajectories, segment.first_frame, options.threads);
    }
    return Ok{};
}

/// Components go in from the last: the smallest first, see Term.
void Player::add(const codecs::Trajectories& trajectories, std::size_t first, Threads threads)
{
    const auto& [mean, rows] = trajectories.basis;
    const std::size_t F = mean.size() / 3, K = rows.rows;
    pieces_.push_back({first, F, K, std::vector<Line>(1 + blocks() * kernel_.block / 16 * K), Matrix<float>(F, 3 * K)});
    Piece& piece = pieces_.back();
    for (std::size_t f = 0; f < F; ++f)
        for (std::size_t c = 0; c < 3; ++c) {
            means_(first + f, c) = mean[c * F + f];
            for (std::size_t k = 0; k < K; ++k)
                piece.basis(f, 3 * k + c) = static_cast<float>(rows(K - 1 - k, c * F + f));
        }
    float* const coefficients = piece.lines.data()->values; // of all lines, which lie side by side
    parallel_for(blocks(), threads, [&](std::size_t b) {
        float* out = coefficients + b * kernel_.block * K;
        const std::size_t begin = b * kernel_.block, count = std::min(kernel_.block, unique_.size() - begin);
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t k = 0; k < K; ++k)
                out[k * kernel_.block + i] = static_cast<float>(trajectories.C(unique_[begin + i], K - 1 - k));
    });
    mixed_.resize(std::max(mixed_.size(), 4 * 3 * K));
}

void Player::seek(double time_s)
{
    double turns = period_s_ > 0 ? std::floor((time_s - times_s_.front()) / period_s_) : 0.0;
    if (!(turns > 0 && std::isfinite(turns))) turns = 0.0;
    const FrameMix mix = mix_at({times_s_, period_s_}, time_s - turns * period_s_);
    if (mix.count == 1) return seek_frame(mix.parts[0].frame);
    sought_.count = 0;
    std::array<double, 3> mean{};
    const Piece* last = nullptr;
    for (const FrameMix::Part& part : mix.used()) {
        const Piece& piece = pieces_[piece_of(part.frame)];
        if (&piece != last) add_term(piece);
        last = &piece;
        const float* basis = piece.basis.row(part.frame - piece.first).data();
        float* mixed = mixed_.data() + (sought_.count - 1) * mixed_.size() / 4;
        const float weight = static_cast<float>(part.weight);
        for (std::size_t i = 0; i < 3 * piece.K; ++i) mixed[i] += weight * basis[i];
        for (std::size_t c = 0; c < 3; ++c) mean[c] += part.weight * means_(part.frame, c);
    }
    set_mean(sought_, mean.data());
}

/// One more term of the frame sought, its basis still zero.
void Player::add_term(const Piece& piece)
{
    float* mixed = mixed_.data() + sought_.count * mixed_.size() / 4;
    std::fill_n(mixed, 3 * piece.K, 0.0f);
    sought_.terms[sought_.count++] = {piece.coefficients(), mixed, piece.K};
}

void Player::seek_frame(std::size_t f)
{
    assert(f < frame_count());
    sought_ = stored(f);
}

std::size_t Player::piece_of(std::size_t f) const
{
    const auto next = std::upper_bound(pieces_.begin(), pieces_.end(), f,
                                       [](std::size_t frame, const Piece& piece) { return frame < piece.first; });
    return static_cast<std::size_t>(next - pieces_.begin()) - 1;
}

FrameTerms Player::stored(std::size_t f) const
{
    const Piece& piece = pieces_[piece_of(f)];
    FrameTerms frame;
    frame.terms[frame.count++] = {piece.coefficients(), piece.basis.row(f - piece.first).data(), piece.K};
    set_mean(frame, means_.row(f).data());
    return frame;
}

/// Block b into out [V x 3]; of the last block no more than there is.
void Player::pose_block(const FrameTerms& frame, std::size_t b, float* out) const
{
    const std::size_t begin = b * kernel_.block, count = std::min(kernel_.block, unique_.size() - begin);
    if (count == kernel_.block) return kernel_.pose(frame, b, out + 3 * begin);
    float whole[3 * largest_block];
    kernel_.pose(frame, b, whole);
    std::copy_n(whole, 3 * count, out + 3 * begin);
}

/// Gives welded vertices their positions, in place: from the end on, no position is overwritten before it is needed.
void Player::spread(float* out) const
{
    for (std::size_t v = unique_of_.size(); v-- > 0;) std::copy_n(out + 3ul * unique_of_[v], 3, out + 3 * v);
}

void Player::pose(std::span<float> out) const
{
    assert(out.size() == 3ul * vertex_count_);
    for (std::size_t b = 0; b < blocks(); ++b) pose_block(sought_, b, out.data());
    spread(out.data());
}

void Player::pose_frames(std::size_t first, std::span<float> out) const
{
    const std::size_t numbers = 3ul * vertex_count_, count = out.size() / numbers;
    assert(out.size() == count * numbers && first + count <= frame_count());
    constexpr std::size_t at_once = 16; // as many as the processor keeps pages of at hand
    for (std::size_t i = 0; i < count;) {
        const std::size_t end = std::min(count, i + at_once);
        for (std::size_t b = 0; b < blocks(); ++b) // the coefficients of a block stay in the nearest cache
            for (std::size_t j = i; j < end; ++j) pose_block(stored(first + j), b, out.data() + j * numbers);
        for (; i < end; ++i) spread(out.data() + i * numbers);
    }
}

} // namespace meshreel::player
