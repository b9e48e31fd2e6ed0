/// Panels in rows of three, under a line that says which colour is which dataset.
// SPDX-License-Identifier: MIT
#include "cli/scatter.h"

#include <algorithm>
#include <array>
#include <string_view>

#include <fmt/format.h>

#include "meshreel/metrics/correlation.h"

namespace meshreel::cli {

namespace {

constexpr double scatter_width = 250, scatter_height = 190, scatter_gap = 46, scatter_top = 50;
constexpr std::size_t scatter_columns = 3;
/// Okabe and Ito's colours, told apart by everyone; from the ninth dataset on they come again.
constexpr std::array<std::string_view, 8> dataset_colours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                             "#e69f00", "#56b4e9", "#7f7f7f", "#000000"};

std::string svg_text(std::string_view text)
{
    std::string safe;
    for (const char c : text)
        safe += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : c == '"' ? "&quot;" : std::string(1, c);
    return safe;
}

/// What an axis spans; never of no length.
struct Span {
    explicit Span(const std::vector<double>& values)
    {
        if (values.empty()) return;
        const auto [least, most] = std::minmax_element(values.begin(), values.end());
        low = *least;
        high = *most;
    }

    /// 0 .. 1 within; the middle where all values are one. Halves first: the difference of finite numbers may be infinite.
    double share(double value) const { return high > low ? (0.5 * value - 0.5 * low) / (0.5 * high - 0.5 * low) : 0.5; }

    double low = 0.0, high = 0.0;
};

class ScatterPicture {
public:
    explicit ScatterPicture(const io::Scores& scores) : scores_(scores)
    {
        const std::size_t rows = (scores.measures.size() + scatter_columns - 1) / scatter_columns;
        const double width = scatter_gap + scatter_columns * (scatter_width + scatter_gap);
        const double height = scatter_top + static_cast<double>(rows) * (scatter_height + 2 * scatter_gap);
        svg_ =
            fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 "
                        "{0:.0f} {1:.0f}\" font-family=\"sans-serif\" font-size=\"12\" fill=\"#333\">\n"
                        "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
                        width, height);
    }

    std::string draw()
    {
        legend();
        for (std::size_t m = 0; m < scores_.measures.size(); ++m) panel(m);
        return svg_ + "</svg>\n";
    }

private:
    void text(double x, double y, std::string_view what, std::string_view anchor = "start")
    {
        svg_ +=
            fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", x, y, anchor, svg_text(what));
    }
    void point(double x, double y, std::size_t dataset, std::string_view name)
    {
        svg_ += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\" fill=\"{}\" fill-opacity=\"0.8\"><title>{}"
                            "</title></circle>\n",
                            x, y, dataset_colours[dataset % dataset_colours.size()], svg_text(name));
    }

    void legend()
    {
        double x = scatter_gap;
        for (std::size_t d = 0; d < scores_.datasets.size() && !scores_.datasets[d].empty(); ++d) {
            point(x, 20, d, scores_.datasets[d]);
            text(x + 10, 24, scores_.datasets[d]);
            x += 34 + 7.0 * static_cast<double>(scores_.datasets[d].size());
        }
    }

    void panel(std::size_t m)
    {
        const io::ScoredMeasure& measure = scores_.measures[m];
        const double left = scatter_gap + static_cast<double>(m % scatter_columns) * (scatter_width + scatter_gap);
        const double top = scatter_top + static_cast<double>(m / scatter_columns) * (scatter_height + 2 * scatter_gap);
        std::vector<double> values, marks;
        for (std::size_t i = 0; i < scores_.stimuli.size(); ++i) {
            if (!measure.values[i]) continue;
            values.push_back(*measure.values[i]);
            marks.push_back(scores_.stimuli[i].mos);
        }
        const Span across(values), up(marks);
        frame(left, top, across, up);
        const metrics::Correlation r = metrics::pearson(values, marks);
        text(left, top - 8, r.value ? fmt::format("{}, r = {:.3f}", measure.name, *r.value) : measure.name);
        for (std::size_t i = 0; i < scores_.stimuli.size(); ++i)
            if (measure.values[i])
                point(left + 8 + across.share(*measure.values[i]) * (scatter_width - 16),
                      top + scatter_height - 8 - up.share(scores_.stimuli[i].mos) * (scatter_height - 16),
                      scores_.stimuli[i].dataset, scores_.stimuli[i].name);
    }

    void frame(double left, double top, const Span& across, const Span& up)
    {
        svg_ += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.0f}\" height=\"{:.0f}\" fill=\"none\" "
                            "stroke=\"#999\"/>\n",
                            left, top, scatter_width, scatter_height);
        text(left + 8, top + scatter_height + 16, fmt::format("{:.4g}", across.low));
        text(left + scatter_width - 8, top + scatter_height + 16, fmt::format("{:.4g}", across.high), "end");
        text(left - 4, top + scatter_height - 4, fmt::format("{:.3g}", up.low), "end");
        text(left - 4, top + 12, fmt::format("{:.3g}", up.high), "end");
        text(left - 4, top + 0.5 * scatter_height, scores_.mos_name, "end");
    }

    const io::Scores& scores_;
    std::string svg_;
};

} // namespace

std::string scatter_picture(const io::Scores& scores)
{
    return ScatterPicture(scores).draw();
}

} // namespace meshreel::cli
