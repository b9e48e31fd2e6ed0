/// The search for the smallest way to pack a table; encoder side.
// SPDX-License-Identifier: MIT
#include <algorithm>

#include "meshreel/base/check.h"
#include "meshreel/container/word_walk.h"

namespace meshreel::container {

namespace {

using Words = std::vector<std::uint32_t>;
using Mapping = WordTable::Mapping;
using Prediction = WordTable::Prediction;

Bytes bytes_in(const Words& words, const WordShape& shape, bool planes)
{
    const std::size_t count = static_cast<std::size_t>(shape.count);
    Bytes bytes(words.size() * shape.width);
    for (std::size_t i = 0; i < words.size(); ++i)
        for (std::uint32_t b = 0; b < shape.width; ++b) {
            const std::size_t row = i / shape.components, c = i % shape.components;
            const std::size_t at = planes ? (c * shape.width + b) * count + row : i * shape.width + b;
            bytes[at] = static_cast<std::uint8_t>(words[i] >> (8 * b));
        }
    return bytes;
}

float float_of(std::uint32_t bits)
{
    float value;
    std::memcpy(&value, &bits, sizeof value);
    return value;
}

/// The word that stands for a float at this scale, if there is one, bit for bit.
bool scaled_word(std::uint32_t bits, double scale, std::uint32_t& word)
{
    const double magnitude = static_cast<double>(float_of(bits & 0x7fffffffu)) * scale;
    if (!(magnitude < 2147483647.0)) return false;
    const std::uint32_t multiple = static_cast<std::uint32_t>(magnitude + 0.5);
    word = bits >> 31 ? ~multiple : multiple;
    const float again = scaled_float(word, scale);
    return std::memcmp(&again, &bits, sizeof again) == 0;
}

/// Decimals of a text file, fixed point, and normalised integers: the smallest scale of which all floats are multiples.
/// 0: none.
double scale_of(std::span<const std::uint32_t> floats)
{
    constexpr double scales[] = {1,     10,      16,      64,      100,      127,  128,    255,    256,    512,
                                 1000,  1023,    1024,    2048,    4095,     4096, 8192,   10000,  16383,  16384,
                                 32767, 32768,   65535,   65536,   1e5,      1e6,  131072, 262144, 524288, 1048576,
                                 1e7,   2097152, 4194304, 8388608, 16777216, 1e8,  1e9};
    std::uint32_t ignored = 0;
    for (const double scale : scales) {
        std::size_t i = 0;
        while (i < floats.size() && scaled_word(floats[i], scale, ignored)) ++i;
        if (i == floats.size()) return scale;
    }
    return 0.0;
}

Words mapped(std::span<const std::uint32_t> words, Mapping mapping, double scale)
{
    Words result(words.begin(), words.end());
    if (mapping == Mapping::ordered)
        for (std::uint32_t& word : result) word = word >> 31 ? ~word : word | 0x80000000u;
    if (mapping == Mapping::scaled)
        for (std::uint32_t& word : result) scaled_word(word, scale, word);
    return result;
}

/// One way to code a table, and the bytes it leaves for zstd.
struct Attempt {
    WordTable table;
    Bytes bytes;
    std::size_t size = 0; ///< packed quickly
};

class Search {
public:
    Search(const WordShape& shape, const WordContext& context) : shape_(shape), context_(context) {}

    void try_mapping(std::span<const std::uint32_t> words, Mapping mapping, double scale)
    {
        mapping_ = mapping;
        scale_ = scale;
        Words numbers = mapped(words, mapping, scale);
        try_layouts(Prediction::none, numbers);
        Words residuals(numbers.size());
        walk_guesses<true>(shape_, nullptr, numbers, residuals);
        try_layouts(Prediction::previous, residuals);
        if (context_.faces != nullptr) {
            walk_guesses<true>(shape_, &context_, numbers, residuals);
            try_layouts(Prediction::mesh, residuals);
        }
        if (shape_.components == 1 && shape_.width == 4 && !context_.floats) {
            walk_fresh<true>(numbers, residuals);
            try_layouts(Prediction::fresh, residuals);
        }
        if (context_.corners != nullptr && shape_.width == 4 && numbers.size() == context_.corners->size() * 3) {
            CornerWalk walk(context_);
            walk.run<true>(numbers, residuals);
            if (walk.fits()) try_layouts(Prediction::corner, residuals);
        }
    }

    /// The best of those that a quick zstd likes best, packed by a thorough one.
    WordTable best()
    {
        WordTable* best = nullptr;
        for (Attempt& attempt : kept_) {
            attempt.table.bytes = squeeze(std::move(attempt.bytes));
            if (best == nullptr || attempt.table.bytes.data.size() < best->bytes.data.size()) best = &attempt.table;
        }
        return std::move(*best);
    }

private:
    void try_layouts(Prediction prediction, const Words& words)
    {
        for (const bool planes : {false, true}) {
            Attempt attempt;
            attempt.table.mapping = mapping_;
            attempt.table.scale = scale_;
            attempt.table.prediction = prediction;
            attempt.table.planes = planes;
            attempt.bytes = bytes_in(words, shape_, planes);
            attempt.size = squeeze(attempt.bytes, quick_level).data.size();
            keep(std::move(attempt));
        }
    }
    void keep(Attempt attempt)
    {
        const auto at =
            std::find_if(kept_.begin(), kept_.end(), [&](const Attempt& other) { return attempt.size < other.size; });
        kept_.insert(at, std::move(attempt));
        if (kept_.size() > most_kept) kept_.pop_back();
    }

    static constexpr int quick_level = 9;
    static constexpr std::size_t most_kept = 3;
    WordShape shape_;
    WordContext context_;
    Mapping mapping_ = Mapping::bits;
    double scale_ = 1.0;
    std::vector<Attempt> kept_; ///< smallest first
};

} // namespace

WordTable pack_words(std::span<const std::uint32_t> words, const WordShape& shape, const WordContext& context)
{
    require(words.size() == shape.words() && shape.count < nothing / shape.components, "the words fit their shape");
    Search search(shape, context);
    search.try_mapping(words, Mapping::bits, 1.0);
    if (context.floats) {
        search.try_mapping(words, Mapping::ordered, 1.0);
        if (const double scale = scale_of(words); scale != 0.0) search.try_mapping(words, Mapping::scaled, scale);
    }
    return search.best();
}

} // namespace meshreel::container
