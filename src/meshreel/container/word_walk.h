/// The walks over a table that encoder and decoder share: which earlier entries each word is a residual of.
// SPDX-License-Identifier: MIT
#pragma once

#include "meshreel/container/words.h"

namespace meshreel::container {

inline constexpr std::uint32_t nothing = 0xffffffff;

/// [3T] For each corner, the corner across the edge opposite to it, in the latest earlier triangle that has that edge; or
/// nothing. @cost O(T log T)
std::vector<std::uint32_t> earlier_mates(const std::vector<Triangle>& triangles);

/// When an entry of a table is met, and from which earlier entries it is guessed: left + right - opposite, a
/// parallelogram; left alone where `right` is nothing; zero where `left` is nothing.
struct Guess {
    std::uint32_t entry = 0;
    std::uint32_t left = nothing, right = nothing, opposite = nothing;
};

/// [count] All entries in the order in which the faces meet them, then those in no face. A face that names an entry
/// beyond `count` is passed over. @cost O(T log T + count)
std::vector<Guess> mesh_guesses(const std::vector<Triangle>& faces, std::uint32_t count);

/// Signed difference of words of some width, small ones near zero; and back.
inline std::uint32_t fold(std::uint32_t difference, std::uint32_t width)
{
    const std::uint32_t shift = 32 - 8 * width;
    const std::uint32_t high = difference << shift; // sign at the top
    const std::uint32_t sign = high >> 31 ? nothing : 0;
    return (((high << 1) ^ sign) >> shift) & (nothing >> shift);
}
inline std::uint32_t unfold(std::uint32_t folded, std::uint32_t width)
{
    return ((folded >> 1) ^ (0u - (folded & 1))) & (nothing >> (32 - 8 * width));
}

/// Mapping::scaled. The float of a signed word n: n / scale, or -(-1 - n) / scale where n < 0, so that -0.0 has a word.
inline float scaled_float(std::uint32_t word, double scale)
{
    const double magnitude = static_cast<double>(word >> 31 ? ~word : word) / scale;
    return static_cast<float>(word >> 31 ? -magnitude : magnitude);
}

/// Goes through the words of one entry. Writes: residuals from words; otherwise words from residuals.
template <bool Writes>
void walk_entry(const WordShape& shape, const Guess& guess, std::span<std::uint32_t> words, std::uint32_t* residuals)
{
    const std::uint32_t mask = nothing >> (32 - 8 * shape.width);
    for (std::uint32_t c = 0; c < shape.components; ++c) {
        auto word = [&](std::uint32_t entry) -> std::uint32_t& {
            return words[static_cast<std::size_t>(entry) * shape.components + c];
        };
        std::uint32_t guessed = guess.left == nothing ? 0 : word(guess.left);
        if (guess.right != nothing) guessed += word(guess.right) - word(guess.opposite);
        if constexpr (Writes)
            residuals[c] = fold(word(guess.entry) - guessed, shape.width);
        else
            word(guess.entry) = (guessed + unfold(residuals[c], shape.width)) & mask;
    }
}

/// Prediction::previous and Prediction::mesh; residuals stand in the order in which entries are met.
template <bool Writes>
void walk_guesses(const WordShape& shape, const WordContext* mesh, std::span<std::uint32_t> words,
                  std::span<std::uint32_t> residuals)
{
    const std::uint32_t count = static_cast<std::uint32_t>(shape.count);
    std::uint32_t* at = residuals.data();
    if (mesh != nullptr) {
        for (const Guess& guess : mesh_guesses(*mesh->faces, count)) {
            walk_entry<Writes>(shape, guess, words, at);
            at += shape.components;
        }
        return;
    }
    for (std::uint32_t i = 0; i < count; ++i) {
        walk_entry<Writes>(shape, {i, i == 0 ? nothing : i - 1}, words, at);
        at += shape.components;
    }
}

/// Prediction::fresh. Numbers of things met before or for the first time: 0 is the lowest number above all so far, r the
/// number r below it. For entries of one 4-byte word.
template <bool Writes>
void walk_fresh(std::span<std::uint32_t> words, std::span<std::uint32_t> residuals)
{
    std::uint32_t next = 0;
    for (std::size_t i = 0; i < words.size(); ++i) {
        if constexpr (Writes)
            residuals[i] = next - words[i];
        else
            words[i] = next - residuals[i];
        if (words[i] >= next && words[i] != nothing) next = words[i] + 1;
    }
}

/// Prediction::corner. The index of a corner is most often the one that the same vertex has in the triangle across an
/// edge, or had last: residual 0. Else the first one never used: 1. Else 2 + the folded difference to the one before.
class CornerWalk {
public:
    explicit CornerWalk(const WordContext& context)
        : triangles_(*context.corners), mates_(earlier_mates(triangles_)), last_of_(context.vertex_count, unseen)
    {
    }

    template <bool Writes>
    void run(std::span<std::uint32_t> words, std::span<std::uint32_t> residuals)
    {
        for (std::uint32_t c = 0; c < words.size(); ++c) {
            const std::uint64_t expected = expected_at(c, words);
            if constexpr (Writes)
                residuals[c] = residual_of(words[c], expected);
            else
                words[c] = word_of(residuals[c], expected);
            remember(c, words[c]);
        }
    }
    /// Whether every residual fits in 32 bits; else this prediction must not be used.
    bool fits() const { return fits_; }

private:
    static constexpr std::uint64_t unseen = 1ull << 32;

    std::uint64_t expected_at(std::uint32_t corner, std::span<const std::uint32_t> words) const;
    std::uint32_t residual_of(std::uint32_t word, std::uint64_t expected);
    std::uint32_t word_of(std::uint32_t residual, std::uint64_t expected) const;
    void remember(std::uint32_t corner, std::uint32_t word);

    const std::vector<Triangle>& triangles_;
    std::vector<std::uint32_t> mates_;
    std::vector<std::uint64_t> last_of_; ///< [V] last index of each vertex
    std::uint32_t next_ = 0;             ///< the first index never used
    std::uint32_t previous_ = 0;
    bool fits_ = true;
};

} // namespace meshreel::container
