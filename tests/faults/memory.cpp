/// The counting allocator.
// SPDX-License-Identifier: MIT
#include "tests/faults/memory.h"

#include <atomic>
#include <cstdlib>
#include <malloc.h>
#include <new>

namespace {

std::atomic<std::size_t> now{0}, most{0};

void* counted(std::size_t size, std::size_t alignment)
{
    void* memory = std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
    if (memory == nullptr && size != 0) throw std::bad_alloc();
    const std::size_t total = now += malloc_usable_size(memory);
    for (std::size_t seen = most; total > seen && !most.compare_exchange_weak(seen, total);) {
    }
    return memory;
}

void given_back(void* memory)
{
    now -= malloc_usable_size(memory);
    std::free(memory);
}

} // namespace

namespace meshreel::faults {

std::size_t held()
{
    return now;
}
std::size_t peak()
{
    return most;
}
void reset_peak()
{
    most = now.load();
}

} // namespace meshreel::faults

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
    given_back(memory);
}
void operator delete(void* memory, std::size_t) noexcept
{
    given_back(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept
{
    given_back(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept
{
    given_back(memory);
}
