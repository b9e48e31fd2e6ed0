/// Frames of an animation in memory.
// SPDX-License-Identifier: MIT
#include "meshreel/mesh/frame_source.h"

namespace meshreel {

Result<MatrixView<const float>> HeldFrames::frames(std::size_t first, std::size_t count, Matrix<float>&)
{
    return MatrixView<const float>{animation_.frame(first).data(), count, animation_.vertex_count * 3ul};
}

std::size_t frames_a_run(std::uint32_t vertex_count)
{
    constexpr std::size_t run_bytes = 16 << 20, frame_floats = 3;
    return std::max<std::size_t>(1, run_bytes / (sizeof(float) * frame_floats * vertex_count));
}

} // namespace meshreel
