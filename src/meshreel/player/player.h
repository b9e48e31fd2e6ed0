/// The fast way to a file's frames: opened once, posed at any time, with no allocation in between.
// SPDX-License-Identifier: MIT
//
//   MESHREEL_TRY(player::Player player, player::Player::open(reel));
//   std::vector<float> positions(3ul * player.vertex_count());
//   each time the screen is drawn:  player.seek(time_s);  player.pose(positions);
//
// decode() gives the same numbers on every machine and is what all measures measure. The player gives them up to a
// millionth of the body diagonal (where the coordinates themselves leave float32 that many digits) and as fast as a
// matrix product is.
#pragma once

#include <span>
#include <vector>

#include "meshreel/base/limits.h"
#include "meshreel/base/parallel.h"
#include "meshreel/base/views.h"
#include "meshreel/codecs/codec.h"
#include "meshreel/container/segments.h"
#include "meshreel/mesh/animation.h"
#include "meshreel/player/pose_kernel.h"

namespace meshreel::player {

struct OpenOptions {
    const Animation* base = nullptr; ///< the base mesh of a file made with Order::base
    DecodeLimits limits = {};
    Threads threads = {};           ///< of opening; posing uses the caller's
    const Kernel* kernel = nullptr; ///< one of kernels(); null: the fastest
};

/// An open file. Each thread that poses needs its own. Moves like an int; cannot be copied.
class Player {
public:
    /// Opens all segments. The bytes are not needed afterwards. Memory: 4 bytes a coefficient of every segment and a
    /// number of every basis; while a segment is opened, what its codec takes.
    /// @fails bad_input, unsupported (an exact codec too), usage, as decode().
    static Result<Player> open(ByteView reel, const OpenOptions& options = {});

    Player(Player&&) = default;
    Player& operator=(Player&&) = default;

    std::uint32_t vertex_count() const { return vertex_count_; }          ///< V
    std::size_t frame_count() const { return times_s_.size(); }           ///< F
    std::span<const double> times_s() const { return times_s_; }          ///< [F], strictly increasing
    const std::vector<Triangle>& triangles() const { return triangles_; } ///< [T] over V
    const Metadata& metadata() const { return metadata_; }

    /// Goes to a time: between two stored frames cubic and exactly through them (mesh/frame_mix.h), as `decode --fps`.
    /// Before the first frame it stays there; after the last one too, unless the animation is a loop, which goes on.
    /// @cost O(K + log F).
    void seek(double time_s);
    /// Goes to a stored frame, below F. @cost O(log S), S segments.
    void seek_frame(std::size_t f);
    /// Positions there, into out [V x 3], model units. @cost O(V K), the matrix product.
    void pose(std::span<float> out) const;
    /// Positions of the stored frames first, first + 1, ... into out [n x V x 3]: faster than one after the other.
    void pose_frames(std::size_t first, std::span<float> out) const;

private:
    static Result<Player> opened(ByteView reel, const OpenOptions& options);
    struct alignas(64) Line {
        float values[16];
    };
    /// An open segment.
    struct Piece {
        std::size_t first = 0, count = 0, K = 0;
        std::vector<Line> lines; ///< coefficients [blocks x K x block], see Term
        Matrix<float> basis;     ///< [count x 3K]
        const float* coefficients() const { return lines.data()->values; }
    };

    Player() = default;
    void order_vertices(std::span<const std::uint32_t> surface_of, std::uint32_t surface_vertices);
    Status open_segments(container::SegmentSource& segments, const codecs::Codec& codec,
                         const connectivity::Surface& surface, const OpenOptions& options);
    void add(const codecs::Trajectories& trajectories, std::size_t first, Threads threads);
    void add_term(const Piece& piece);
    std::size_t piece_of(std::size_t f) const;
    FrameTerms stored(std::size_t f) const;
    void pose_block(const FrameTerms& frame, std::size_t b, float* out) const;
    void spread(float* out) const;
    std::size_t blocks() const { return (unique_.size() + kernel_.block - 1) / kernel_.block; }

    std::uint32_t vertex_count_ = 0;
    std::vector<double> times_s_;
    double period_s_ = 0.0; ///< as Timeline
    std::vector<Triangle> triangles_;
    Metadata metadata_;
    Kernel kernel_;
    std::vector<std::uint32_t> unique_; ///< [U] surface vertices to pose, in the order of their output vertices
    std::vector<std::uint32_t>
        unique_of_;             ///< [V] place in unique_, not above v; empty: few are welded, all V are posed
    std::vector<Piece> pieces_; ///< by first frame
    Matrix<double> means_;      ///< [F x 3]
    std::vector<float> mixed_;  ///< [4 x 3 K], bases of the frames sought
    FrameTerms sought_;
};

} // namespace meshreel::player
