/// Opening and posing against the bare matrix product, in one run: bench_player [--only NAME] [--codec NAME] ...
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <limits>
#include <string>

#include "bench/product.h"
#include "bench/sources.h"
#include "meshreel/meshreel.h"
#include "meshreel/player/player.h"

using namespace meshreel;
using bench::must;
using bench::Source;

namespace {

struct PlayerSettings {
    std::string data = bench::usual_data;
    std::string only; ///< a part of the names wanted; empty: all
    EncodeOptions encode;
};

double clock_s()
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// What all threads of this program have used: what else the machine does counts less.
double processor_s()
{
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// The best of several.
class Stopwatch {
public:
    template <class Work>
    void time(const Work& work, double (*now)() = clock_s)
    {
        const double start = now();
        work();
        best_ = std::min(best_, now() - start);
    }
    double seconds() const { return best_; }

private:
    double best_ = std::numeric_limits<double>::infinity();
};

struct Times {
    Stopwatch product, all, each, one;
    std::array<Stopwatch, 2> usual, fast; ///< opening on one core (processor time) and on 2 threads (by the clock)
};

void open_both_ways(const Bytes& reel, std::array<Stopwatch, 2>& times)
{
    times[0].time([&] { (void)must(player::Player::open(reel, {.threads = {1}})); }, processor_s);
    times[1].time([&] { (void)must(player::Player::open(reel, {.threads = {2}})); });
}

Times measure(bench::Product& product, const Bytes& reel, const Bytes& fast)
{
    Times times;
    player::Player player = must(player::Player::open(reel));
    const std::size_t F = player.frame_count(), numbers = 3ul * player.vertex_count();
    std::vector<float> frame(numbers), frames(F * numbers);
    for (std::size_t i = 0; i < 30; ++i) { // in turn, so that what disturbs one disturbs all
        times.product.time([&] { product.run(); });
        times.all.time([&] { player.pose_frames(0, frames); });
        times.each.time([&] {
            for (std::size_t f = 0; f < F; ++f) {
                player.seek_frame(f);
                player.pose(frame);
            }
        });
        for (std::size_t j = 0; j < 10; ++j)
            times.one.time([&] {
                player.seek(player.times_s()[(7 * (10 * i + j)) % F]);
                player.pose(frame);
            });
        open_both_ways(reel, times.usual);
        open_both_ways(fast, times.fast);
    }
    return times;
}

void measure_and_print(const Source& source, const PlayerSettings& settings)
{
    const Animation animation = source.load();
    EncodeOptions options = settings.encode;
    const Encoded encoded = must(encode(animation, options));
    options.fast_decode = true;
    const Encoded fast = must(encode(animation, options));
    const std::size_t V = animation.vertex_count, F = animation.frame_count(), K = encoded.bases;
    bench::Product product(V, K, F);
    const Times times = measure(product, encoded.bytes, fast.bytes);
    const double unit = times.product.seconds();
    std::printf("%-14s %6zu %5zu %4zu %8.2f %8.0f %6.0f %6.0f %6.0f", source.name.c_str(), V, F, K, 1e3 * unit,
                6e-9 * static_cast<double>(V * K * F) / unit, 100 * unit / times.all.seconds(),
                100 * unit / times.each.seconds(), 100 * unit / static_cast<double>(F) / times.one.seconds());
    std::printf(" %7.4f %6.1f %6.1f %+6.1f %6.1f %6.1f\n", encoded.bpfv, times.usual[0].seconds() / unit,
                times.usual[1].seconds() / unit,
                100 * (static_cast<double>(fast.bytes.size()) / static_cast<double>(encoded.bytes.size()) - 1),
                times.fast[0].seconds() / unit, times.fast[1].seconds() / unit);
    std::fflush(stdout);
}

int run_player(const PlayerSettings& settings)
{
    std::printf(
        "codec %s, KG error %g %%, kernel %s; product: [V x K] [K x 3F] in float32 on one core; posing in "
        "percent of its speed;\nopening, on 1 and 2 threads, in products, then for --fast-decode, after what it adds "
        "to the bits in percent\n",
        settings.encode.codec.c_str(), *settings.encode.quality.kg, std::string(player::kernels().back().name).c_str());
    std::printf("%-14s %6s %5s %4s %8s %8s %6s %6s %6s %7s %6s %6s %6s %6s %6s\n", "sequence", "V", "F", "K",
                "prod. ms", "GFLOP/s", "all %", "each %", "one %", "bpfv", "open 1", "open 2", "fast %", "open 1",
                "open 2");
    for (const Source& source : bench::sources(settings.data, settings.only)) measure_and_print(source, settings);
    return 0;
}

} // namespace

int main(int count, char** words)
{
    PlayerSettings settings;
    settings.encode.quality.kg = 0.1;
    settings.encode.segment = one_segment;
    const bench::Options options{
        {"--only", [&](const std::string& value) { settings.only = value; }},
        {"--data", [&](const std::string& value) { settings.data = value; }},
        {"--codec", [&](const std::string& value) { settings.encode.codec = value; }},
        {"--kg", [&](const std::string& value) { settings.encode.quality.kg = std::stod(value); }},
    };
    return bench::program(count, words, options, [&] { return run_player(settings); });
}
