/// malloc and free in little code: free blocks in the order of their addresses, the first that is large enough is taken.
// SPDX-License-Identifier: MIT
//
// Small ones are kept apart, by their size: there may be many, and none must be searched for.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <utility>

extern "C" std::byte __heap_base; // of the linker: the first byte that nothing else uses

namespace {

constexpr std::size_t page_bytes = 1u << 16;

/// Stands before what malloc gives, whose addresses are multiples of 8.
struct HeapBlock {
    std::size_t bytes; ///< with this
    HeapBlock* next;   ///< while it is free

    HeapBlock* end() { return reinterpret_cast<HeapBlock*>(reinterpret_cast<std::byte*>(this) + bytes); }
};

constexpr std::size_t small_bytes = 256; ///< with the head
HeapBlock* small_free[small_bytes / 8 + 1];

HeapBlock first_free; ///< stands for none: before all others

/// More memory from the host, as a free block. @return whether there was as much.
bool grow(std::size_t bytes)
{
    static bool begun = false;
    const std::size_t pages = (bytes + page_bytes - 1) / page_bytes;
    const std::size_t before = __builtin_wasm_memory_grow(0, pages);
    if (before == ~std::size_t{0}) return false;
    auto* block = reinterpret_cast<HeapBlock*>(before * page_bytes);
    block->bytes = pages * page_bytes;
    if (!begun) { // what the first pages have left
        const auto base = (reinterpret_cast<std::size_t>(&__heap_base) + 7) & ~std::size_t{7};
        block->bytes += reinterpret_cast<std::size_t>(block) - base;
        *reinterpret_cast<std::size_t*>(base) = block->bytes;
        block = reinterpret_cast<HeapBlock*>(base);
        begun = true;
    }
    std::free(block + 1);
    return true;
}

} // namespace

extern "C" {

void* malloc(std::size_t count)
{
    if (count > 0x7fff0000) return nullptr;
    const std::size_t bytes = (count + sizeof(HeapBlock) + 7) & ~std::size_t{7};
    if (bytes <= small_bytes) {
        HeapBlock*& kept = small_free[bytes / 8];
        if (HeapBlock* block = kept) {
            kept = block->next;
            return block + 1;
        }
    }
    do {
        for (HeapBlock* before = &first_free; HeapBlock* block = before->next; before = block) {
            if (block->bytes < bytes) continue;
            before->next = block->next;
            if (block->bytes - bytes > sizeof(HeapBlock)) {
                const std::size_t rest = block->bytes - bytes;
                block->bytes = bytes;
                before->next = block->end();
                *before->next = {rest, block->next};
            }
            return block + 1;
        }
    } while (grow(bytes));
    return nullptr;
}

void free(void* given)
{
    if (given == nullptr) return;
    HeapBlock* block = static_cast<HeapBlock*>(given) - 1;
    if (block->bytes <= small_bytes) {
        block->next = std::exchange(small_free[block->bytes / 8], block);
        return;
    }
    HeapBlock* before = &first_free;
    while (before->next != nullptr && before->next < block) before = before->next;
    const auto join = [](HeapBlock* a, HeapBlock* b) {
        a->next = b;
        if (a->end() != b) return;
        a->bytes += b->bytes;
        a->next = b->next;
    };
    join(block, before->next);
    if (before == &first_free)
        before->next = block;
    else
        join(before, block);
}
}

void* operator new(std::size_t count)
{
    if (void* found = std::malloc(count)) return found;
    std::abort();
}
void operator delete(void* given) noexcept
{
    std::free(given);
}
void operator delete(void* given, std::size_t) noexcept
{
    std::free(given);
}
