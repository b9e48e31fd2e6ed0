/// Feeds any bytes to the decoder with one thread and with three: the same animation to the bit, or the same refusal.
// SPDX-License-Identifier: MIT
#include <cstring>

#include "fuzz/reel_mutator.h"
#include "meshreel/meshreel.h"

using namespace meshreel;

namespace {

void require_same(const Result<Animation>& a, const Result<Animation>& b)
{
    if (a.ok() != b.ok()) __builtin_trap();
    if (!a.ok()) {
        if (a.error().code != b.error().code || a.error().field != b.error().field) __builtin_trap();
        return;
    }
    if (a->triangles != b->triangles || a->times_s != b->times_s) __builtin_trap();
    if (a->positions.size() != b->positions.size()) __builtin_trap();
    if (std::memcmp(a->positions.data(), b->positions.data(), a->positions.size() * sizeof(float)) != 0)
        __builtin_trap();
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    DecodeOptions one, three;
    one.limits.max_memory = three.limits.max_memory = 32u << 20;
    one.threads = {1};
    three.threads = {3};
    for (const std::uint32_t level : {0u, 1u}) {
        one.level = three.level = level;
        require_same(decode({data, size}, one), decode({data, size}, three));
    }
    return 0;
}
