/// Pixels, shrinking, and PNG by libpng.
// SPDX-License-Identifier: MIT
#include "cli/pictures/image.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

#include <png.h>

namespace meshreel::cli {

namespace {

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

float linear_of(std::uint8_t channel)
{
    const float value = static_cast<float>(channel) / 255.0f;
    return value <= 0.04045f ? value / 12.92f : std::pow((value + 0.055f) / 1.055f, 2.4f);
}

Colour colour_of(const char* hex)
{
    const unsigned long value = std::strtoul(hex + 1, nullptr, 16);
    const auto channel = [&](int shift) { return linear_of(static_cast<std::uint8_t>(value >> shift & 255u)); };
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

void blend(Image& image, std::size_t pixel, const Colour& colour, float share)
{
    for (std::size_t c = 0; c < 3; ++c)
        image.colours[pixel][c] = (1.0f - share) * image.colours[pixel][c] + share * colour[c];
    image.opacity[pixel] = (1.0f - share) * image.opacity[pixel] + share;
}

void fill(Image& image, const Box& box, const Colour& colour, double radius)
{
    const auto inside = [](double at, std::size_t size) {
        return static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(size)));
    };
    const std::size_t x1 = inside(std::ceil(box.x + box.width), image.width);
    const std::size_t y1 = inside(std::ceil(box.y + box.height), image.height);
    for (std::size_t y = inside(std::floor(box.y), image.height); y < y1; ++y) {
        for (std::size_t x = inside(std::floor(box.x), image.width); x < x1; ++x) {
            // how far the pixel's middle is outside the box that is smaller by the radius; below 0: inside it
            const double dx =
                std::abs(static_cast<double>(x) + 0.5 - box.x - 0.5 * box.width) - 0.5 * box.width + radius;
            const double dy =
                std::abs(static_cast<double>(y) + 0.5 - box.y - 0.5 * box.height) - 0.5 * box.height + radius;
            const double outside =
                std::hypot(std::max(dx, 0.0), std::max(dy, 0.0)) + std::min(0.0, std::max(dx, dy)) - radius;
            blend(image, y * image.width + x, colour, static_cast<float>(std::clamp(0.5 - outside, 0.0, 1.0)));
        }
    }
}

void paste(Image& image, const Image& small, std::size_t x, std::size_t y)
{
    for (std::size_t row = 0; row < small.height && y + row < image.height; ++row) {
        for (std::size_t column = 0; column < small.width && x + column < image.width; ++column) {
            const std::size_t from = row * small.width + column, to = (y + row) * image.width + x + column;
            const float under = 1.0f - small.opacity[from];
            for (std::size_t c = 0; c < 3; ++c)
                image.colours[to][c] = small.colours[from][c] + under * image.colours[to][c];
            image.opacity[to] = small.opacity[from] + under * image.opacity[to];
        }
    }
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
