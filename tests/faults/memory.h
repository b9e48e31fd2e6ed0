/// How much memory a test program holds, and what it does without: the counting allocator, which can fail.
// SPDX-License-Identifier: MIT
//
// Every operator new and delete is counted; malloc too can fail, where no sanitizer has it.
#pragma once

#include <cstddef>
#include <cstdint>

namespace meshreel::faults {

/// Bytes held now by operator new, and the most that were held since the last call of reset_peak().
std::size_t held();
std::size_t peak();
void reset_peak();

/// While it lives, allocations are counted, and some of them fail.
class Scarcity {
public:
    enum class Of : std::uint8_t { one, all_from_there };
    static constexpr std::size_t none = ~std::size_t{0};

    /// The allocation of that number fails, counted from 0, or it and all that follow.
    explicit Scarcity(std::size_t failing = none, Of of = Of::one);
    ~Scarcity();
    Scarcity(const Scarcity&) = delete;
    Scarcity& operator=(const Scarcity&) = delete;

    /// How many there were so far.
    std::size_t asked() const;
};

} // namespace meshreel::faults
