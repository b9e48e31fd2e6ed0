/// Animations numbered as a file without order numbers them, to compare a decoded file with its original.
// SPDX-License-Identifier: MIT
#include "meshreel/base/memory.h"
#include "meshreel/connectivity/topology.h"
#include "meshreel/mesh/reorder.h"
#include "meshreel/mesh/weld.h"
#include "meshreel/meshreel.h"

namespace meshreel {

namespace {

/// A source's frames with their vertices in another order.
class ReorderedFrames : public FrameSource {
public:
    ReorderedFrames(FrameSource& source, const connectivity::Encoded& order)
        : source_(source), still_(source.still()), vertex_of_(order.vertex_of)
    {
        still_.positions.clear();
        still_.triangles = order.topology.triangles;
        still_.appearance = reordered(still_.appearance, {order.vertex_of, order.corner_of});
    }

    const Animation& still() const override { return still_; }

    Result<MatrixView<const float>> frames(std::size_t first, std::size_t count, Matrix<float>& room) override
    {
        Matrix<float> own_room;
        MESHREEL_TRY(const MatrixView<const float> frames, source_.frames(first, count, own_room));
        if (room.rows != count || room.cols != frames.cols) room = Matrix<float>(count, frames.cols);
        for (std::size_t i = 0; i < count; ++i) reorder_frame(frames.row(i), vertex_of_, room.row(i));
        return MatrixView<const float>(room.view());
    }

private:
    FrameSource& source_;
    Animation still_;
    std::vector<std::uint32_t> vertex_of_;
};

} // namespace

Result<std::unique_ptr<FrameSource>> in_free_order(FrameSource& source, Threads threads)
{
    return within_memory([&]() -> Result<std::unique_ptr<FrameSource>> {
        MESHREEL_TRY(const Weld welded, weld(source, {.threads = threads}));
        const Animation& still = source.still();
        const connectivity::Encoded order =
            connectivity::encode({still.vertex_count, still.triangles, welded.unique_of}, Order::free);
        return std::unique_ptr<FrameSource>(std::make_unique<ReorderedFrames>(source, order));
    });
}

Animation in_free_order(const Animation& animation, Threads threads)
{
    const connectivity::Encoded topology = connectivity::encode(
        {animation.vertex_count, animation.triangles, weld(animation, threads).unique_of}, Order::free);
    Animation result = animation;
    result.triangles = topology.topology.triangles;
    for (std::size_t f = 0; f < animation.frame_count(); ++f)
        reorder_frame(animation.frame(f), topology.vertex_of, result.frame(f));
    result.appearance = reordered(animation.appearance, {topology.vertex_of, topology.corner_of});
    return result;
}

} // namespace meshreel
