/// Distances between poses, added up as columns become known.
// SPDX-License-Identifier: MIT
#include "meshreel/codecs/pose_order.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace meshreel::codecs {

void PoseOrder::renew(MatrixView<const double> Y, std::size_t known)
{
    add_squares(Y, known);
    measure(Y, known);
    sort();
}

void PoseOrder::add_squares(MatrixView<const double> Y, std::size_t known)
{
    for (std::size_t f = 0; f < Y.rows; ++f)
        for (std::size_t g = 0; g < f; ++g) {
            double sum = squares_(f, g);
            for (std::size_t c = known_; c < known; ++c) {
                const double difference = Y(f, c) - Y(g, c);
                sum += difference * difference;
            }
            squares_(f, g) = squares_(g, f) = sum;
        }
    known_ = std::max(known_, known);
}

/// The pace of the poses, and how relevant each component is: the fainter the more, by the root of its energy.
void PoseOrder::measure(MatrixView<const double> Y, std::size_t known)
{
    double steps = 0;
    for (std::size_t f = 1; f < Y.rows; ++f) steps += squares_(f, f - 1);
    squared_pace_ = steps > 0 ? steps / static_cast<double>(Y.rows - 1) : 1.0;
    relevance_.assign(1, 1.0);
    double first = 0;
    for (std::size_t c = 3; c < known; c += 3) {
        double energy = 0;
        for (std::size_t f = 0; f < Y.rows; ++f)
            energy += Y(f, c) * Y(f, c) + Y(f, c + 1) * Y(f, c + 1) + Y(f, c + 2) * Y(f, c + 2);
        if (c == 3) first = energy;
        const double relevance = energy > 0 && first > 0 ? std::sqrt(std::sqrt(first / energy)) : 0.0;
        relevance_.insert(relevance_.end(), 3, relevance);
    }
}

void PoseOrder::sort()
{
    const std::size_t F = squares_.rows;
    std::vector<double> distance(F, std::numeric_limits<double>::infinity());
    order_.clear();
    for (std::size_t next = 0; order_.size() < F;) {
        order_.push_back(next);
        distance[next] = -1;
        std::size_t farthest = 0;
        for (std::size_t f = 0; f < F; ++f) {
            if (distance[f] >= 0) distance[f] = std::min(distance[f], square(next, f));
            if (distance[f] > distance[farthest]) farthest = f;
        }
        next = farthest;
    }
}

/// Without weights, the nearest first.
PoseOrder::Neighbours PoseOrder::nearest_of(std::size_t rank, std::size_t most) const
{
    struct Near {
        double square;
        std::size_t frame;
        bool operator<(const Near& other) const
        {
            return square != other.square ? square < other.square : frame < other.frame;
        }
    };
    const std::size_t f = order_[rank];
    std::array<Near, predict::Kriging::most> near; // the nearest so far, in order
    Neighbours result;
    for (std::size_t r = 0; r < rank; ++r) {
        const Near one{square(f, order_[r]), order_[r]};
        if (result.count == most && !(one < near[most - 1])) continue;
        std::size_t place = result.count < most ? result.count++ : most - 1;
        for (; place > 0 && one < near[place - 1]; --place) near[place] = near[place - 1];
        near[place] = one;
    }
    for (std::size_t i = 0; i < result.count; ++i) result.frames[i] = near[i].frame;
    return result;
}

PoseOrder::Group PoseOrder::nearest(std::size_t rank, std::size_t most, MatrixView<const double> Y) const
{
    Group group;
    const std::size_t size = group_size(rank, most), count = std::min(most, rank);
    if (count == 0) return group;
    predict::Kriging kriging(relevance_.size());
    const double pace = std::sqrt(squared_pace_);
    for (std::size_t lane = 0; lane < size; ++lane) {
        const std::size_t f = order_[rank + lane];
        group[lane] = nearest_of(rank + lane, most);
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t g = group[lane].frames[i];
            kriging.differences(0)[i] = pace * (static_cast<double>(g) - static_cast<double>(f));
            for (std::size_t k = 1; k < relevance_.size(); ++k)
                kriging.differences(k)[i] = relevance_[k] * (Y(g, k + 2) - Y(f, k + 2));
        }
        kriging.set(lane, count, relevance_.size());
    }
    const auto weights = kriging.weights(count, {100.0, 1.0, 0.005, 0.0});
    for (std::size_t lane = 0; lane < size; ++lane)
        for (std::size_t i = 0; i < count; ++i) group[lane].weights[i] = weights[i][lane];
    return group;
}

} // namespace meshreel::codecs
