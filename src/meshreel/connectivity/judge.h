/// Is this candidate the right one? A mixture of models that look at different pasts.
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "meshreel/coding/mixer.h"

namespace meshreel::connectivity {

/// Judges candidates of up to 96 kinds by six contexts each, any 32-bit numbers; they share a table by hash.
class Judge {
public:
    using Contexts = std::array<std::uint32_t, 6>;

    template <class Coder>
    bool code(Coder& coder, std::uint32_t kind, const Contexts& contexts, bool wanted)
    {
        std::array<coding::Bit*, 6> models;
        for (std::uint32_t i = 0; i < 6; ++i) {
            const std::uint32_t hash = (contexts[i] * 0x9e3779b1u ^ (kind * 8 + i)) * 2654435761u;
            models[i] = &bits_[hash >> (32 - slot_bits)];
        }
        return mixers_[kind].code(coder, models, wanted);
    }

private:
    static constexpr int slot_bits = 16;

    std::vector<coding::Bit> bits_ = std::vector<coding::Bit>(std::size_t{1} << slot_bits);
    std::array<coding::Mixer<6>, 96> mixers_;
};

/// The order in which candidates are tried: what was right climbs.
template <std::size_t kinds>
class TryOrder {
public:
    TryOrder()
    {
        for (std::uint8_t kind = 0; kind < kinds; ++kind) order_[kind] = kind;
    }
    std::uint8_t operator[](std::size_t place) const { return order_[place]; }
    void right(std::size_t place) { std::swap(order_[place], order_[place / 2]); }

private:
    std::array<std::uint8_t, kinds> order_;
};

} // namespace meshreel::connectivity
