/// The golden files: what each is made of, and with which options. One row a file.
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "meshreel/mesh/shapes.h"
#include "meshreel/mesh/test_shapes.h"
#include "meshreel/meshreel.h"

namespace meshreel::golden {

/// Made anew only where the file is missing and MESHREEL_UPDATE is set: an encoder may become better, old files stay.
struct Golden {
    std::string name; ///< tests/golden/<name>.reel and .json
    std::function<Animation()> make;
    EncodeOptions options = {};
    std::string base = {}; ///< the golden file whose V and triangles are the base mesh's
    /// Changes the file that the encoder made: for what only its search would choose.
    std::function<Bytes(const Animation&, const Bytes&)> change = {};

    std::string file() const { return "tests/golden/" + name + ".reel"; }
    std::string meaning_file() const { return "tests/golden/" + name + ".json"; }
    friend std::ostream& operator<<(std::ostream& out, const Golden& golden) { return out << golden.name; }
};

inline Animation shape(const char* name, std::uint32_t vertices, std::uint32_t frames)
{
    return *shapes::generate(*shapes::find(name), {.vertices = vertices, .frames = frames});
}

inline Animation cloth()
{
    return shape("cloth", 150, 16);
}

/// Decimals of a text, in other units.
inline Animation text_cloth()
{
    Animation animation = cloth();
    for (float& x : animation.positions) x = 1.7f * std::round(1e4f * x) / 1e4f;
    return animation;
}

template <class Number>
Attribute table(const char* name, Domain domain, Scalar type, const std::vector<Number>& numbers)
{
    Attribute a{name, domain, type, 1, false, {}, {}};
    for (const Number number : numbers) {
        std::array<std::uint8_t, sizeof number> bytes{};
        std::uint32_t word = 0;
        if constexpr (sizeof number == 4)
            word = std::bit_cast<std::uint32_t>(number);
        else
            word = static_cast<std::uint32_t>(number);
        for (std::size_t b = 0; b < bytes.size(); ++b) bytes[b] = static_cast<std::uint8_t>(word >> (8 * b));
        a.values.insert(a.values.end(), bytes.begin(), bytes.end());
    }
    return a;
}

/// Every domain and type, with and without indices, repeated values, NaN, -0 and elements without a value.
Animation dressed();

inline EncodeOptions with_step(const char* codec, Order order = Order::keep)
{
    EncodeOptions options;
    options.codec = codec;
    options.order = order;
    if (options.codec != "lossless") options.quality.max_error_relative = 0.5;
    return options;
}

/// All files.
std::vector<Golden> all();

} // namespace meshreel::golden
