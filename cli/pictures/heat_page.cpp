/// The heat map as a page: what it needs to know as JSON, positions and errors as base 64.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/pictures/colour_bar_mesh.h"
#include "cli/pictures/colour_map.h"
#include "cli/pictures/heat_map.h"
#include "cli/pictures/page.h"
#include "cli/pictures/svg.h"
#include "cli/report.h"

namespace meshreel::cli {

namespace {

/// Which frames a page has, and whether it has both surfaces.
struct PagePlan {
    std::vector<std::size_t> frames; ///< rising
    bool both = false;
    std::uint64_t bytes = 0; ///< about
};

std::uint64_t page_size(const Animation& still, std::size_t frames, bool both)
{
    const std::uint64_t vertex = both ? 13 : 7; // 16 bits a coordinate, 8 an error
    const std::uint64_t curve = still.times_s.size() * 48, page = 32768;
    return (still.triangles.size() * 12 + frames * still.vertex_count * vertex) * 4 / 3 + curve + page;
}

/// Every stride-th frame, and the worst.
std::vector<std::size_t> strided_frames(std::size_t frame_count, std::size_t stride, std::size_t worst)
{
    std::vector<std::size_t> frames;
    for (std::size_t f = 0; f < frame_count; f += stride) frames.push_back(f);
    if (worst % stride != 0) frames.insert(std::upper_bound(frames.begin(), frames.end(), worst), worst);
    return frames;
}

/// Both surfaces where all frames of both fit; else every frame of one, every second, every third, ...; at least the
/// worst.
PagePlan plan_page(const Surfaces& surfaces, std::uint64_t limit)
{
    const Animation& still = surfaces.coloured().still();
    const std::size_t F = still.times_s.size(), worst = surfaces.heat->worst_frame();
    PagePlan plan;
    plan.both = surfaces.on_distorted() && page_size(still, F, true) <= limit;
    for (std::size_t stride = 1; stride <= F; ++stride) {
        plan.frames = strided_frames(F, stride, worst);
        plan.bytes = page_size(still, plan.frames.size(), plan.both);
        if (plan.bytes <= limit) return plan;
    }
    plan.frames = {worst};
    plan.bytes = page_size(still, 1, false);
    return plan;
}

class HeatPage {
public:
    HeatPage(const Surfaces& surfaces, const HeatMapOptions& options)
        : surfaces_(surfaces), options_(options), source_(surfaces.coloured()),
          other_(surfaces.on_distorted() ? *surfaces.original : *surfaces.distorted),
          plan_(plan_page(surfaces, options.page_bytes))
    {
    }

    Result<Bytes> write()
    {
        MESHREEL_CHECK(measure_bounds(source_));
        if (plan_.both) MESHREEL_CHECK(measure_bounds(other_));
        MESHREEL_TRY(const Bytes positions, quantised(source_));
        Bytes others;
        if (plan_.both) {
            MESHREEL_TRY(others, quantised(other_));
        }
        const std::string title = surfaces_.heat->label().title;
        text_ = fmt::format(
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
            "content=\"width=device-width, initial-scale=1\">\n<title>{}: {}</title>\n<style>\n",
            escaped(options_.distorted), escaped(title));
        text_.append(page_style).append("</style>\n</head>\n<body>\n").append(page_body);
        add_data("meta", "application/json", meta());
        add_data("triangles", "text/plain", base64(triangle_bytes()));
        add_data("errors", "text/plain", base64(levels()));
        add_data("positions", "text/plain", base64(positions));
        if (plan_.both) add_data("others", "text/plain", base64(others));
        text_.append("<script>\n").append(page_script).append("</script>\n</body>\n</html>\n");
        return Bytes(text_.begin(), text_.end());
    }

private:
    void add_data(const char* id, const char* type, const std::string& data)
    {
        text_.append(fmt::format("<script id=\"{}\" type=\"{}\">", id, type)).append(data).append("</script>\n");
    }

    /// Calls body(positions) for each frame that the page has.
    template <class Body>
    Status for_kept_frames(FrameSource& source, const Body& body)
    {
        Matrix<float> room;
        for (std::size_t f : plan_.frames) {
            MESHREEL_TRY(const MatrixView<const float> frame, source.frames(f, 1, room));
            body(frame.row(0));
        }
        return Ok{};
    }

