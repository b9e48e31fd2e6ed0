/// Poses in an order from coarse to fine, and who is near whom, as the poses become known.
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "meshreel/base/views.h"
#include "meshreel/predict/kriging.h"

namespace meshreel::codecs {

/// The frames of a window by farthest point order. Two poses are as far apart as their known eigentrajectory columns
/// (3 and on; the mean moves all vertices alike and tells little), and as they are in time: a frame's step counts
/// as much as poses change from frame to frame in the mean. Where nothing is known yet, time alone counts.
class PoseOrder {
public:
    explicit PoseOrder(std::size_t frames) : squares_(frames, frames) {}

    /// Batches of columns: the mean, then one component, and half as many again as are known.
    static std::size_t batch_end(std::size_t first) { return first < 3 ? 3 : first + 3 * ((first / 3 + 1) / 2); }

    /// Orders the frames anew, now that columns 0 .. known-1 of Y [F x columns] are known everywhere; known must rise.
    void renew(MatrixView<const double> Y, std::size_t known);

    std::size_t frame(std::size_t rank) const { return order_[rank]; }

    struct Neighbours {
        std::size_t count = 0;
        std::array<std::size_t, predict::Kriging::most> frames{};
        std::array<double, predict::Kriging::most> weights{};
    };
    using Group = std::array<Neighbours, predict::Kriging::lanes>;

    /// Frames that are weighed side by side, from a rank on: those that have the same number of neighbours.
    std::size_t group_size(std::size_t rank, std::size_t most) const
    {
        return rank < most ? 1 : std::min(predict::Kriging::lanes, order_.size() - rank);
    }
    /// Of each frame of the group that begins at a rank: the frames before it in the order that are nearest to it, at most
    /// `most`, and the weights that predict it.
    Group nearest(std::size_t rank, std::size_t most, MatrixView<const double> Y) const;

private:
    Neighbours nearest_of(std::size_t rank, std::size_t most) const;
    double square(std::size_t f, std::size_t g) const
    {
        const double apart = static_cast<double>(f) - static_cast<double>(g);
        return squares_(f, g) + squared_pace_ * apart * apart;
    }
    void add_squares(MatrixView<const double> Y, std::size_t known);
    void measure(MatrixView<const double> Y, std::size_t known);
    void sort();

    Matrix<double> squares_; ///< [F x F] squared distances in the known columns
    double squared_pace_ = 1.0;
    std::size_t known_ = 3;
    std::vector<double> relevance_; ///< of time, then of the known columns
    std::vector<std::size_t> order_;
};

} // namespace meshreel::codecs
