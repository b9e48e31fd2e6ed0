/// The active borders: loops of edges between what is conquered and what is not. Shared by both directions.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "meshreel/connectivity/adjacency.h"

namespace meshreel::connectivity {

/// Loops of half-edges, linked in the order in which the free side sees them from left to right. A border edge is named
/// by the half-edge of its conquered triangle, 3 k + i for the k-th one.
///
///               tip                 A new triangle k on gate g: its edge 3k + 1 is the right one,
///      3k + 2  /   \  3k + 1        3k + 2 the left one. Right of g lies next(g), left of it previous(g).
///             / k   \                                                            .
///    ------- ---- g ---- -------
class Border {
public:
    explicit Border(std::uint32_t triangle_count) : next_(3ul * triangle_count), previous_(3ul * triangle_count) {}

    std::uint32_t next(std::uint32_t edge) const { return next_[edge]; }
    std::uint32_t previous(std::uint32_t edge) const { return previous_[edge]; }

    /// A component's first triangle; returns its gate.
    std::uint32_t begin(std::uint32_t k)
    {
        link(3 * k, 3 * k + 2);
        link(3 * k + 2, 3 * k + 1);
        link(3 * k + 1, 3 * k);
        return 3 * k + 1;
    }
    /// C: two edges for one. The new gate is the right one.
    std::uint32_t add(std::uint32_t gate, std::uint32_t k)
    {
        link(previous_[gate], 3 * k + 2);
        link(3 * k + 1, next_[gate]);
        link(3 * k + 2, 3 * k + 1);
        return 3 * k + 1;
    }
    /// R: the left edge for the gate and what lay right of it.
    std::uint32_t close_right(std::uint32_t gate, std::uint32_t k)
    {
        const std::uint32_t after = next_[next_[gate]];
        link(previous_[gate], 3 * k + 2);
        link(3 * k + 2, after);
        return 3 * k + 2;
    }
    /// L: the right edge for the gate and what lay left of it.
    std::uint32_t close_left(std::uint32_t gate, std::uint32_t k)
    {
        const std::uint32_t before = previous_[previous_[gate]];
        link(3 * k + 1, next_[gate]);
        link(before, 3 * k + 1);
        return 3 * k + 1;
    }
    /// S and merges: the tip is the left end of border edge `at`. On the gate's own loop this makes two loops, with
    /// gates 3 k + 1 (right) and 3 k + 2 (left); on another loop it makes one of two. `at` is neither the gate nor
    /// right of it.
    void join(std::uint32_t gate, std::uint32_t k, std::uint32_t at)
    {
        const std::uint32_t before = previous_[at];
        link(3 * k + 1, next_[gate]);
        link(previous_[gate], 3 * k + 2);
        link(before, 3 * k + 1);
        link(3 * k + 2, at);
    }

private:
    void link(std::uint32_t left, std::uint32_t right)
    {
        next_[left] = right;
        previous_[right] = left;
    }

    std::vector<std::uint32_t> next_, previous_;
};

/// A budget of steps, so that no string keeps a decoder busy for long.
class WorkBudget {
public:
    explicit WorkBudget(std::uint32_t triangle_count) : left_(64ull * triangle_count + 1024) {}

    /// False once more is spent than there was.
    bool spend(std::uint64_t steps)
    {
        exhausted_ = exhausted_ || steps > left_;
        left_ -= exhausted_ ? 0 : steps;
        return !exhausted_;
    }

private:
    std::uint64_t left_;
    bool exhausted_ = false;
};

} // namespace meshreel::connectivity
