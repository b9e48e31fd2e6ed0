/// The basis frame by frame: a pose is predicted from the most similar poses already known, wherever in time they are.
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "meshreel/base/views.h"
#include "meshreel/codecs/contexts.h"
#include "meshreel/codecs/nearby_levels.h"
#include "meshreel/codecs/pose_order.h"
#include "meshreel/coding/mixed_levels.h"
#include "meshreel/coding/quantiser.h"
#include "meshreel/predict/kriging.h"

namespace meshreel::codecs {

/// Codes mean and basis as poses: row f of Y [F x 3(K+1)] holds what frame f takes of the mean (x, y, z) and of each
/// eigentrajectory, each scaled by what it weighs in the animation. Columns come in batches of growing size; for each
/// the frames are put in farthest point order among the poses as known so far, and every frame is predicted from its
/// nearest ones by kriging.
/// @cost O(F^2 K) a window of at most 1024 frames.
template <class Core>
class PoseWalk {
public:
    PoseWalk(Core& core, coding::Quantiser quantiser)
        : core_(core), quantiser_(quantiser),
          levels_({near_columns * own_columns, near_columns * ages, fine_columns}, 1)
    {
    }

    /// Writing: originals in. Afterwards Y holds what the decoder sees.
    void code(MatrixView<double> Y)
    {
        usual_.assign(Y.cols, 1.0);
        const std::size_t windows = (Y.rows + longest_window - 1) / longest_window;
        for (std::size_t w = 0; w < windows && !ended(core_); ++w) {
            const std::size_t begin = Y.rows * w / windows, end = Y.rows * (w + 1) / windows;
            code_window({Y.row(begin).data(), end - begin, Y.cols});
        }
    }

private:
    static constexpr std::size_t longest_window = 1024, neighbours = 8;
    static constexpr std::uint32_t near_columns = 26, own_columns = 20, ages = 12, fine_columns = 52;

    void code_window(MatrixView<double> Y)
    {
        levels_seen_ = Matrix<std::uint8_t>(Y.rows, Y.cols);
        own_.assign(Y.rows, 1.0);
        PoseOrder order(Y.rows);
        for (std::size_t first = 0; first < Y.cols && !ended(core_);) {
            const std::size_t last = std::min(Y.cols, PoseOrder::batch_end(first));
            order.renew(Y, first);
            code_batch(order, {Y, first, last});
            first = last;
        }
    }

    struct Batch {
        MatrixView<double> Y;
        std::size_t first, last;
    };

    /// A frame's weights depend on earlier columns alone, so a few are found side by side.
    void code_batch(const PoseOrder& order, const Batch& batch)
    {
        for (std::size_t rank = 0; rank < batch.Y.rows && !ended(core_);) {
            const std::size_t end = rank + order.group_size(rank, neighbours);
            for (const PoseOrder::Neighbours& near : order.nearest(rank, neighbours, batch.Y))
                if (rank < end) code_frame(near, {order.frame(rank), rank++}, batch);
        }
    }

    struct Frame {
        std::size_t f, rank;
    };

    void code_frame(const PoseOrder::Neighbours& near, const Frame& frame, const Batch& batch)
    {
        std::uint32_t age = 0; // 3 an octave of the rank
        for (std::size_t r = frame.rank; r > 0; r /= 2) ++age;
        look_around(near, batch);
        for (std::size_t c = batch.first; c < batch.last; ++c)
            code_value({frame.f, c, std::min(age, ages - 1)}, guess_[c - batch.first], nearby_[c - batch.first],
                       batch.Y);
    }

    /// Fills `guess_` and `nearby_`.
    void look_around(const PoseOrder::Neighbours& near, const Batch& batch)
    {
        const std::size_t size = batch.last - batch.first;
        guess_.assign(size, 0.0);
        nearby_.resize(size);
        for (std::size_t i = 0; i < near.count; ++i) {
            const double* __restrict values = batch.Y.row(near.frames[i]).data() + batch.first;
            const double weight = near.weights[i];
            for (std::size_t c = 0; c < size; ++c) guess_[c] += weight * values[c];
        }
        mean_of_nearby(std::span(near.frames).first(near.count), MatrixView<const std::uint8_t>(levels_seen_.view()),
                       batch.first, std::span(nearby_));
    }

    struct Place {
        std::size_t f, c;
        std::uint32_t age;
    };

    void code_value(const Place& place, double guess, double nearby, MatrixView<double> Y)
    {
        double& value = Y(place.f, place.c);
        double &own = own_[place.f], &usual = usual_[place.c];
        const double expected = 0.4 * nearby + 0.35 * own + 0.25 * usual;
        const coding::MixedLevels<3>::Places places = {coding::octave_column<1>(nearby, near_columns) * own_columns +
                                                           coding::octave_column<1>(own, own_columns),
                                                       coding::octave_column<1>(usual, near_columns) * ages + place.age,
                                                       coding::octave_column<2>(expected, fine_columns)};
        const std::int32_t wanted = Core::writes ? levels_.choose(places, 0, quantiser_, value - guess) : 0;
        const std::int32_t level = levels_.code(core_, places, 0, wanted);
        value = bounded(guess + quantiser_.value(level));
        const std::uint32_t size = magnitude(level);
        levels_seen_(place.f, place.c) = static_cast<std::uint8_t>(std::min(size, 255u));
        own += 0.3 * (size - own);
        usual += 0.04 * (size - usual);
    }

    Core& core_;
    coding::Quantiser quantiser_;
    coding::MixedLevels<3> levels_;
    Matrix<std::uint8_t> levels_seen_;   ///< magnitudes [F x 3(K+1)], up to 255
    std::vector<double> own_;            ///< [F] how large the levels of a frame have been of late
    std::vector<double> usual_;          ///< [3(K+1)] and those of a column
    std::vector<double> guess_, nearby_; ///< of a frame's batch
};

} // namespace meshreel::codecs
