/// Tables back from their bytes.
// SPDX-License-Identifier: MIT
#include "meshreel/base/text.h"
#include "meshreel/container/word_walk.h"

namespace meshreel::container {

namespace {

using Words = std::vector<std::uint32_t>;

/// Words from bytes, interleaved or in planes.
Words words_in(const Bytes& bytes, const WordShape& shape, bool planes)
{
    const std::size_t count = static_cast<std::size_t>(shape.count);
    Words words(static_cast<std::size_t>(shape.words()));
    for (std::size_t i = 0; i < words.size(); ++i)
        for (std::uint32_t b = 0; b < shape.width; ++b) {
            const std::size_t row = i / shape.components, c = i % shape.components;
            const std::size_t at = planes ? (c * shape.width + b) * count + row : i * shape.width + b;
            words[i] |= static_cast<std::uint32_t>(bytes[at]) << (8 * b);
        }
    return words;
}

std::uint32_t bits_of(float value)
{
    std::uint32_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    return bits;
}

void map_back(const WordTable& table, Words& words)
{
    if (table.mapping == WordTable::Mapping::ordered)
        for (std::uint32_t& word : words) word = word >> 31 ? word & 0x7fffffffu : ~word;
    if (table.mapping == WordTable::Mapping::scaled)
        for (std::uint32_t& word : words) word = bits_of(scaled_float(word, table.scale));
}

/// What a walk along the mesh needs while it lasts: sides and mates of triangles, guesses or last indices of entries.
std::uint64_t walk_memory(const WordTable& table, const WordShape& shape, const WordContext& context)
{
    constexpr std::uint64_t a_triangle = 3 * (16 + 4), an_entry = 24;
    if (table.prediction == WordTable::Prediction::mesh)
        return context.faces->size() * a_triangle + shape.count * an_entry;
    if (table.prediction == WordTable::Prediction::corner)
        return context.corners->size() * a_triangle + context.vertex_count * 8;
    return 0;
}

/// Refuses ways of coding that need what this table does not have.
Status check_table(const WordTable& table, const WordShape& shape, const WordContext& context)
{
    using Prediction = WordTable::Prediction;
    if (table.mapping != WordTable::Mapping::bits && !context.floats)
        return bad_input("only floats are mapped", "mapping");
    if (table.prediction == Prediction::mesh && context.faces == nullptr)
        return bad_input("there are no faces to predict from", "prediction");
    const bool corners = context.corners != nullptr && shape.words() == context.corners->size() * 3;
    if (table.prediction == Prediction::corner && !(corners && shape.width == 4))
        return bad_input("not a table of one index a corner", "prediction");
    if (table.prediction == Prediction::fresh && !(shape.components == 1 && shape.width == 4))
        return bad_input("not a table of numbers", "prediction");
    return Ok{};
}

} // namespace

Result<std::vector<std::uint32_t>> unpack_words(const WordTable& table, const WordShape& shape,
                                                const WordContext& context, Budget& budget)
{
    using Prediction = WordTable::Prediction;
    if (shape.count >= nothing / shape.components)
        return bad_input(concat(shape.count, " entries are too many"), "count");
    MESHREEL_CHECK(check_table(table, shape, context));
    MESHREEL_TRY(const Bytes bytes, unsqueeze(table.bytes, shape.words() * shape.width, budget));
    MESHREEL_CHECK(budget.take(shape.words() * 8, "count"));
    MESHREEL_CHECK(budget.lend(walk_memory(table, shape, context), "prediction"));
    Words residuals = words_in(bytes, shape, table.planes);
    if (table.prediction == Prediction::none) {
        map_back(table, residuals);
        return residuals;
    }
    Words words(residuals.size());
    if (table.prediction == Prediction::corner)
        CornerWalk(context).run<false>(words, residuals);
    else if (table.prediction == Prediction::fresh)
        walk_fresh<false>(words, residuals);
    else
        walk_guesses<false>(shape, table.prediction == Prediction::mesh ? &context : nullptr, words, residuals);
    map_back(table, words);
    return words;
}

} // namespace meshreel::container
