/// The errors that a measure puts on vertices, kept as they come: what a heat map needs of them.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "meshreel/base/views.h"

namespace meshreel::cli {

/// What is shown and in which unit.
struct HeatLabel {
    std::string name;  ///< of the measure: "sted"
    std::string title; ///< "vertex distance"
    std::string unit;  ///< "units", "%", ""
};

/// Which of the errors of a vertex is shown.
struct HeatOf {
    enum class Kind { largest, mean, frame } kind = Kind::largest;
    std::size_t frame = 0; ///< where one frame is asked for

    /// "largest over all frames", "frame 12".
    std::string text() const;
};

/// What has to be kept beside the mean and the largest of each vertex.
struct HeatWishes {
    bool every_frame = false;        ///< F x V bytes
    std::vector<std::size_t> frames; ///< exactly
};

/// The errors of V vertices in F frames, taken frame after frame. Errors are not negative; one that is infinite or no
/// number counts as infinite, and is left out of means and largest values.
class Heat {
public:
    Heat(HeatLabel label, const HeatWishes& wishes) : label_(std::move(label)), wishes_(wishes) {}

    /// @pre frames come in order, from 0, all of the same V.
    void add(std::size_t frame, std::span<const double> errors);

    const HeatLabel& label() const { return label_; }
    std::size_t vertex_count() const { return largest_.size(); }
    std::size_t frame_count() const { return tops_.size(); }
    bool empty() const { return tops_.empty(); }

    double largest() const;                                 ///< of all vertices and frames
    std::size_t worst_frame() const { return worst_; }      ///< the first that has it
    std::span<const float> tops() const { return tops_; }   ///< the largest of each frame, [F]
    std::span<const float> means() const { return means_; } ///< the mean of each frame, [F]
    /// Each vertex' value, [V]. @pre a frame was wished for, or is the worst, or every frame is kept.
    std::vector<double> values(const HeatOf& of) const;
    /// The errors of a frame in 255ths of its largest, [V]. @pre every_frame.
    std::span<const std::uint8_t> levels(std::size_t frame) const;

private:
    HeatLabel label_;
    HeatWishes wishes_;
    std::vector<double> sum_, largest_; ///< [V]
    std::vector<float> tops_, means_;   ///< [F]
    std::vector<std::uint8_t> levels_;  ///< [F x V]
    std::map<std::size_t, std::vector<double>> exact_;
    std::vector<double> worst_errors_;
    std::size_t worst_ = 0;
};

} // namespace meshreel::cli
