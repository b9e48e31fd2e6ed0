/// Makes any bytes an animation and encodes it, as they say: what comes out decodes to the same mesh, as good as promised.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "meshreel/codecs/codec.h"
#include "meshreel/meshreel.h"

using namespace meshreel;

namespace {

/// Bytes taken from the front; zeros behind their end.
class Supply {
public:
    Supply(const std::uint8_t* data, std::size_t size) : data_(data), left_(size) {}

    std::uint8_t byte()
    {
        if (left_ == 0) return 0;
        --left_;
        return *data_++;
    }
    std::uint32_t below(std::uint32_t limit) { return byte() % limit; }
    std::uint32_t word() { return byte() | byte() << 8 | byte() << 16 | static_cast<std::uint32_t>(byte()) << 24; }

private:
    const std::uint8_t* data_;
    std::size_t left_;
};

Animation animation_of(Supply& supply)
{
    Animation animation;
    animation.vertex_count = supply.below(24);
    const std::uint32_t triangles = animation.vertex_count > 0 ? supply.below(40) : 0, frames = 1 + supply.below(6);
    const bool any_floats = supply.below(4) == 0;
    for (std::uint32_t t = 0; t < triangles; ++t) {
        Triangle& triangle = animation.triangles.emplace_back();
        for (std::uint32_t& corner : triangle) corner = supply.below(animation.vertex_count);
    }
    animation.times_s = uniform_times(frames, 25.0);
    animation.meta.loop = supply.below(2) == 1;
    animation.positions.resize(3ul * frames * animation.vertex_count);
    for (float& x : animation.positions)
        x = any_floats ? std::bit_cast<float>(supply.word())
                       : static_cast<float>(static_cast<std::int8_t>(supply.byte()));
    return animation;
}

Quality quality_of(Supply& supply)
{
    Quality quality;
    const double amount = 0.02 * (1 + supply.byte());
    switch (supply.below(8)) {
    case 0:
        quality.kg = amount;
        break;
    case 1:
        quality.sted = 0.1 * amount;
        break;
    case 2:
        quality.max_error_relative = amount;
        break;
    case 3:
        quality.psnr = 20 * amount;
        break;
    case 4:
        quality.size = static_cast<std::uint64_t>(100 * amount);
        break;
    case 5:
        quality.bpfv = 10 * amount;
        break;
    case 6:
        quality.step = 0.01 * amount;
        quality.bases = 1 + supply.below(9);
        break;
    default:
        break;
    }
    return quality;
}

EncodeOptions options_of(Supply& supply)
{
    EncodeOptions options;
    const codecs::Codec& codec = codecs::all()[supply.below(static_cast<std::uint32_t>(codecs::all().size()))];
    options.codec = std::string(codec.name);
    if (!codec.exact()) options.quality = quality_of(supply);
    options.effort = 1 + static_cast<int>(supply.below(3));
    options.fast_decode = supply.below(2) == 1;
    options.order = supply.below(2) == 1 ? Order::free : Order::keep;
    options.basis = static_cast<BasisCoding>(supply.below(basis_coding_names.size()));
    options.entropy = static_cast<Entropy>(supply.below(2));
    options.segment = supply.below(4);
    options.threads = {1};
    return options;
}

void require(bool what_must_hold)
{
    if (!what_must_hold) __builtin_trap();
}

bool same_bits(const std::vector<float>& a, const std::vector<float>& b)
{
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    Supply supply(data, size);
    const EncodeOptions options = options_of(supply);
    const Animation animation = animation_of(supply);
    const auto encoded = encode(animation, options);
    if (!encoded.ok()) {
        require(!encoded.error().message.empty());
        require(encoded.error().code == ErrorCode::missed || !validate(animation).ok());
        return 0;
    }
    const auto decoded = decode(encoded->bytes);
    require(decoded.ok() && validate(*decoded).ok());
    const Animation original = options.order == Order::free ? in_free_order(animation) : animation;
    require(decoded->triangles == original.triangles && decoded->times_s == original.times_s);
    require(decoded->positions.size() == original.positions.size());
    if (codecs::find(options.codec)->exact()) require(same_bits(decoded->positions, original.positions));
    const Quality& wanted = options.quality;
    require(!wanted.kg || encoded->kg <= *wanted.kg || std::isinf(encoded->kg)); // of points KG is a part of nothing
    require(!wanted.sted || encoded->sted.value() <= *wanted.sted);
    require(!wanted.psnr || encoded->psnr >= *wanted.psnr);
    require(!wanted.size || encoded->bytes.size() <= *wanted.size);
    require(!wanted.bpfv || encoded->bpfv <= *wanted.bpfv);
    return 0;
}
