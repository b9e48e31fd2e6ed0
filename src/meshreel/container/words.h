/// Tables of small integers and floats, predicted, split into byte planes and packed; bit for bit.
// SPDX-License-Identifier: MIT
//
//    numbers --mapping--> words --prediction--> residuals --layout--> bytes --squeeze--> data
//
// The encoder tries the ways that make sense and keeps the smallest; each is exact.
#pragma once

#include <vector>

#include "meshreel/container/squeeze.h"
#include "meshreel/mesh/animation.h"

namespace meshreel::container {

/// The shape of a table: `count` entries of `components` words of `width` bytes.
struct WordShape {
    std::uint64_t count = 0;
    std::uint32_t components = 1;
    std::uint32_t width = 4; ///< 1, 2 or 4

    std::uint64_t words() const { return count * components; }
};

/// How a table was coded.
struct WordTable {
    enum class Mapping : std::uint8_t { bits, ordered, scaled } mapping = Mapping::bits;
    enum class Prediction : std::uint8_t { none, previous, mesh, corner, fresh } prediction = Prediction::none;
    double scale = 1.0;
    bool planes = false;
    Squeezed bytes;

    void fields(auto& io)
    {
        io.choice(
            "mapping", mapping, {"bits", "ordered", "scaled"},
            "word of a number: its bits; a float's bits in the order of the floats; a float's multiple of 1 / scale");
        io.when(mapping == Mapping::scaled, "mapping = scaled", [&] {
            io.f64("scale", scale, {1.0, 0x1.0p40},
                   "of signed word n the float is n / scale, and -(-1 - n) / scale where n < 0; f64, then f32");
        });
        io.choice("prediction", prediction, {"none", "previous", "mesh", "corner", "fresh"},
                  "what a word is a residual of: nothing; the entry before; a parallelogram; the vertex' last index; "
                  "the highest so far + 1");
        io.flag("planes", planes, "bytes of equal weight stand together, one component after the other");
        io.part("bytes", bytes);
    }
};

/// What both sides know when a table is coded.
struct WordContext {
    const std::vector<Triangle>* faces = nullptr; ///< for mesh: entries that form a triangle, in the order of the mesh
    const std::vector<Triangle>* corners = nullptr; ///< for corner: the vertices; a table of 3T indices, a corner each
    std::uint64_t vertex_count = 0;                 ///< for corner: above every vertex in `corners`
    bool floats = false;                            ///< the words are the bits of floats
};

/// Packs a table the smallest way found. `words` hold the lowest 8 * width bits each, entry after entry. Encoder side.
WordTable pack_words(std::span<const std::uint32_t> words, const WordShape& shape, const WordContext& context = {});

/// The table again. @fails bad_input: a field or a size is wrong, or beyond the budget.
Result<std::vector<std::uint32_t>> unpack_words(const WordTable& table, const WordShape& shape,
                                                const WordContext& context, Budget& budget);

} // namespace meshreel::container
