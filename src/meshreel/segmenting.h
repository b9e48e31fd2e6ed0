/// Where a long animation is cut: into equal parts, or where it pays.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "meshreel/linalg/run_spectra.h"
#include "meshreel/mesh/frame_source.h"

namespace meshreel {

/// Frames first .. first + count - 1.
struct FrameSpan {
    std::size_t first = 0, count = 0;
};

/// As few segments as the longest allows, of nearly equal length. @pre F, longest >= 1
std::vector<FrameSpan> equal_segments(std::size_t F, std::size_t longest);

/// How many frames a segment of W vertices has at most, so that it is encoded within a gigabyte, or little more where W is
/// large: 1000, as the cost of a PCA grows with the square of the shorter side; 4000 where that side is W. Of a codec that
/// loses nothing the best guess so far, and the walk, take their room too.
std::size_t longest_segment(std::uint32_t coded_vertices, bool exact);

/// How many frames fit in as much memory where components may be as many as numbers of a trajectory, 3F.
std::size_t longest_rich_segment(std::uint32_t coded_vertices);

/// Each segment longer than allowed in equal parts. @pre longest >= 1
std::vector<FrameSpan> divided(std::span<const FrameSpan> segments, std::size_t longest);

/// The components of a run of frames.
struct Spectrum {
    std::size_t frame_count = 0;
    double energy = 0;                   ///< squared norm of all trajectories less their mean
    std::vector<double> singular_values; ///< s_k, falling; of all components, or of those prepared
};

/// A few trajectories of an animation, which tell the spectra of any run of frames well enough.
class SegmentSample {
public:
    /// frames: [F x 3N], N of the W trajectories.
    SegmentSample(Matrix<float> frames, std::uint32_t coded_vertices);
    SegmentSample(SegmentSample&&) = default;
    /// Reads all frames once. original_of: [W] a vertex for each that is coded. @fails as the source does.
    static Result<SegmentSample> take(FrameSource& source, std::span<const std::uint32_t> original_of);

    /// Of frames first .. last - 1 of all trajectories.
    Spectrum spectrum(std::size_t first, std::size_t last) const;
    std::size_t frame_count() const { return frames_.rows; }
    std::uint32_t coded_vertices() const { return coded_vertices_; }

private:
    Matrix<float> frames_;
    linalg::RunSpectra spectra_;
    std::uint32_t coded_vertices_; ///< W
};

/// What bits depend on.
struct SegmentPrice {
    double step = 0;        ///< D, model units, > 0
    double basis_ratio = 1; ///< beta
};

/// Guesses at the bits of a run of frames, all errors priced in.
///
/// A segment sends for each component that its step leaves anything of W coefficients and 3F numbers of the basis. A cut
/// sends the coefficients of components that both sides share (shape above all) twice, and saves the numbers that the
/// components of one side have in the frames of the other. So one motion is better left whole, and two that have little
/// in common are better cut where one becomes the other.
class SegmentCosts {
public:
    /// The sample must outlive it.
    SegmentCosts(const SegmentSample& sample, const SegmentPrice& price) : sample_(sample), price_(price) {}

    /// Of frames first .. last - 1, bits.
    double of(std::size_t first, std::size_t last) const;

private:
    const SegmentSample& sample_;
    SegmentPrice price_;
};

/// Starts with equal segments no longer than allowed, and cuts each in two where that pays most, again and again; then
/// joins neighbours where that pays. @cost O(F): some hundred spectra a segment of full length.
std::vector<FrameSpan> paying_segments(std::size_t F, std::size_t longest, const SegmentCosts& costs);

} // namespace meshreel
