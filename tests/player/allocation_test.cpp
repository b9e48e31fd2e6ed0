/// Nothing is allocated between opening and closing: every operator new of this program is counted.
// SPDX-License-Identifier: MIT
#include <atomic>
#include <cstdlib>
#include <gtest/gtest.h>
#include <new>

#include "tests/player/fixture.h"

namespace {

std::atomic<std::size_t> allocations{0};

void* counted(std::size_t size, std::size_t alignment)
{
    ++allocations;
    void* memory = std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
    if (memory == nullptr && size != 0) throw std::bad_alloc();
    return memory;
}

} // namespace

void* operator new(std::size_t size)
{
    return counted(size, alignof(std::max_align_t));
}
void* operator new(std::size_t size, std::align_val_t alignment)
{
    return counted(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept
{
    std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept
{
    std::free(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept
{
    std::free(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept
{
    std::free(memory);
}

using namespace meshreel;

TEST(Player, AllocatesNothingBetweenOpeningAndClosing)
{
    const Bytes reel = reel_of(shape("wave", {.vertices = 150, .frames = 40}), cut_into(12));
    const std::size_t before_opening = allocations;
    player::Player player = *player::Player::open(reel);
    std::vector<float> frame(3ul * player.vertex_count()), frames(20 * frame.size());
    const std::size_t opened = allocations;
    EXPECT_GT(opened, before_opening);
    for (double t = -0.1; t < 1.8; t += 0.007) {
        player.seek(t);
        player.pose(frame);
    }
    player.seek_frame(39);
    player.pose(frame);
    player.pose_frames(5, frames);
    EXPECT_EQ(allocations, opened);
}
