/// Stripes of colour, ticks, and letters whose strokes are narrow rectangles.
// SPDX-License-Identifier: MIT
#include "cli/pictures/colour_bar_mesh.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "cli/pictures/lettering.h"

namespace meshreel::cli {

namespace {

using BarPoint = std::array<double, 2>;

class BarBuilder {
public:
    BarBuilder(BarPoint origin, double unit, double depth) : origin_(origin), unit_(unit), depth_(depth) {}

    /// Four corners in order, in units from the origin, with their colours.
    void quad(const std::array<BarPoint, 4>& corners, const Colour& lower, const Colour& upper)
    {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size() / 3);
        for (std::size_t i = 0; i < 4; ++i) {
            for (std::size_t c = 0; c < 2; ++c)
                mesh.positions.push_back(static_cast<float>(origin_[c] + unit_ * corners[i][c]));
            mesh.positions.push_back(static_cast<float>(depth_));
            for (float channel : i < 2 ? lower : upper)
                mesh.colours.push_back(static_cast<std::uint16_t>(std::lround(65535.0f * channel)));
            mesh.colours.push_back(65535);
        }
        for (std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(first + corner);
    }

    void text(BarPoint at, double size, std::string_view words)
    {
        for (const Stroke& stroke : strokes_of(words))
            for (std::size_t i = 0; i + 1 < stroke.size() || i == 0; ++i)
                line(place(at, size, stroke[i]), place(at, size, stroke[std::min(i + 1, stroke.size() - 1)]), size);
    }

    ColourBarMesh mesh;

private:
    static BarPoint place(BarPoint at, double size, const BarPoint& p)
    {
        return {at[0] + size * p[0], at[1] + size * p[1]};
    }

    void line(const BarPoint& a, const BarPoint& b, double size)
    {
        const double half = 0.07 * size, length = std::hypot(b[0] - a[0], b[1] - a[1]);
        const double x = length > 0.0 ? half * (b[0] - a[0]) / length : half;
        const double y = length > 0.0 ? half * (b[1] - a[1]) / length : 0.0;
        quad({BarPoint{a[0] - x + y, a[1] - y - x}, BarPoint{b[0] + x + y, b[1] + y - x},
              BarPoint{b[0] + x - y, b[1] + y + x}, BarPoint{a[0] - x - y, a[1] - y + x}},
             grey_, grey_);
    }

    BarPoint origin_;
    double unit_, depth_;
    const Colour grey_ = colour_of("#808894"); ///< seen on white and on black
};

} // namespace

ColourBarMesh colour_bar_mesh(const Bounds3& body, const Scale& scale, const ColourBarWords& words)
{
    constexpr int stripes = 36;
    constexpr double wide = 0.05, letter = 0.028; // of the bar's height
    std::array<double, 3> size{};
    for (std::size_t c = 0; c < 3; ++c) size[c] = std::max(0.0, body.high[c] - body.low[c]);
    const double extent = std::max({size[1], 0.5 * size[0], 0.5 * size[2]});
    const double unit = extent > 0.0 ? 0.8 * extent : 1.0;
    BarBuilder bar({body.high[0] + 0.15 * unit, 0.5 * (body.low[1] + body.high[1]) - 0.5 * unit}, unit,
                   0.5 * (body.low[2] + body.high[2]));
    for (int i = 0; i < stripes; ++i) {
        const double y0 = static_cast<double>(i) / stripes, y1 = static_cast<double>(i + 1) / stripes;
        bar.quad({BarPoint{0, y0}, BarPoint{wide, y0}, BarPoint{wide, y1}, BarPoint{0, y1}}, viridis(y0), viridis(y1));
    }
    for (int i = 0; i <= scale.parts; ++i) {
        const double y = static_cast<double>(i) / scale.parts;
        bar.text({wide + 0.5 * letter, y - 0.5 * letter}, letter, "-");
        bar.text({wide + 1.4 * letter, y - 0.5 * letter}, letter, short_number(scale.tick(i)));
    }
    bar.text({0.0, 1.0 + 2.0 * letter}, letter, words.unit);
    bar.text({0.0, 1.0 + 4.0 * letter}, letter, words.of);
    bar.text({0.0, 1.0 + 6.2 * letter}, 1.2 * letter, words.title);
    return std::move(bar.mesh);
}

} // namespace meshreel::cli
