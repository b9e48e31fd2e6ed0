/// bench_many [N]: N tiny animations (default 10 000) encoded and decoded in one process: time each, and whether memory grows.
// SPDX-License-Identifier: MIT
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <sys/resource.h>

#include "meshreel/mesh/shapes.h"
#include "meshreel/meshreel.h"

using namespace meshreel;

namespace {

long peak_kilobytes()
{
    struct rusage usage {};
    ::getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;
}

/// A wave of 20 to 119 vertices and 2 to 9 frames through the whole road. @return the file's bytes; 0: it failed.
std::size_t once(std::uint32_t number)
{
    const Animation a = *shapes::generate(*shapes::find("wave"),
                                          {.vertices = 20 + number % 100, .frames = 2 + number % 8, .seed = number});
    EncodeOptions options;
    options.quality.kg = 1.0;
    options.effort = 1;
    options.threads = {1};
    const auto encoded = encode(a, options);
    if (!encoded.ok()) return 0;
    const auto decoded = decode(encoded->bytes);
    return decoded.ok() && decoded->triangles == a.triangles ? encoded->bytes.size() : 0;
}

} // namespace

int main(int count, char** words)
{
    const std::uint32_t N = count > 1 ? static_cast<std::uint32_t>(std::atoi(words[1])) : 10'000;
    long early = 0;
    std::size_t bytes = 0;
    for (std::uint32_t number = 0; number < N; ++number) {
        const std::size_t size = once(number);
        if (size == 0) return 1;
        bytes += size;
        if (number == N / 10) early = peak_kilobytes();
    }
    std::printf("%u animations: %.3f ms of the processor and %.0f bytes each; at most %ld kB after a tenth, %ld kB at "
                "the end\n",
                N, 1e3 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC / N, static_cast<double>(bytes) / N, early,
                peak_kilobytes());
    return 0;
}
