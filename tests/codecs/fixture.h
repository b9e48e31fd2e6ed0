/// What the tests of the codecs share: a sequence in surface order, and every point of a codec's settings.
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "meshreel/codecs/codec.h"
#include "meshreel/connectivity/trace.h"
#include "meshreel/mesh/reorder.h"
#include "meshreel/mesh/test_shapes.h"

namespace meshreel {

/// An animation as a codec sees it.
struct Prepared {
    explicit Prepared(const Animation& animation)
        : surface(connectivity::trace(animation.vertex_count, animation.triangles).surface),
          frames(animation.frame_count(), 3ul * animation.vertex_count)
    {
        const auto vertex_of = connectivity::trace(animation.vertex_count, animation.triangles).vertex_of;
        for (std::size_t f = 0; f < frames.rows; ++f) reorder_frame(animation.frame(f), vertex_of, frames.row(f));
    }
    codecs::Sequence sequence() const { return {surface, frames.view()}; }

    connectivity::Surface surface;
    Matrix<float> frames;
};

/// Every combination of basis coding and entropy coder, at one step.
inline std::vector<codecs::Settings> all_settings(double step)
{
    std::vector<codecs::Settings> all;
    for (std::size_t basis = 0; basis < basis_coding_names.size(); ++basis)
        for (Entropy entropy : {Entropy::huffman, Entropy::range})
            all.push_back({.step = step, .basis = static_cast<BasisCoding>(basis), .entropy = entropy});
    all.push_back({.step = step, .growth = 12, .mixed = false, .neighbours = 5}); // files that open fast
    all.push_back({.step = step, .relax = true});
    all.push_back({.step = step, .lengths = true});
    return all;
}

/// All of them, or one for a codec that none of them concerns.
inline std::vector<codecs::Settings> settings_of(const codecs::Codec& codec, double step)
{
    return codec.exact() ? std::vector<codecs::Settings>(1) : all_settings(step);
}

inline Result<Matrix<float>> decoded(const codecs::Codec& codec, ByteView payload, const Prepared& prepared,
                                     const DecodeLimits& limits = {})
{
    Matrix<float> frames(prepared.frames.rows, prepared.frames.cols);
    MESHREEL_CHECK(codecs::decode(codec, {{payload, 0, "SEGM"}, prepared.surface, frames.rows, limits, Threads{1}},
                                  frames.view()));
    return frames;
}

inline double squared_difference(const Matrix<float>& a, const Matrix<float>& b)
{
    double sum = 0;
    for (std::size_t i = 0; i < a.values.size(); ++i) {
        const double difference = static_cast<double>(a.values[i]) - b.values[i];
        sum += difference * difference;
    }
    return sum;
}

} // namespace meshreel