    Status measure_bounds(FrameSource& source)
    {
        return for_kept_frames(source, [&](std::span<const float> row) {
            for (std::size_t i = 0; i < row.size(); ++i) {
                bounds_.low[i % 3] = std::min(bounds_.low[i % 3], static_cast<double>(row[i]));
                bounds_.high[i % 3] = std::max(bounds_.high[i % 3], static_cast<double>(row[i]));
            }
        });
    }

    /// Every coordinate as the share of its way through the bounds, in 65535ths.
    Result<Bytes> quantised(FrameSource& source)
    {
        Bytes bytes;
        MESHREEL_CHECK(for_kept_frames(source, [&](std::span<const float> row) {
            for (std::size_t i = 0; i < row.size(); ++i) {
                const double size = bounds_.high[i % 3] - bounds_.low[i % 3];
                const double share = size > 0.0 ? (static_cast<double>(row[i]) - bounds_.low[i % 3]) / size : 0.0;
                const auto level = static_cast<std::uint16_t>(std::lround(65535.0 * share));
                bytes.push_back(static_cast<std::uint8_t>(level));
                bytes.push_back(static_cast<std::uint8_t>(level >> 8));
            }
        }));
        return bytes;
    }

    Bytes triangle_bytes() const
    {
        Bytes bytes;
        for (const Triangle& triangle : source_.still().triangles)
            for (std::uint32_t v : triangle)
                for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<std::uint8_t>(v >> shift));
        return bytes;
    }

    Bytes levels() const
    {
        Bytes bytes;
        for (std::size_t f : plan_.frames) {
            const std::span<const std::uint8_t> row = surfaces_.heat->levels(f);
            bytes.insert(bytes.end(), row.begin(), row.end());
        }
        return bytes;
    }

    /// What the reader should know of what is not there.
    std::string note() const
    {
        const std::size_t K = plan_.frames.size(), F = source_.frame_count();
        std::string text = "Positions are rounded to 16 bits a coordinate, errors to 8 bits.";
        if (K < F)
            text += fmt::format(" Only {} of {} frames are in this page, to keep it under {}; the curve is of all.", K,
                                F, human_bytes(static_cast<double>(options_.page_bytes)));
        if (!plan_.both && surfaces_.on_distorted()) text += " The original was left out for the same reason.";
        if (plan_.bytes > options_.page_bytes) text += " Even so it is larger.";
        if ((K < F || plan_.bytes > options_.page_bytes) && options_.warn) options_.warn(text);
        return text;
    }

    std::string meta() const
    {
        const Heat& heat = *surfaces_.heat;
        const Animation& still = source_.still();
        const Axis up = surfaces_.upright();
        std::vector<double> size(3);
        for (std::size_t c = 0; c < 3; ++c) size[c] = bounds_.high[c] - bounds_.low[c];
        const Json meta = {{"title", heat.label().title},
                           {"measure", heat.label().name},
                           {"unit", heat.label().unit},
                           {"original", options_.original},
                           {"distorted", options_.distorted},
                           {"onDistorted", surfaces_.on_distorted()},
                           {"up", up == Axis::x   ? "x"
                                  : up == Axis::z ? "z"
                                                  : "y"},
                           {"V", still.vertex_count},
                           {"T", still.triangles.size()},
                           {"top", surfaces_.range > 0.0 ? surfaces_.range : scale_up_to(heat.largest()).top},
                           {"low", bounds_.low},
                           {"size", size},
                           {"frames", plan_.frames},
                           {"times", still.times_s},
                           {"tops", std::vector<float>(heat.tops().begin(), heat.tops().end())},
                           {"means", std::vector<float>(heat.means().begin(), heat.means().end())},
                           {"viridis", viridis_colours},
                           {"note", note()}};
        std::string text = meta.dump(-1, ' ', false, Json::error_handler_t::replace);
        for (std::size_t at = text.find('<'); at != text.npos; at = text.find('<', at)) text.replace(at, 1, "\\u003c");
        return text;
    }

    const Surfaces& surfaces_;
    const HeatMapOptions& options_;
    FrameSource& source_;
    FrameSource& other_;
    const PagePlan plan_;
    Bounds3 bounds_; ///< of the frames of the page
    std::string text_;
};

} // namespace

Result<Bytes> heat_page(const Surfaces& surfaces, const HeatMapOptions& options)
{
    return HeatPage(surfaces, options).write();
}

} // namespace meshreel::cli
