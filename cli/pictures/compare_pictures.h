/// The pictures that compare draws when it is asked to: a heat map, curves, a strip.
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "cli/choice.h"
#include "cli/console.h"
#include "cli/pictures/heat_map.h"
#include "cli/pictures/strip.h"
#include "cli/target.h"

namespace meshreel::cli {

/// The two that are compared, and their names.
struct PictureInputs {
    FrameSource &original, &distorted;
    std::string original_path, distorted_path;
};

/// Options, checks before the measuring, an ear during it, files after it.
class ComparePictures {
public:
    /// --heatmap, --curves, --strip and how they look.
    void declare(CLI::App& app);

    /// Whether the files may be written, and whether a measure has errors of vertices where they are needed.
    /// @fails usage, io, bad_input.
    Status prepare(const PictureInputs& inputs, const Console& console);
    /// Adds what the pictures have to hear to the measures to take; those that were there stay where they are.
    /// `measures` are listened to until draw().
    void listen(std::vector<metrics::Wanted>& measures);
    /// Writes the files.
    Status draw(const PictureInputs& inputs, const std::vector<Taken>& taken, Console& console);
    /// The paths written, by the names of the options.
    Json figures() const;

private:
    struct Output {
        Target target;
        bool wanted = false; ///< asked for, and not skipped because it exists
    };

    bool needs_heat() const { return heatmap_.wanted || strip_.wanted; }
    Status prepare_output(Output& output, const PictureInputs& inputs, const Console& console);
    Status choose_measure(const PictureInputs& inputs);
    Status check_frame(std::size_t frame, const PictureInputs& inputs) const;
    HeatWishes wishes(const PictureInputs& inputs) const;
    std::vector<std::size_t> strip_frames(const PictureInputs& inputs) const;
    Status draw_heatmap(const Surfaces& surfaces, const PictureInputs& inputs, Console& console);
    Status draw_curves(const PictureInputs& inputs, const std::vector<Taken>& taken);
    Status draw_strip(const Surfaces& surfaces, const PictureInputs& inputs);

    Output heatmap_, curves_, strip_;
    std::string heat_name_, heat_of_text_ = "max", strip_frame_ = "worst", up_;
    HeatOf of_;
    double range_ = 0.0;
    std::uint64_t page_bytes_ = 32u << 20;
    StripOptions strip_options_;
    const metrics::Metric* metric_ = nullptr;
    std::unique_ptr<Heat> heat_;
};

} // namespace meshreel::cli
