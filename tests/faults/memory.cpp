/// The counting allocator.
// SPDX-License-Identifier: MIT
#include "tests/faults/memory.h"

#include <atomic>
#include <cstdlib>
#include <malloc.h>
#include <new>

namespace {

using meshreel::faults::Scarcity;

std::atomic<std::size_t> now{0}, most{0}, count{0}, first_failing{Scarcity::none}, last_failing{Scarcity::none};
std::atomic<bool> scarce{false};

bool refused()
{
    if (!scarce) return false;
    const std::size_t number = count++;
    return number >= first_failing && number <= last_failing;
}

void* counted(std::size_t size, std::size_t alignment)
{
    if (refused()) throw std::bad_alloc();
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

Scarcity::Scarcity(std::size_t failing, Of of)
{
    count = 0;
    first_failing = failing;
    last_failing = of == Of::one ? failing : none - 1;
    scarce = true;
}
Scarcity::~Scarcity()
{
    scarce = false;
}
std::size_t Scarcity::asked() const
{
    return count;
}

} // namespace meshreel::faults

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
// What zstd and others in C take. What throws an exception takes its memory here too, and has a reserve.
extern "C" void* __libc_malloc(std::size_t size);
extern "C" void* __libc_calloc(std::size_t count, std::size_t size);

extern "C" void* malloc(std::size_t size)
{
    return refused() ? nullptr : __libc_malloc(size);
}
extern "C" void* calloc(std::size_t items, std::size_t size)
{
    return refused() ? nullptr : __libc_calloc(items, size);
}
#endif

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
