/// RangeWriter and RangeReader: the adaptive range coder as a SymbolCoder.
// SPDX-License-Identifier: MIT
#pragma once

#include <cassert>
#include <cstdint>
#include <span>
#include <vector>

#include "meshreel/base/result.h"
#include "meshreel/base/views.h"
#include "meshreel/coding/model.h"
#include "meshreel/coding/symbol_coder.h"

namespace meshreel::coding {

/// What a symbol coder needs to know before its first symbol; the same on both sides.
struct Contexts {
    static constexpr std::uint32_t most = 1u << 20; ///< contexts a coder may have
    static constexpr std::uint32_t largest_alphabet = 1u << 16;

    std::uint32_t levels = 0;             ///< contexts 0 .. levels-1 of level()
    std::vector<std::uint32_t> alphabets; ///< [contexts of symbol()], alphabet of each, 1 .. 2^16

    /// @fails bad_input: more contexts, or a larger alphabet, than any coder takes.
    Status check() const
    {
        MESHREEL_CHECK(within(std::uint64_t{levels} + alphabets.size(), most, "context_count"));
        for (const std::uint32_t alphabet : alphabets) MESHREEL_CHECK(within(alphabet, largest_alphabet, "alphabet"));
        return Ok{};
    }

private:
    static Status within(std::uint64_t count, std::uint64_t limit, const char* field)
    {
        if (count <= limit) return Ok{};
        return bad_input("is more than an entropy coder takes", field);
    }
};

/// The part that both directions share. Core: RangeEncoder or RangeDecoder.
template <class Core>
class RangeSymbols {
public:
    static constexpr bool writes = Core::writes;

    std::int32_t level(std::uint32_t context, std::int32_t wanted)
    {
        assert(context < levels_.size());
        return levels_[context].code(core_, wanted);
    }
    std::int32_t symbol(std::uint32_t context, std::int32_t wanted)
    {
        assert(context < trees_.size());
        return static_cast<std::int32_t>(trees_[context].code(core_, static_cast<std::uint32_t>(wanted)));
    }
    std::int32_t bits(std::int32_t value, int count)
    {
        return static_cast<std::int32_t>(core_.raw(static_cast<std::uint32_t>(value), count));
    }

protected:
    RangeSymbols(Core core, const Contexts& contexts) : core_(std::move(core)), levels_(contexts.levels)
    {
        for (const std::uint32_t alphabet : contexts.alphabets) trees_.emplace_back(alphabet);
    }

    Core core_;

private:
    std::vector<LevelModel> levels_;
    std::vector<TreeModel> trees_;
};

/// Writes levels and symbols; about 100 bytes of memory a context, 100 more an alphabet symbol or escape.
class RangeWriter : public RangeSymbols<RangeEncoder> {
public:
    explicit RangeWriter(const Contexts& contexts) : RangeSymbols(RangeEncoder{}, contexts) {}

    /// All bytes; the writer is spent.
    Bytes finish() { return core_.finish(); }
};

/// Reads them back, in the same order with the same contexts.
class RangeReader : public RangeSymbols<RangeDecoder> {
public:
    /// @fails bad_input: absurd contexts.
    static Result<RangeReader> open(ByteView bytes, const Contexts& contexts)
    {
        MESHREEL_CHECK(contexts.check());
        return RangeReader(bytes, contexts);
    }
    /// More was read than was written: the bytes are cut or wrong.
    bool overrun() const { return core_.overrun(); }
    std::uint64_t position() const { return core_.position(); }

private:
    RangeReader(ByteView bytes, const Contexts& contexts) : RangeSymbols(RangeDecoder{bytes}, contexts) {}
};

static_assert(SymbolCoder<RangeWriter> && SymbolCoder<RangeReader>);

} // namespace meshreel::coding
