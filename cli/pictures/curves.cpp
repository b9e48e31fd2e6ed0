/// Axes with round ticks, lines, marks and captions of small multiples.
// SPDX-License-Identifier: MIT
#include "cli/pictures/curves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "cli/pictures/colour_map.h"
#include "cli/pictures/svg.h"

namespace meshreel::cli {

namespace {

constexpr double panel_wide = 420.0, panel_high = 150.0;       ///< the field that a curve is drawn in, pixels
constexpr double pad_left = 74.0, pad_right = 24.0;            ///< beside it: the numbers of the axis
constexpr double pad_top = 58.0, pad_bottom = 44.0;            ///< above: title and values; below: times
constexpr double page_edge = 14.0, page_head = 46.0;           ///< around all, pixels
constexpr std::size_t most_tips = 600, most_points = 2 * 1200; ///< of a curve, before it is thinned

/// A part of the numbers with round ends, and how far its ticks are apart.
struct Axis1D {
    double low = 0.0, high = 1.0, step = 0.2;

    double share(double value) const { return std::clamp((value - low) / (high - low), 0.0, 1.0); }
    int ticks() const { return static_cast<int>(std::lround((high - low) / step)); }
};

/// The round number 1, 2, 2.5 or 5 x 10^n nearest above span / parts.
double round_step(double span, double parts)
{
    const double wanted = span / parts, decade = std::pow(10.0, std::floor(std::log10(wanted)));
    for (double step : {1.0, 2.0, 2.5, 5.0})
        if (step * decade >= wanted * (1.0 - 1e-9)) return step * decade;
    return 10.0 * decade;
}

/// From 0 where values are errors or near 0, else around them. Values that are not finite are not seen.
Axis1D value_axis(const Curve& curve)
{
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (double value : curve.values) {
        if (!std::isfinite(value)) continue;
        low = std::min(low, value);
        high = std::max(high, value);
    }
    if (std::isfinite(curve.overall)) {
        low = std::min(low, curve.overall);
        high = std::max(high, curve.overall);
    }
    if (!(low <= high)) return {};
    if (low >= 0.0 && (!curve.more_is_better || low < 0.4 * high)) low = 0.0;
    if (!(high - low > 1e-12 * std::max(std::abs(low), std::abs(high)))) high = low + (low > 0.0 ? 0.1 * low : 1.0);
    const double step = round_step(high - low, 4.0);
    return {std::floor(low / step + 1e-9) * step, std::ceil(high / step - 1e-9) * step, step};
}

/// Numbers of an axis have all as many digits as its step needs.
std::string tick_text(double value, double step)
{
    if (step < 1e-4 || std::abs(value) >= 1e6) return value == 0.0 ? "0" : fmt::format("{:.3g}", value);
    const double leading = std::log10(step);
    int digits = std::max(0, static_cast<int>(std::ceil(-leading - 1e-9)));
    if (std::abs(step * std::pow(10.0, digits) - std::round(step * std::pow(10.0, digits))) > 1e-6) ++digits;
    return fmt::format("{:.{}f}", std::abs(value) < 1e-9 * step ? 0.0 : value, digits);
}

/// A value with its unit, four digits.
std::string with_unit(double value, const std::string& unit)
{
    const std::string number = std::isfinite(value) ? fmt::format("{:.4g}", value) : value > 0 ? "∞" : "–∞";
    return unit.empty() ? number : number + " " + unit;
}

/// The SVG while it grows.
class CurvePage {
public:
    CurvePage(std::span<const Curve> curves, std::span<const double> times) : curves_(curves), times_(times) {}

