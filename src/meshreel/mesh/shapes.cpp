/// The table of generated shapes.
// SPDX-License-Identifier: MIT
#include "meshreel/mesh/shapes.h"

#include <algorithm>
#include <array>

#include "meshreel/base/text.h"
#include "meshreel/mesh/shapes/makers.h"

namespace meshreel::shapes {

namespace {

constexpr std::array table{
    Shape{"cloth", "a cloth falling on a ball, a ring and the ground (position-based dynamics)", 4, cloth},
    Shape{"jelly", "a soft cube that falls, bounces and wobbles (elastic lattice)", 8, jelly},
    Shape{"swimmer", "a swimming fish: waves run down its body", 8, swimmer},
    Shape{"snake", "a snake crawling along its own track", 8, snake},
    Shape{"walker", "a walking human figure, skinned over thirteen bones", 64, walker},
    Shape{"wave", "a standing wave on a sheet: exactly rank 1", 4, wave},
};

Error misuse(std::string message, std::string field)
{
    return {ErrorCode::usage, std::move(message), std::move(field), {}, {}};
}

} // namespace

std::span<const Shape> all()
{
    return table;
}

const Shape* find(std::string_view name)
{
    const auto found = std::find_if(table.begin(), table.end(), [&](const Shape& shape) { return shape.name == name; });
    return found == table.end() ? nullptr : &*found;
}

Result<Animation> generate(const Shape& shape, const ShapeOptions& options)
{
    constexpr std::uint64_t max_numbers = 1ull << 31;
    if (options.vertices < shape.minimum_vertices)
        return misuse(concat(shape.name, " needs at least ", shape.minimum_vertices, " vertices"), "vertices");
    if (options.frames < 1) return misuse("at least one frame is needed", "frames");
    if (std::uint64_t{options.vertices} * options.frames > max_numbers / 3)
        return misuse(concat(options.frames, " frames of ", options.vertices, " vertices are more than 2^31 numbers"),
                      "frames");
    if (!(options.fps > 0.0 && options.fps <= 1e6))
        return misuse("frames a second must be above 0 and at most 1000000", "fps");
    return shape.make(options);
}

} // namespace meshreel::shapes
