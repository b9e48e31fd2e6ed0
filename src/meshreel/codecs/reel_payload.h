/// The fields of reel's payload.
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "meshreel/base/views.h"
#include "meshreel/codecs/interpolation.h"
#include "meshreel/container/fields.h"

namespace meshreel::codecs {

inline constexpr std::size_t most_levels = 16;                           // of a quarter each, 4^16 vertices
inline constexpr std::uint64_t most_part_bytes = std::uint64_t{1} << 40; // sums do not overflow

/// Bytes of one level of detail.
struct LevelSize {
    std::uint64_t bytes = 0;

    void fields(auto& io) { io.varint("bytes", bytes, {0, most_part_bytes}, "of level_bits that are this level's"); }
};

inline constexpr std::uint32_t taper_one = 256;
inline constexpr double noise_unit = 1.0 / 256; // of the step
inline constexpr std::uint32_t most_noise = 1u << 20;
inline constexpr std::uint32_t way_mixed = 1, way_lengths = 2; // of `ways`

/// What a `SEGM` chunk of reel holds: reel.md.
struct ReelPayload {
    std::uint32_t bases = 0;
    double step = 1.0, first_step = 1.0, basis_step = 1.0;
    std::array<float, 3> origin{};
    std::uint32_t taper = 0;
    InterpolationLaw law;
    std::uint32_t ways = way_mixed, length_noise = 0;
    std::uint64_t basis_size = 0, first_size = 0;
    std::vector<LevelSize> levels;
    ByteView bits;

    double taper_exponent() const { return taper / static_cast<double>(taper_one); }

    /// The variance that Relaxation::relax takes.
    double relaxed_noise() const
    {
        const double deviation = step * (length_noise * noise_unit);
        return deviation * deviation;
    }

    bool has(std::uint32_t way) const { return (ways & way) != 0; }

    /// body(how many contexts a level is coded under, as a constant)
    auto with_contexts(const auto& body) const
    {
        return has(way_mixed) ? body(std::integral_constant<std::size_t, 3>{})
                              : body(std::integral_constant<std::size_t, 1>{});
    }

    void fields(auto& io)
    {
        io.varint("bases", bases, {0, 3'000'000}, "K, the number of eigentrajectories");
        io.f64("step", step, container::positive, "D, quantisation step of the coefficients, model units");
        io.f64("first_step", first_step, container::positive, "the step of coefficients 0, 1, 2");
        io.f64("basis_step", basis_step, container::positive, "step of the poses, scaled by what they weigh");
        io.f32("origin_x", origin[0], container::finite, "added to the mean's x in every frame");
        io.f32("origin_y", origin[1], container::finite, "likewise y");
        io.f32("origin_z", origin[2], container::finite, "likewise z");
        io.varint("taper", taper, {0, taper_one},
                  "2^-8: to which power of their share of vertices coarse levels are finer");
        io.f64("linear", law.linear, {0.0, 1e6}, "trust in motions known already against smoothness");
        io.f64("squared_bend", law.squared_bend, {1e-6, 1e6}, "c^2 of the multiquadric");
        io.varint(
            "ways", ways, {0, way_mixed | way_lengths},
            "sum of 1: levels are coded under three contexts at once, not only the first; 2: guesses keep lengths");
        io.varint("neighbours", law.neighbours, {1, Interpolation::most}, "vertices that one is interpolated from");
        io.varint("growth", law.growth, {1, 1'000'000}, "batches grow by so many eighths of the components known");
        io.varint("length_noise", length_noise, {0, most_noise},
                  "deviation of edge lengths that frames are relaxed for, in 1/256 of step; 0: they are not");
        io.varint("basis_size", basis_size, {0, most_part_bytes}, "bytes of basis_bits");
        io.varint("first_size", first_size, {0, most_part_bytes}, "bytes of first_bits");
        io.list("levels", levels, {1, most_levels}, "levels of detail, the coarsest first");
        io.rest("bits", bits, "basis_bits (poses), first_bits (coefficients 0, 1, 2), level_bits (the others)");
    }
};

} // namespace meshreel::codecs