    std::string draw(const std::string& title)
    {
        columns_ = curves_.size() > 1 ? 2 : 1;
        const double rows = std::ceil(static_cast<double>(curves_.size()) / static_cast<double>(columns_));
        begin(2 * page_edge + static_cast<double>(columns_) * (pad_left + panel_wide + pad_right),
              page_head + rows * (pad_top + panel_high + pad_bottom) + page_edge);
        text(page_edge + 8, 32, "head", title);
        for (std::size_t i = 0; i < curves_.size(); ++i) {
            x_ = page_edge + static_cast<double>(i % columns_) * (pad_left + panel_wide + pad_right) + pad_left;
            y_ = page_head + static_cast<double>(i / columns_) * (pad_top + panel_high + pad_bottom) + pad_top;
            panel(curves_[i]);
        }
        return svg_ + "</svg>\n";
    }

private:
    void begin(double wide, double high)
    {
        svg_ = fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
                           "viewBox=\"0 0 {0:.0f} {1:.0f}\">\n",
                           wide, high);
        svg_ +=
            "<style>\n"
            "svg{--page:#fff;--ink:#22262b;--soft:#5b636d;--grid:#e3e7eb;--line:#2f6f9f;--area:#2f6f9f22;--mark:#"
            "c2410c}\n"
            "@media(prefers-color-scheme:dark){svg{--page:#16191d;--ink:#e8eaed;--soft:#9aa3ad;--grid:#2a3037;"
            "--line:#7cc4f2;--area:#7cc4f222;--mark:#ff9a62}}\n"
            "text{font-family:system-ui,'DejaVu Sans',sans-serif;fill:var(--ink);font-size:12px}\n"
            ".page{fill:var(--page)}.head{font-size:18px;font-weight:600}.name{font-size:14px;font-weight:600}\n"
            ".soft{fill:var(--soft)}.end{fill:var(--soft);text-anchor:end}.mid{fill:var(--soft);text-anchor:middle}\n"
            ".grid{stroke:var(--grid);stroke-width:1}.curve{fill:none;stroke:var(--line);stroke-width:1.8;"
            "stroke-linejoin:round}.area{fill:var(--area)}\n"
            ".whole{stroke:var(--soft);stroke-width:1;stroke-dasharray:4 4}.mark{fill:var(--mark);stroke:var(--page);"
            "stroke-width:1.5}.worst{fill:var(--mark)}.tip{fill:transparent}.tip:hover{fill:var(--area)}\n"
            "</style>\n<rect class=\"page\" width=\"100%\" height=\"100%\"/>\n";
    }

    void text(double x, double y, const char* style, const std::string& words)
    {
        svg_ += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" class=\"{}\">{}</text>\n", x, y, style, escaped(words));
    }

