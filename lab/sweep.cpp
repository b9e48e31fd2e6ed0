/// Rates and errors of one codec on a grid of settings, its preparation shared: table 9.3.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "lab/basis_study.h"
#include "meshreel/base/text.h"
#include "meshreel/codecs/codec.h"
#include "meshreel/connectivity/topology.h"
#include "meshreel/mesh/reorder.h"
#include "meshreel/mesh/weld.h"
#include "meshreel/meshreel.h"
#include "meshreel/metrics/kg.h"

namespace meshreel::lab {

namespace {

/// A codec at work on an animation, as encode() has it with Order::free.
class Grid {
public:
    Grid(const Animation& animation, const codecs::Codec& codec, const EncodeOptions& options, std::size_t most_bases)
        : animation_(animation), codec_(codec), options_(options),
          topology_(connectivity::encode({animation.vertex_count, animation.triangles, weld(animation).unique_of},
                                         Order::free)),
          frames_(animation.frame_count(), 3ul * topology_.topology.surface.vertex_count)
    {
        for (std::size_t f = 0; f < frames_.rows; ++f)
            reorder_frame(animation.frame(f), topology_.original_of, frames_.row(f));
        encoder_ = codec.prepare({topology_.topology.surface, frames_.view()}, most_bases, {});
    }

    Result<Json> point(std::uint32_t bases, int bits)
    {
        const Bytes payload = encoder_->encode(settings(bases, bits)).payload;
        if (!around_) {
            MESHREEL_TRY(around_, bytes_around(bases, bits, payload.size()));
        }
        MESHREEL_TRY(const double kg, error(payload));
        return Json{{"bases", bases}, {"bits", bits}, {"bytes", payload.size() + *around_}, {"kg", kg}};
    }

private:
    codecs::Settings settings(std::uint32_t bases, int bits) const
    {
        codecs::Settings settings;
        settings.step = std::exp2(-bits) * body_diagonal(animation_); // (2.4)
        settings.bases = bases;
        settings.basis = options_.basis;
        settings.entropy = options_.entropy;
        return settings;
    }

    /// What a file holds beside its payload; but for the lengths that stand in it, the same at all settings.
    Result<std::size_t> bytes_around(std::uint32_t bases, int bits, std::size_t payload_bytes) const
    {
        EncodeOptions options = options_;
        options.quality.bases = bases;
        options.quality.step = std::exp2(-bits);
        MESHREEL_TRY(const Encoded file, encode(animation_, options));
        return file.bytes.size() - payload_bytes;
    }

    Result<double> error(ByteView payload) const
    {
        Matrix<float> decoded(frames_.rows, frames_.cols);
        MESHREEL_CHECK(
            codecs::decode(codec_, {{payload, 0, "SEGM"}, topology_.topology.surface, decoded.rows, DecodeLimits{}, {}},
                           decoded.view()));
        Animation back = in_free_order(animation_);
        const std::vector<std::uint32_t>& surface_of = topology_.topology.surface_of;
        for (std::size_t f = 0; f < decoded.rows; ++f)
            for (std::size_t v = 0; v < surface_of.size(); ++v)
                std::copy_n(decoded.row(f).data() + 3ul * surface_of[v], 3, back.frame(f).data() + 3 * v);
        return metrics::kg_error(in_free_order(animation_), back);
    }

    const Animation& animation_;
    const codecs::Codec& codec_;
    const EncodeOptions& options_;
    connectivity::Encoded topology_;
    Matrix<float> frames_; ///< [F x 3W] in surface order
    std::unique_ptr<codecs::Encoder> encoder_;
    std::optional<std::size_t> around_; ///< bytes of a file beside its payload
};

Result<EncodeOptions> options_of(const Json& row)
{
    EncodeOptions options;
    options.codec = row.at("codec").get<std::string>();
    options.order = Order::free;
    const auto basis = std::ranges::find(basis_coding_names, row.at("basis").get<std::string>());
    if (basis == basis_coding_names.end())
        return Error{ErrorCode::usage, "there is no such coding of the basis", "basis", {}, {}};
    options.basis = static_cast<BasisCoding>(basis - basis_coding_names.begin());
    options.entropy = row.at("entropy").get<std::string>() == "huffman" ? Entropy::huffman : Entropy::range;
    return options;
}

} // namespace

Result<Json> sweep(const Json& row)
{
    MESHREEL_TRY(const EncodeOptions options, options_of(row));
    const codecs::Codec* codec = codecs::find(options.codec);
    if (codec == nullptr) return unsupported(concat("there is no codec \"", options.codec, "\""), "codec");
    MESHREEL_TRY(const Animation animation, load(row));
    const auto bases = row.at("bases").get<std::vector<std::uint32_t>>();
    Grid grid(animation, *codec, options, *std::ranges::max_element(bases));
    Json figures{{"vertices", animation.vertex_count}, {"frames", animation.frame_count()}, {"points", Json::array()}};
    for (std::uint32_t K : bases)
        for (int bits : row.at("bits").get<std::vector<int>>()) {
            MESHREEL_TRY(Json point, grid.point(K, bits));
            figures["points"].push_back(std::move(point));
        }
    return figures;
}

} // namespace meshreel::lab
