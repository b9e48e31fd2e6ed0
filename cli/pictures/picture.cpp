/// Chooses the frames, paints the panels and lays them out as SVG.
// SPDX-License-Identifier: MIT
#include "cli/pictures/picture.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include <fmt/format.h>

#include "cli/pictures/colour_map.h"
#include "cli/pictures/render.h"
#include "cli/pictures/svg.h"

namespace meshreel::cli {

namespace {

constexpr std::size_t oversampling = 3;
constexpr double picture_left = 132, picture_top = 78, picture_gap = 10,
                 scale_height = 74; ///< margins of the layout, pixels

/// Frames in the middle of equal parts of the animation; the first and the last where there are two or more.
std::vector<std::size_t> spread(std::size_t frame_count, std::size_t wanted)
{
    const std::size_t count = std::clamp<std::size_t>(wanted, 1, frame_count);
    std::vector<std::size_t> frames;
    for (std::size_t i = 0; i < count; ++i)
        frames.push_back(count == 1 ? frame_count / 2 : i * (frame_count - 1) / (count - 1));
    return frames;
}

/// Distances between the vertices of one frame in both animations, percent of the body diagonal. [V]
std::vector<double> errors(const Animation& original, const Animation& decoded, std::size_t f)
{
    const double diagonal = body_diagonal(original);
    std::vector<double> percent(original.vertex_count);
    for (std::size_t v = 0; v < percent.size(); ++v) {
        double squared = 0.0;
        for (std::size_t i = 3 * v; i < 3 * v + 3; ++i) {
            const double d = static_cast<double>(decoded.frame(f)[i]) - original.frame(f)[i];
            squared += d * d;
        }
        percent[v] = diagonal > 0.0 ? 100.0 * std::sqrt(squared) / diagonal : 0.0;
    }
    return percent;
}

std::string text_at(double x, double y, const std::string& style, const std::string& text)
{
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" class=\"{}\">{}</text>\n", x, y, style, escaped(text));
}

/// The first line of a row's caption large, the others small below it.
std::string caption(double middle, const std::string& text)
{
    std::string svg;
    double y = middle;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        svg += text_at(18, y, begin == 0 ? "row" : "small", text.substr(begin, end - begin));
        begin = end + 1;
        y += 18;
    }
    return svg;
}

/// The picture while it grows.
class Layout {
public:
    Layout(const Animation& original, const Animation& decoded, const PictureOptions& options)
        : original_(original), decoded_(decoded), options_(options),
          frames_(spread(original.frame_count(), options.frames))
    {
        const Axis up = options.up != Axis::unknown ? options.up : original.meta.up;
        std::vector<Pose> poses;
        for (std::size_t f : frames_) poses.push_back(original.frame(f));
        camera_ = look_at(poses, {up, 0.0, options.panel_width * oversampling});
        panel_height_ = static_cast<double>(camera_.height / oversampling);
        width_ = picture_left + static_cast<double>(frames_.size()) * (column() + picture_gap) + 8.0;
        height_ = picture_top + 3.0 * (panel_height_ + picture_gap) + scale_height;
        for (std::size_t f = 0; f < original.frame_count(); ++f)
            for (double e : errors(original, decoded, f)) largest_ = std::max(largest_, e);
        scale_ = scale_up_to(largest_);
    }

    Result<std::string> draw()
    {
        begin();
        for (std::size_t column = 0; column < frames_.size(); ++column) MESHREEL_CHECK(draw_column(column));
        draw_scale();
        return svg_ + "</svg>\n";
    }

private:
    double column() const { return static_cast<double>(options_.panel_width); }
    double row_top(std::size_t row) const
    {
        return picture_top + static_cast<double>(row) * (panel_height_ + picture_gap);
    }

