/// Pixels, shrinking, and PNG by libpng.
// SPDX-License-Identifier: MIT
#include "cli/image.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

#include <png.h>

namespace meshreel::cli {

namespace {

float to_linear(float value)
{
    return value <= 0.04045f ? value / 12.92f : std::pow((value + 0.055f) / 1.055f, 2.4f);
}

std::uint8_t to_byte(float linear)
{
    const float x = std::clamp(linear, 0.0f, 1.0f);
    const float encoded = x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1.0f / 2.4f) - 0.055f;
    return static_cast<std::uint8_t>(std::lround(255.0f * encoded));
}

/// Red, green, blue, opacity of every pixel, not premultiplied, as PNG wants them.
Bytes rgba(const Image& image)
{
    Bytes bytes;
    bytes.reserve(image.colours.size() * 4);
    for (std::size_t i = 0; i < image.colours.size(); ++i) {
        const float alpha = image.opacity[i];
        for (float channel : image.colours[i]) bytes.push_back(alpha > 0.0f ? to_byte(channel / alpha) : 0);
        bytes.push_back(static_cast<std::uint8_t>(std::lround(255.0f * std::clamp(alpha, 0.0f, 1.0f))));
    }
    return bytes;
}

} // namespace

Image::Image(std::size_t columns, std::size_t rows)
    : width(columns), height(rows), colours(columns * rows, Colour{}), opacity(columns * rows, 0.0f)
{
}

Colour colour_of(const char* hex)
{
    const unsigned long value = std::strtoul(hex + 1, nullptr, 16);
    const auto channel = [&](int shift) { return to_linear(static_cast<float>((value >> shift) & 255u) / 255.0f); };
    return {channel(16), channel(8), channel(0)};
}

Image shrink(const Image& large, std::size_t times)
{
    Image small(large.width / times, large.height / times);
    const float share = 1.0f / static_cast<float>(times * times);
    for (std::size_t y = 0; y < small.height * times; ++y) {
        for (std::size_t x = 0; x < small.width * times; ++x) {
            const std::size_t from = y * large.width + x;
            const std::size_t to = (y / times) * small.width + x / times;
            for (std::size_t c = 0; c < 3; ++c) small.colours[to][c] += share * large.colours[from][c];
            small.opacity[to] += share * large.opacity[from];
        }
    }
    return small;
}

Result<Bytes> png(const Image& image)
{
    png_image header{};
    header.version = PNG_IMAGE_VERSION;
    header.width = static_cast<png_uint_32>(image.width);
    header.height = static_cast<png_uint_32>(image.height);
    header.format = PNG_FORMAT_RGBA;
    const Bytes pixels = rgba(image);
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(header);
    Bytes file(size);
    if (png_image_write_to_memory(&header, file.data(), &size, 0, pixels.data(), 0, nullptr) == 0)
        return Error{ErrorCode::runtime, std::string("cannot make a PNG: ") + header.message};
    file.resize(size);
    return file;
}

} // namespace meshreel::cli
