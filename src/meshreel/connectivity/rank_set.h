/// A set of numbers below n that knows the rank of each and the number at each rank, by a Fenwick tree.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

namespace meshreel::connectivity {

/// Empty or full at first. Every operation costs O(log n).
class RankSet {
public:
    RankSet(std::uint32_t n, bool full) : size_(full ? n : 0), tree_(n + 1ul)
    {
        while (top_ <= n / 2) top_ *= 2;
        for (std::uint32_t i = 1; full && i <= n; ++i) tree_[i] = i & (0u - i);
    }

    std::uint32_t size() const { return size_; }
    /// How many elements are below x; x <= n.
    std::uint32_t rank(std::uint32_t x) const
    {
        std::uint32_t below = 0;
        for (; x > 0; x &= x - 1) below += tree_[x];
        return below;
    }
    /// The element with `rank` elements below it; rank < size().
    std::uint32_t at(std::uint32_t rank) const
    {
        std::uint64_t place = 0;
        for (std::uint64_t step = top_; step > 0; step /= 2) {
            if (place + step >= tree_.size() || tree_[place + step] > rank) continue;
            place += step;
            rank -= tree_[place];
        }
        return static_cast<std::uint32_t>(place);
    }
    /// Puts in an element that is not there.
    void insert(std::uint32_t x)
    {
        for (std::uint64_t i = x + 1ul; i < tree_.size(); i += i & (0u - i)) ++tree_[i];
        ++size_;
    }
    /// Takes out an element that is there.
    void erase(std::uint32_t x)
    {
        for (std::uint64_t i = x + 1ul; i < tree_.size(); i += i & (0u - i)) --tree_[i];
        --size_;
    }

private:
    std::uint32_t size_;
    std::uint64_t top_ = 1; ///< the largest power of two that is at most n
    std::vector<std::uint32_t> tree_;
};

} // namespace meshreel::connectivity
