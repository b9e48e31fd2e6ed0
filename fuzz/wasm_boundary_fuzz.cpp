/// Feeds any bytes through the functions that JavaScript calls, built as for WebAssembly but run here, as a browser would.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include "fuzz/reel_mutator.h"
#include "incoming.h"

namespace {

/// What the host throws.
struct Raised {};

} // namespace

namespace meshreel {

[[noreturn]] void raise(ErrorCode /*code*/, std::string_view message, std::string_view /*field*/, std::int64_t /*byte*/)
{
    if (message.empty()) std::abort();
    throw Raised{};
}

} // namespace meshreel

#define MESHREEL_HOST_RAISES // ours, above
#include "wasm/api.cpp"

namespace {

/// Reads whatever the host may read: the sanitizer sees to the rest.
unsigned read_arrays(const Handle* handle)
{
    unsigned sum = 0;
    const auto read = [&](int what, std::size_t i) {
        const auto* bytes = static_cast<const std::uint8_t*>(reel_at(handle, what, i));
        for (std::size_t n = reel_size(handle, what, i), k = 0; k < n; ++k) sum += bytes[k];
    };
    for (const int what : {0, 1, 2, 3, 4, 5, 20, 21, 22, 23}) read(what, 0);
    const int counted[] = {9, 14, 15, 16};
    const std::initializer_list<int> arrays[] = {{6, 7, 8}, {9}, {10}, {11, 12, 13}};
    for (std::size_t kind = 0; kind < std::size(counted); ++kind)
        for (std::size_t i = 0; i < static_cast<std::size_t>(reel_number(handle, counted[kind], 0)); ++i)
            for (const int what : arrays[kind]) read(what, i);
    return sum;
}

void feed(Handle* handle, const std::uint8_t* data, std::size_t size)
{
    const std::size_t piece = 1 + size / 3;
    for (std::size_t at = 0; at < size; at += piece) {
        const std::size_t count = std::min(piece, size - at);
        std::memcpy(reel_room(handle, count), data + at, count);
        reel_receive(handle, count);
        const bool complete = at + count == size;
        for (int event = 1; event != 0 && event != 4;) {
            event = reel_step(handle, complete ? 1 : 0);
            if (event == 2 || event == 3) reel_frames(handle);
            if (event != 0) (void)read_arrays(handle);
        }
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    if (size == 0) return 0;
    constexpr double memory = 64 << 20;
    struct Wish {
        std::uint32_t level;
        int alone;
    };
    for (const Wish wish : {Wish{0, 0}, Wish{1, 0}, Wish{1, 1}}) {
        Handle* const handle = reel_open(wish.level, wish.alone, memory);
        try {
            feed(handle, data, size);
        } catch (const Raised&) { // as JavaScript: the decoder is given up
        }
        reel_close(handle);
    }
    return 0;
}