    void begin()
    {
        svg_ = fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
                           "viewBox=\"0 0 {0:.0f} {1:.0f}\">\n"
                           "<style>text{{font-family:system-ui,'DejaVu Sans',sans-serif;fill:#22262b}}"
                           ".title{{font-size:20px;font-weight:600}}.row{{font-size:16px;font-weight:600}}"
                           ".small{{font-size:13px;fill:#5b636d}}.mid{{font-size:13px;fill:#5b636d;"
                           "text-anchor:middle}}</style>\n<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n",
                           width_, height_);
        svg_ += text_at(18, 34, "title", options_.title);
        svg_ += caption(row_top(0) + 0.5 * panel_height_ - 8, options_.original);
        svg_ += caption(row_top(1) + 0.5 * panel_height_ - 8, options_.decoded);
        svg_ += caption(row_top(2) + 0.5 * panel_height_ - 8, "error\nas colour");
    }

    Status draw_column(std::size_t column_index)
    {
        const std::size_t f = frames_[column_index];
        const double x = picture_left + static_cast<double>(column_index) * (column() + picture_gap);
        svg_ += text_at(x + 0.5 * column(), picture_top - 10, "mid",
                        fmt::format("frame {}, {:.2f} s", f, original_.times_s[f]));
        const std::vector<Colour> clay(original_.vertex_count, colour_of("#cdb99c"));
        MESHREEL_CHECK(draw_panel({original_.triangles, original_.frame(f), clay}, {x, row_top(0)}));
        MESHREEL_CHECK(draw_panel({original_.triangles, decoded_.frame(f), clay}, {x, row_top(1)}));
        std::vector<Colour> painted(original_.vertex_count);
        const std::vector<double> percent = errors(original_, decoded_, f);
        for (std::size_t v = 0; v < painted.size(); ++v) painted[v] = viridis(scale_.place(percent[v]));
        return draw_panel({original_.triangles, decoded_.frame(f), painted, 0.45}, {x, row_top(2)});
    }

    Status draw_panel(const Scene& scene, std::array<double, 2> corner)
    {
        const Image image = shrink(render(scene, camera_), oversampling);
        MESHREEL_TRY(const Bytes file, png(image));
        svg_ += fmt::format("<rect x=\"{0:.1f}\" y=\"{1:.1f}\" width=\"{2:.1f}\" height=\"{3:.1f}\" rx=\"6\" "
                            "fill=\"#eef1f4\"/>\n<image x=\"{0:.1f}\" y=\"{1:.1f}\" width=\"{2:.1f}\" "
                            "height=\"{3:.1f}\" href=\"data:image/png;base64,{4}\"/>\n",
                            corner[0], corner[1], column(), panel_height_, base64(file));
        return Ok{};
    }

    /// A bar from 0 to the top of the scale, with five numbers under it.
    void draw_scale()
    {
        const double y = height_ - scale_height + 14;
        const double wide = std::min(420.0, width_ - picture_left - 26);
        svg_ += "<defs><linearGradient id=\"scale\">";
        for (std::size_t i = 0; i < viridis_colours.size(); ++i)
            svg_ += fmt::format("<stop offset=\"{:.4f}\" stop-color=\"{}\"/>",
                                static_cast<double>(i) / static_cast<double>(viridis_colours.size() - 1),
                                viridis_colours[i]);
        svg_ += fmt::format("</linearGradient></defs>\n<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"14\" "
                            "rx=\"3\" fill=\"url(#scale)\"/>\n",
                            picture_left, y, wide);
        for (int i = 0; i <= scale_.parts; ++i)
            svg_ += text_at(picture_left + wide * i / scale_.parts, y + 32, i == 0 ? "small" : "mid",
                            short_number(scale_.tick(i)));
        svg_ += text_at(18, y + 12, "small", "error, %");
        svg_ += text_at(picture_left, y + 50, "small",
                        fmt::format("distance from the original in percent of the body diagonal; largest of all {} "
                                    "frames: {:.3g} %",
                                    original_.frame_count(), largest_));
    }

    const Animation& original_;
    const Animation& decoded_;
    const PictureOptions& options_;
    std::vector<std::size_t> frames_;
    Camera camera_;
    double panel_height_ = 0.0, width_ = 0.0, height_ = 0.0; ///< pixels
    double largest_ = 0.0;                                   ///< percent of the body diagonal
    Scale scale_;
    std::string svg_;
};

} // namespace

Result<std::string> comparison_picture(const Animation& original, const Animation& decoded,
                                       const PictureOptions& options)
{
    return Layout(original, decoded, options).draw();
}

} // namespace meshreel::cli