    void line(double x0, double y0, std::array<double, 2> to, const char* style)
    {
        svg_ += fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" class=\"{}\"/>\n", x0, y0,
                            to[0], to[1], style);
    }

    void panel(const Curve& curve)
    {
        axis_ = value_axis(curve);
        text(x_, y_ - 30, "name", curve.unit.empty() ? curve.title : fmt::format("{}, {}", curve.title, curve.unit));
        text(x_, y_ - 12, "soft", "all frames: " + with_unit(curve.overall, curve.unit));
        value_grid();
        time_grid();
        if (std::isfinite(curve.overall))
            line(x_, y_of(curve.overall), {x_ + panel_wide, y_of(curve.overall)}, "whole");
        draw_curve(curve);
        mark_worst(curve);
        if (curve.values.size() <= most_tips) tips(curve);
    }

    void value_grid()
    {
        for (int i = 0; i <= axis_.ticks(); ++i) {
            const double value = axis_.low + i * axis_.step;
            line(x_, y_of(value), {x_ + panel_wide, y_of(value)}, "grid");
            text(x_ - 8, y_of(value) + 4, "end", tick_text(value, axis_.step));
        }
    }

    /// Round seconds, and below them the first and the last frame.
    void time_grid()
    {
        const double span = times_.back() - times_.front();
        if (span > 0.0) {
            const double step = round_step(span, 5.0);
            for (double t = std::ceil(times_.front() / step - 1e-9) * step; t <= times_.back() + 1e-9 * span;
                 t += step) {
                const double x = x_ + panel_wide * (t - times_.front()) / span;
                line(x, y_ + panel_high, {x, y_ + panel_high + 4}, "grid");
                text(x, y_ + panel_high + 18, "mid", tick_text(t, step));
            }
        }
        const std::string frames = times_.size() == 1 ? "frame 0" : fmt::format("frames 0 to {}", times_.size() - 1);
        text(x_ + 0.5 * panel_wide, y_ + panel_high + 35, "mid", "time, s  (" + frames + ")");
    }

    double x_of(std::size_t f) const
    {
        const double span = times_.back() - times_.front();
        return x_ + panel_wide * (span > 0.0 ? (times_[f] - times_.front()) / span : 0.5);
    }

    double y_of(double value) const
    {
        const double share = std::isnan(value) ? 0.0 : value > 0.0 && std::isinf(value) ? 1.0 : axis_.share(value);
        return y_ + panel_high * (1.0 - share);
    }

    /// Of a very long curve, the smallest and the largest of every run of frames: no peak is lost.
    std::vector<std::size_t> drawn_frames(const std::vector<double>& values) const
    {
        const std::size_t run = (2 * values.size() + most_points - 1) / most_points;
        std::vector<std::size_t> frames;
        for (std::size_t begin = 0; begin < values.size(); begin += run) {
            const auto first = values.begin() + static_cast<std::ptrdiff_t>(begin);
            const auto last = first + static_cast<std::ptrdiff_t>(std::min(run, values.size() - begin));
            const auto [low, high] = std::minmax_element(first, last);
            const auto a = static_cast<std::size_t>(low - values.begin()),
                       b = static_cast<std::size_t>(high - values.begin());
            frames.push_back(std::min(a, b));
            if (a != b) frames.push_back(std::max(a, b));
        }
        return frames;
    }

    void draw_curve(const Curve& curve)
    {
        std::string points;
        const std::vector<std::size_t> frames = drawn_frames(curve.values);
        for (std::size_t f : frames) points += fmt::format(" {:.1f},{:.1f}", x_of(f), y_of(curve.values[f]));
        const double base = y_ + panel_high;
        if (frames.size() > 1) {
            svg_ += fmt::format("<polygon class=\"area\" points=\"{:.1f},{:.1f}{} {:.1f},{:.1f}\"/>\n",
                                x_of(frames.front()), base, points, x_of(frames.back()), base);
            svg_ += fmt::format("<polyline class=\"curve\" points=\"{}\"/>\n", points.substr(1));
        }
    }

    void mark_worst(const Curve& curve)
    {
        const auto worst = curve.more_is_better ? std::min_element(curve.values.begin(), curve.values.end())
                                                : std::max_element(curve.values.begin(), curve.values.end());
        const auto f = static_cast<std::size_t>(worst - curve.values.begin());
        svg_ += fmt::format("<circle class=\"mark\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4.5\"/>\n", x_of(f), y_of(*worst));
        svg_ += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" class=\"worst\" text-anchor=\"end\">{}</text>\n",
                            x_ + panel_wide, y_ - 12,
                            escaped(fmt::format("worst: {} in frame {}", with_unit(*worst, ""), f)));
    }

    /// One upright stripe a frame, which shows the frame's value under the pointer.
    void tips(const Curve& curve)
    {
        for (std::size_t f = 0; f < curve.values.size(); ++f) {
            const double left = f > 0 ? 0.5 * (x_of(f - 1) + x_of(f)) : x_;
            const double right = f + 1 < curve.values.size() ? 0.5 * (x_of(f) + x_of(f + 1)) : x_ + panel_wide;
            svg_ += fmt::format(
                "<rect class=\"tip\" x=\"{:.2f}\" y=\"{:.1f}\" width=\"{:.2f}\" height=\"{:.1f}\"><title>"
                "frame {}, {:.4g} s: {}</title></rect>\n",
                left, y_, right - left, panel_high, f, times_[f], escaped(with_unit(curve.values[f], curve.unit)));
        }
    }

    std::span<const Curve> curves_;
    std::span<const double> times_;
    std::size_t columns_ = 1;
    double x_ = 0.0, y_ = 0.0; ///< upper left of the field of the curve being drawn
    Axis1D axis_;              ///< of that curve
    std::string svg_;
};

} // namespace

std::string curves_svg(std::span<const Curve> curves, std::span<const double> times_s, const std::string& title)
{
    return CurvePage(curves, times_s).draw(title);
}

} // namespace meshreel::cli
