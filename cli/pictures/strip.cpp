/// Lays out the panels, captions and the colour bar of a turntable strip.
// SPDX-License-Identifier: MIT
#include "cli/pictures/strip.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "cli/pictures/colour_map.h"
#include "cli/pictures/lettering.h"
#include "cli/report.h"

namespace meshreel::cli {

namespace {

constexpr std::size_t strip_oversampling = 3;
constexpr double strip_left = 128.0, strip_top = 92.0, strip_gap = 10.0, strip_foot = 84.0; ///< pixels

/// A frame's positions that stay when another is asked for.
Result<std::vector<float>> held_frame(FrameSource& source, std::size_t frame)
{
    Matrix<float> room;
    MESHREEL_TRY(const MatrixView<const float> frames, source.frames(frame, 1, room));
    return std::vector<float>(frames.row(0).begin(), frames.row(0).end());
}

class Strip {
public:
    Strip(const Surfaces& surfaces, const StripOptions& options) : surfaces_(surfaces), options_(options) {}

    Result<Bytes> draw()
    {
        MESHREEL_CHECK(fetch());
        lay_out();
        for (std::size_t column = 0; column < options_.views; ++column) draw_column(column);
        draw_captions();
        draw_scale();
        return png(image_);
    }

private:
    static constexpr std::size_t rows = 3;

    Status fetch()
    {
        const auto last = [](const FrameSource& source, std::size_t f) {
            return std::min(f, source.frame_count() - 1);
        };
        for (std::size_t f : options_.frames) {
            MESHREEL_TRY(std::vector<float> before, held_frame(*surfaces_.original, last(*surfaces_.original, f)));
            MESHREEL_TRY(std::vector<float> after, held_frame(*surfaces_.distorted, last(*surfaces_.distorted, f)));
            original_.push_back(std::move(before));
            distorted_.push_back(std::move(after));
        }
        return Ok{};
    }

    void lay_out()
    {
        std::vector<std::vector<Pose>> poses;
        for (std::size_t i = 0; i < options_.views; ++i) poses.push_back({original_[i], distorted_[i]});
        cameras_ = turntable(poses, {surfaces_.upright(), 0.0, options_.panel_width * strip_oversampling});
        panel_height_ = static_cast<double>(cameras_[0].height / strip_oversampling);
        const double wide = std::max(480.0, strip_left + static_cast<double>(options_.views) * column_step() + 8.0);
        const double high = strip_top + rows * (panel_height_ + strip_gap) + strip_foot;
        image_ = Image(static_cast<std::size_t>(wide), static_cast<std::size_t>(high));
        fill(image_, {0, 0, wide, high}, colour_of("#ffffff"));
        std::vector<double> tops;
        for (std::size_t f : options_.frames) tops.push_back(static_cast<double>(surfaces_.heat->tops()[f]));
        scale_ = surfaces_.scale_for(tops);
    }

    double column_step() const { return static_cast<double>(options_.panel_width) + strip_gap; }
    double column_left(std::size_t column) const { return strip_left + static_cast<double>(column) * column_step(); }
    double row_top(std::size_t row) const { return strip_top + static_cast<double>(row) * (panel_height_ + strip_gap); }

    void draw_column(std::size_t column)
    {
        const double turn = 360.0 * static_cast<double>(column) / static_cast<double>(options_.views);
        const std::size_t f = options_.frames[column];
        write(image_, {column_left(column) + 0.5 * static_cast<double>(options_.panel_width), strip_top - 13},
              fmt::format("{:.0f}°  ·  frame {}, {:.2f} s", turn, f, surfaces_.original->still().times_s[f]),
              {9.0, grey_, 0.13, Align::middle});
        draw_clay(column, 0, surfaces_.original->still(), original_[column]);
        draw_clay(column, 1, surfaces_.distorted->still(), distorted_[column]);
        const Animation& still = surfaces_.coloured().still();
        const std::vector<double> errors = surfaces_.heat->values({HeatOf::Kind::frame, f});
        std::vector<Colour> painted(still.vertex_count);
        for (std::size_t v = 0; v < painted.size(); ++v) painted[v] = viridis(scale_.place(errors[v]));
        const std::vector<float>& pose = surfaces_.on_distorted() ? distorted_[column] : original_[column];
        draw_panel(column, 2, {still.triangles, pose, painted, 0.45});
    }

    void draw_clay(std::size_t column, std::size_t row, const Animation& still, Pose pose)
    {
        const std::vector<Colour> clay(still.vertex_count, colour_of("#cdb99c"));
        draw_panel(column, row, {still.triangles, pose, clay});
    }

    void draw_panel(std::size_t column, std::size_t row, const Scene& scene)
    {
        fill(image_, {column_left(column), row_top(row), static_cast<double>(options_.panel_width), panel_height_},
             colour_of("#eef1f4"), 6.0);
        paste(image_, shrink(render(scene, cameras_[column]), strip_oversampling),
              static_cast<std::size_t>(column_left(column)), static_cast<std::size_t>(row_top(row)));
    }

    void draw_captions()
    {
        const Heat& heat = *surfaces_.heat;
        const std::string unit = heat.label().unit.empty() ? "" : " " + heat.label().unit;
        const std::string remark =
            heat.largest() > 0.0
                ? fmt::format("largest of {} {}{}, in frame {}", counted(heat.frame_count(), "frame", "frames"),
                              short_number(heat.largest()), unit, heat.worst_frame())
                : fmt::format("no error in {}", counted(heat.frame_count(), "frame", "frames"));
        write(image_, {18, 40}, heat.label().title, {13.0, black_, 0.16});
        write(image_, {30 + 13.0 * text_width(heat.label().title), 40}, remark, {9.0, grey_});
        constexpr std::array names{"original", "distorted", "error"};
        for (std::size_t row = 0; row < rows; ++row)
            write(image_, {18, row_top(row) + 0.5 * panel_height_ + 5}, names[row], {11.0, black_, 0.16});
    }

    void draw_scale()
    {
        const double y = static_cast<double>(image_.height) - strip_foot + 22;
        const double wide = std::min(480.0, static_cast<double>(image_.width) - strip_left - 60);
        for (double x = 0.0; x < wide; x += 1.0)
            fill(image_, {strip_left + x, y, 1.0, 14.0}, viridis(x / (wide - 1.0)));
        for (int i = 0; i <= scale_.parts; ++i) {
            const double x = strip_left + wide * i / scale_.parts;
            fill(image_, {std::round(x) - (i > 0 ? 1.0 : 0.0), y + 14, 1.0, 5.0}, grey_);
            write(image_, {x, y + 34}, short_number(scale_.tick(i)), {9.0, black_, 0.13, Align::middle});
        }
        write(image_, {strip_left + wide + 24, y + 12}, surfaces_.heat->label().unit, {9.0, black_});
        write(image_, {18, y + 12}, "colour", {11.0, black_, 0.16});
    }

    const Surfaces& surfaces_;
    const StripOptions& options_;
    const Colour black_ = colour_of("#22262b"), grey_ = colour_of("#5b636d");
    std::vector<std::vector<float>> original_, distorted_; ///< of each column
    std::vector<Camera> cameras_;                          ///< of each column
    double panel_height_ = 0.0;                            ///< pixels
    Scale scale_;
    Image image_;
};

} // namespace

Result<Bytes> turntable_strip(const Surfaces& surfaces, const StripOptions& options)
{
    return Strip(surfaces, options).draw();
}

} // namespace meshreel::cli
