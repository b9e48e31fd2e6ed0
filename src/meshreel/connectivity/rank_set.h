/// A set of numbers below n that knows the rank of each and the number at each rank, by a Fenwick tree over words.
// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

namespace meshreel::connectivity {

/// Empty or full at first. Every operation costs O(log n), those that ask for the first or a near neighbour O(1).
class RankSet {
public:
    static constexpr std::uint32_t nobody = 0xffffffff;

    RankSet(std::uint32_t n, bool full) : words_(n / word_bits + 1ul), tree_(words_.size() + 1)
    {
        while (top_ <= words_.size() / 2) top_ *= 2;
        if (!full) return;
        for (std::uint32_t x = 0; x < n; ++x) words_[x / word_bits] |= bit_of(x);
        for (std::size_t i = 1; i < tree_.size(); ++i) tree_[i] += count(words_[i - 1]);
        for (std::size_t i = 1; i < tree_.size(); ++i)
            if (const std::size_t above = i + (i & (0u - i)); above < tree_.size()) tree_[above] += tree_[i];
        size_ = n;
    }

    std::uint32_t size() const { return size_; }
    /// How many elements are below x; x <= n.
    std::uint32_t rank(std::uint32_t x) const
    {
        std::uint32_t below = count(words_[x / word_bits] & (bit_of(x) - 1));
        for (std::uint32_t i = x / word_bits; i > 0; i &= i - 1) below += tree_[i];
        return below;
    }
    /// The element with `rank` elements below it; rank < size().
    std::uint32_t at(std::uint32_t rank) const
    {
        std::size_t place = 0;
        for (std::size_t step = top_; step > 0; step /= 2) {
            if (place + step >= tree_.size() || tree_[place + step] > rank) continue;
            place += step;
            rank -= tree_[place];
        }
        std::uint64_t word = words_[place];
        for (; rank > 0; --rank) word &= word - 1;
        return element(place, word);
    }
    /// The smallest element; of a set that is not empty.
    std::uint32_t first() const { return element(lowest_, words_[lowest_]); }
    /// The smallest element above x, or nobody; x <= n.
    std::uint32_t after(std::uint32_t x) const
    {
        const std::size_t place = x / word_bits;
        if (const std::uint64_t word = words_[place] & ~(bit_of(x) | (bit_of(x) - 1)); word != 0)
            return element(place, word);
        if (place + 1 < words_.size() && words_[place + 1] != 0) return element(place + 1, words_[place + 1]);
        const std::uint32_t below = rank(x) + (holds(x) ? 1 : 0);
        return below < size_ ? at(below) : nobody;
    }
    /// The largest element below x, or nobody; x <= n.
    std::uint32_t before(std::uint32_t x) const
    {
        const std::size_t place = x / word_bits;
        if (const std::uint64_t word = words_[place] & (bit_of(x) - 1); word != 0) return highest(place, word);
        if (place > 0 && words_[place - 1] != 0) return highest(place - 1, words_[place - 1]);
        const std::uint32_t below = rank(x);
        return below > 0 ? at(below - 1) : nobody;
    }
    /// Puts in an element that is not there.
    void insert(std::uint32_t x)
    {
        words_[x / word_bits] |= bit_of(x);
        if (size_ == 0 || x / word_bits < lowest_) lowest_ = x / word_bits;
        for (std::size_t i = x / word_bits + 1; i < tree_.size(); i += i & (0u - i)) ++tree_[i];
        ++size_;
    }
    /// Takes out an element that is there.
    void erase(std::uint32_t x)
    {
        words_[x / word_bits] &= ~bit_of(x);
        for (std::size_t i = x / word_bits + 1; i < tree_.size(); i += i & (0u - i)) --tree_[i];
        --size_;
        while (size_ > 0 && words_[lowest_] == 0) ++lowest_; // a walk through once, where what is put in rises
    }

private:
    static constexpr std::uint32_t word_bits = 64;

    static std::uint64_t bit_of(std::uint32_t x) { return std::uint64_t{1} << x % word_bits; }
    static std::uint32_t count(std::uint64_t word) { return static_cast<std::uint32_t>(std::popcount(word)); }
    /// The lowest of a word.
    static std::uint32_t element(std::size_t place, std::uint64_t word)
    {
        return static_cast<std::uint32_t>(place * word_bits) + static_cast<std::uint32_t>(std::countr_zero(word));
    }
    static std::uint32_t highest(std::size_t place, std::uint64_t word)
    {
        return static_cast<std::uint32_t>(place * word_bits) + static_cast<std::uint32_t>(std::bit_width(word)) - 1;
    }
    bool holds(std::uint32_t x) const { return (words_[x / word_bits] & bit_of(x)) != 0; }

    std::uint32_t size_ = 0;
    std::size_t lowest_ = 0; ///< the first word that has an element, if any has
    std::size_t top_ = 1;    ///< the largest power of two that is at most the number of words
    std::vector<std::uint64_t> words_;
    std::vector<std::uint32_t> tree_; ///< of how many elements each word has
};

} // namespace meshreel::connectivity
