/// Huffman's construction, its tables on the wire, and the two coders.
// SPDX-License-Identifier: MIT
#include "meshreel/coding/huffman.h"

#include <algorithm>
#include <cassert>
#include <queue>

#include "meshreel/base/text.h"
#include "meshreel/coding/model.h"
#include "meshreel/coding/varint.h"

namespace meshreel::coding {

namespace {

// A level's symbol: its zigzag number below `direct`, beyond that the number's bit width and the bits below the top one.
constexpr std::uint32_t direct = 512;
constexpr int direct_width = 10; // bit width of 512
constexpr std::uint32_t level_alphabet = direct + 33 - direct_width;

struct LevelSymbol {
    std::uint32_t symbol;
    std::uint32_t rest;
    int rest_bits;
};

LevelSymbol split_level(std::int32_t level)
{
    const auto folded = static_cast<std::uint32_t>(zigzag(level));
    if (folded < direct) return {folded, 0, 0};
    const int width = bit_width(folded);
    return {direct + static_cast<std::uint32_t>(width - direct_width), folded, width - 1};
}

/// Plain Huffman; the lengths may grow beyond any limit.
std::vector<std::uint32_t> optimal_lengths(std::span<const std::uint64_t> counts)
{
    struct Node {
        std::uint64_t count;
        std::uint32_t index;
    };
    const auto heavier = [](const Node& a, const Node& b) {
        return a.count != b.count ? a.count > b.count : a.index > b.index;
    };
    std::priority_queue<Node, std::vector<Node>, decltype(heavier)> open(heavier);
    for (std::uint32_t i = 0; i < counts.size(); ++i)
        if (counts[i] != 0) open.push({counts[i], i});
    std::vector<std::uint32_t> parent(counts.size(), 0);
    while (open.size() > 1) {
        const Node a = open.top();
        open.pop();
        const Node b = open.top();
        open.pop();
        const auto joined = static_cast<std::uint32_t>(parent.size());
        parent.push_back(0);
        parent[a.index] = parent[b.index] = joined;
        open.push({a.count + b.count, joined});
    }
    // Parents come after their children; the root is last and its parent 0 is never followed.
    std::vector<std::uint32_t> depth(parent.size(), 0);
    for (std::size_t i = parent.size(); i-- > 0;) depth[i] = parent[i] == 0 ? 0 : depth[parent[i]] + 1;
    depth.resize(counts.size());
    return depth;
}

/// How the tables are written: by adaptive decisions, so that unused contexts and regular lengths cost little.
struct TableModels {
    TreeModel kind{3}; ///< none, one or many symbols
    NumberModel size;
    std::array<LevelModel, 3> change; ///< of the length against its forecast; by what the forecast is
};

/// Forecast of a length: levels of one sign stand two places apart; zeros tell nothing once real lengths are near.
std::uint8_t forecast(std::span<const std::uint8_t> lengths, std::size_t i)
{
    const std::uint8_t same_sign = i >= 2 ? lengths[i - 2] : 0;
    return same_sign != 0 || i == 0 ? same_sign : lengths[i - 1];
}

template <class Coder>
void code_lengths(Coder& coder, TableModels& models, std::span<std::uint8_t> lengths)
{
    for (std::size_t i = 0; i < lengths.size(); ++i) {
        const std::uint8_t guess = forecast(lengths, i);
        LevelModel& model = models.change[guess == 0 ? 0 : i > 0 && lengths[i - 1] == 0 ? 1 : 2];
        const std::int32_t change = model.code(coder, lengths[i] - guess);
        const std::int32_t length = std::clamp(change, -longest_code, longest_code) + guess;
        lengths[i] = static_cast<std::uint8_t>(std::clamp(length, 0, longest_code));
    }
}

enum Kind : std::uint32_t { no_symbol, one_symbol, many_symbols };

HuffmanCode write_table(RangeEncoder& coder, TableModels& models, std::span<const std::uint64_t> counts)
{
    const auto used = counts.size() - static_cast<std::size_t>(std::count(counts.begin(), counts.end(), 0u));
    const Kind kind = used == 0 ? no_symbol : used == 1 ? one_symbol : many_symbols;
    models.kind.code(coder, kind);
    if (kind == no_symbol) return {};
    const auto last = static_cast<std::uint32_t>(counts.size() - 1); // counts grow to the largest symbol met
    models.size.code(coder, last);
    if (kind == one_symbol) return HuffmanCode::lone(last);
    std::vector<std::uint8_t> lengths = huffman_lengths(counts);
    code_lengths(coder, models, lengths);
    return *HuffmanCode::from_lengths(lengths);
}

Result<HuffmanCode> read_table(RangeDecoder& coder, TableModels& models, std::uint32_t alphabet)
{
    const std::uint32_t kind = models.kind.code(coder, 0);
    if (kind == no_symbol) return HuffmanCode{};
    const std::uint64_t last = models.size.code(coder, 0);
    if (last >= alphabet) return bad_input(concat("symbol ", last, " of an alphabet of ", alphabet), "huffman_table");
    if (kind == one_symbol) return HuffmanCode::lone(static_cast<std::uint32_t>(last));
    std::vector<std::uint8_t> lengths(last + 1);
    code_lengths(coder, models, lengths);
    return HuffmanCode::from_lengths(lengths);
}

} // namespace

std::vector<std::uint8_t> huffman_lengths(std::span<const std::uint64_t> counts)
{
    std::vector<std::uint64_t> scaled(counts.begin(), counts.end());
    for (;;) {
        const std::vector<std::uint32_t> lengths = optimal_lengths(scaled);
        if (std::all_of(lengths.begin(), lengths.end(), [](std::uint32_t l) { return l <= longest_code; }))
            return {lengths.begin(), lengths.end()};
        for (std::uint64_t& count : scaled) count = count == 0 ? 0 : count / 2 + 1;
    }
}

Result<HuffmanCode> HuffmanCode::from_lengths(std::span<const std::uint8_t> lengths)
{
    std::array<std::uint32_t, longest_code + 1> of_length{};
    for (const std::uint8_t length : lengths) ++of_length[length];
    HuffmanCode code;
    std::array<std::uint64_t, longest_code + 1> next{};
    std::uint64_t first = 0;
    std::uint32_t place = 0;
    for (int length = 1; length <= longest_code; ++length) {
        first <<= 1;
        next[length] = first;
        code.skip_[length] = place - static_cast<std::uint32_t>(first);
        first += of_length[length];
        place += of_length[length];
        code.end_[length] = first;
        if (first > std::uint64_t{1} << length)
            return bad_input("the code lengths are over-subscribed", "huffman_table");
    }
    if (first != std::uint64_t{1} << longest_code)
        return bad_input("the code lengths leave codes unused", "huffman_table");
    code.words_.resize(lengths.size());
    code.lengths_.assign(lengths.begin(), lengths.end());
    code.sorted_.resize(place);
    for (std::uint32_t symbol = 0; symbol < lengths.size(); ++symbol) {
        const int length = lengths[symbol];
        if (length == 0) continue;
        code.words_[symbol] = static_cast<std::uint32_t>(next[length]++);
        code.sorted_[code.skip_[length] + code.words_[symbol]] = symbol;
    }
    return code;
}

HuffmanCode HuffmanCode::lone(std::uint32_t symbol)
{
    HuffmanCode code;
    code.sorted_ = {symbol};
    code.words_.resize(symbol + 1);
    code.lengths_.resize(symbol + 1);
    return code;
}

std::uint32_t HuffmanCode::get(BitReader& bits) const
{
    if (sorted_.size() <= 1) return sorted_.empty() ? 0 : sorted_[0];
    std::uint32_t word = 0;
    for (int length = 1; length <= longest_code; ++length) {
        word = word << 1 | bits.bit();
        if (word < end_[length]) return sorted_[skip_[length] + word];
    }
    return 0; // not reached: the code is complete
}

HuffmanWriter::HuffmanWriter(const Contexts& contexts)
    : level_contexts_(contexts.levels), counts_(contexts.levels + contexts.alphabets.size())
{
}

std::int32_t HuffmanWriter::level(std::uint32_t context, std::int32_t wanted)
{
    assert(context < level_contexts_);
    const LevelSymbol parts = split_level(wanted);
    symbol(context - level_contexts_, static_cast<std::int32_t>(parts.symbol));
    items_.back().rest = parts.rest;
    items_.back().rest_bits = static_cast<std::uint8_t>(parts.rest_bits);
    return wanted;
}

std::int32_t HuffmanWriter::symbol(std::uint32_t context, std::int32_t wanted)
{
    const std::uint32_t table = level_contexts_ + context; // a level's context counts from below, modulo 2^32
    assert(table < counts_.size());
    const auto place = static_cast<std::uint32_t>(wanted);
    if (counts_[table].size() <= place) counts_[table].resize(place + 1);
    ++counts_[table][place];
    items_.push_back({table, place, 0, 0});
    return wanted;
}

std::int32_t HuffmanWriter::bits(std::int32_t value, int count)
{
    items_.push_back({raw, 0, static_cast<std::uint32_t>(value), static_cast<std::uint8_t>(count)});
    return value;
}

Bytes HuffmanWriter::finish()
{
    RangeEncoder tables;
    TableModels models;
    std::vector<HuffmanCode> codes;
    codes.reserve(counts_.size());
    for (const std::vector<std::uint64_t>& counts : counts_) codes.push_back(write_table(tables, models, counts));
    BitWriter body;
    for (const Item& item : items_) {
        if (item.table != raw) codes[item.table].put(body, item.symbol);
        body.put(item.rest, item.rest_bits);
    }
    const Bytes table_bytes = tables.finish();
    Bytes all;
    put_varint(all, table_bytes.size());
    all.insert(all.end(), table_bytes.begin(), table_bytes.end());
    all.insert(all.end(), body.bytes().begin(), body.bytes().end());
    return all;
}

Result<HuffmanReader> HuffmanReader::open(ByteView bytes, const Contexts& contexts)
{
    MESHREEL_CHECK(contexts.check());
    VarintReader head(bytes);
    MESHREEL_TRY(const std::uint64_t size, head.number("huffman_table_size"));
    MESHREEL_TRY(const ByteView table_bytes, head.block(size, "huffman_table"));
    RangeDecoder tables(table_bytes);
    TableModels models;
    std::vector<HuffmanCode> codes;
    for (std::size_t i = 0; i < contexts.levels + contexts.alphabets.size() && !tables.overrun(); ++i) {
        const std::uint32_t alphabet = i < contexts.levels ? level_alphabet : contexts.alphabets[i - contexts.levels];
        MESHREEL_TRY(HuffmanCode code, read_table(tables, models, alphabet));
        codes.push_back(std::move(code));
    }
    if (tables.overrun()) return bad_input("the tables are cut", "huffman_table", at_byte(bytes.size()));
    return HuffmanReader(contexts.levels, std::move(codes), head.rest());
}

std::int32_t HuffmanReader::level(std::uint32_t context, std::int32_t)
{
    assert(context < level_contexts_);
    const std::uint32_t symbol = codes_[context].get(bits_);
    if (symbol < direct) return static_cast<std::int32_t>(unzigzag(symbol));
    const int rest_bits = static_cast<int>(symbol - direct) + direct_width - 1;
    const std::uint64_t folded = std::uint64_t{1} << rest_bits | bits_.get(rest_bits);
    return static_cast<std::int32_t>(unzigzag(folded));
}

std::int32_t HuffmanReader::symbol(std::uint32_t context, std::int32_t)
{
    return static_cast<std::int32_t>(codes_[level_contexts_ + context].get(bits_));
}

} // namespace meshreel::coding
