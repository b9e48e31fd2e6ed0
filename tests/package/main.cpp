/// A program outside the tree: makes an animation, encodes it, decodes it, and says how small it became.
// SPDX-License-Identifier: MIT
#include <cstdio>

#include "meshreel/meshreel.h"

int main()
{
    meshreel::Animation wave;
    wave.vertex_count = 4;
    wave.triangles = {{0, 1, 2}, {2, 1, 3}};
    wave.times_s = meshreel::uniform_times(8, 24.0);
    for (int f = 0; f < 8; ++f)
        for (int v = 0; v < 4; ++v)
            for (int axis = 0; axis < 3; ++axis)
                wave.positions.push_back(static_cast<float>(axis == 2 ? f * v : axis == 1 ? v / 2 : v % 2));

    const auto encoded = meshreel::encode(wave);
    if (!encoded.ok()) return std::printf("%s\n", encoded.error().sentence().c_str()), 1;
    const auto decoded = meshreel::decode(encoded->bytes);
    if (!decoded.ok()) return std::printf("%s\n", decoded.error().sentence().c_str()), 1;
    std::printf("%zu bytes, %zu frames of %u vertices\n", encoded->bytes.size(), decoded->frame_count(),
                decoded->vertex_count);
    return decoded->frame_count() == 8 && decoded->vertex_count == 4 ? 0 : 1;
}
