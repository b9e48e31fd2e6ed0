/// What a codec is: prepared once for a sequence, tried at many settings, decoded from its bits alone.
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "meshreel/base/limits.h"
#include "meshreel/base/views.h"
#include "meshreel/codecs/detail.h"
#include "meshreel/codecs/settings.h"
#include "meshreel/codecs/trajectories.h"
#include "meshreel/connectivity/surface.h"
#include "meshreel/container/fields.h"

namespace meshreel::codecs {

/// What a codec sees of an animation: its surface, and positions in the surface's vertex order.
struct Sequence {
    const connectivity::Surface& surface;
    MatrixView<const float> frames; ///< [F x 3W]
};

/// One encoding and what it cost.
struct Trial {
    Bytes payload;              ///< everything the decoder needs beside the surface
    std::uint32_t bases = 0;    ///< K
    double step = 0.0;          ///< D, model units
    double squared_error = 0.0; ///< sum of squared differences over all coordinates, before rounding to float32
    Trajectories decoded;       ///< what the decoder will see, bit for bit
};

/// A codec at work on one sequence. The sequence must outlive it.
class Encoder {
public:
    virtual ~Encoder() = default;

    /// Squared norm of all positions less each frame's centroid: |A - E(A)|^2 of (5.2).
    virtual double energy() const = 0;
    /// s_k of all components prepared, falling; s_k^2 is the sum of squared coefficients c_k.
    virtual std::span<const double> singular_values() const = 0;
    /// The same bytes for any number of threads.
    virtual Trial encode(const Settings& settings) const = 0;
};

/// What a decoder is given.
struct Coded {
    container::Source payload;
    const connectivity::Surface& surface;
    std::size_t frame_count;
    DecodeLimits limits;
    Threads threads;
    /// Surface vertices, if only these are wanted: of a codec with levels of detail, whose payload may then end with the
    /// coarsest level that has them all.
    std::optional<std::span<const std::uint32_t>> wanted = {};
};

/// A function that decoding does without: null where the decoder is built alone (wasm/), so that nothing of it is linked.
template <class Function>
constexpr Function* encoder_side([[maybe_unused]] Function* function)
{
#ifdef MESHREEL_DECODER_ALONE
    return nullptr;
#else
    return function;
#endif
}

/// One row of the registry.
struct Codec {
    std::string_view name; ///< as in --codec, and in the file's header
    std::string_view summary;

    /// max_bases: no trial will use more components than these.
    std::unique_ptr<Encoder> (*prepare)(const Sequence& sequence, std::size_t max_bases, Threads threads);

    /// The trajectories of a payload, of vertices not wanted whatever is known; null for an exact codec. Memory: what its header promises, within limits.
    /// @fails bad_input, naming byte and field.
    Result<Trajectories> (*open)(const Coded& coded);

    /// Appends a line a field of the payload. @fails as open.
    Status (*explain)(const container::Source& payload, const DecodeLimits& limits, std::string& lines);

    /// The frames of a payload, [F x 3W], bit for bit as they were: an exact codec, which no step or number of bases
    /// concerns. Null for a codec of trajectories. @fails as open.
    Status (*frames)(const Coded& coded, MatrixView<float> frames) = nullptr;

    /// The levels of detail of a payload; null for a codec without. @fails as open.
    Result<Detail> (*detail)(const Coded& coded) = nullptr;
    /// How many first bytes of a payload each of its levels takes, finest first, from the payload's first 256 bytes alone,
    /// or all of it. Null where detail is. @fails as open.
    Result<std::vector<std::uint64_t>> (*level_bytes)(const container::Source& payload,
                                                      const DecodeLimits& limits) = nullptr;

    bool exact() const { return frames != nullptr; }
};

/// Fills frames [F x 3W] from a payload of F frames; W: the vertices wanted, in that order. @fails as Codec::open.
Status decode(const Codec& codec, const Coded& coded, MatrixView<float> frames);

/// A payload decoded so far that any of its frames can be posed: of the vertices wanted, in that order.
using Opened = std::variant<Trajectories, Matrix<float>>;
/// @fails as Codec::open.
Result<Opened> open(const Codec& codec, const Coded& coded);
/// Frames [N x 3W] mixed from those of the payload, before rounding; a mix of one frame alone is what decode() rounds.
void pose(const Opened& opened, const Mixes& mixes, MatrixView<double> frames, Threads threads);

/// Every codec, in the order of the documentation.
std::span<const Codec> all();
/// Those that are not exact.
std::span<const Codec> of_trajectories();

/// The codec of that name, or null.
const Codec* find(std::string_view name);

} // namespace meshreel::codecs
