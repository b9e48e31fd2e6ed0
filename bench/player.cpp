/// Opening and posing against the bare matrix product, in one run: bench_player [--only NAME] [--codec NAME] ...
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <chrono>
#include <cstdio>
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

/// The best of several.
class Stopwatch {
public:
    template <class Work>
    void time(const Work& work)
    {
        const auto start = std::chrono::steady_clock::now();
        work();
        best_ = std::min(best_, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
    double seconds() const { return best_; }

private:
    double best_ = std::numeric_limits<double>::infinity();
};

struct Times {
    Stopwatch product, all, each, one, open, open_on_two;
};

Times measure(bench::Product& product, const Bytes& reel)
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
    }
    for (int i = 0; i < 5; ++i) {
        times.open.time([&] { (void)must(player::Player::open(reel, {.threads = {1}})); });
        times.open_on_two.time([&] { (void)must(player::Player::open(reel, {.threads = {2}})); });
    }
    return times;
}

void measure_and_print(const Source& source, const PlayerSettings& settings)
{
    const Animation animation = source.load();
    const Encoded encoded = must(encode(animation, settings.encode));
    const std::size_t V = animation.vertex_count, F = animation.frame_count(), K = encoded.bases;
    bench::Product product(V, K, F);
    const Times times = measure(product, encoded.bytes);
    const double unit = times.product.seconds();
    std::printf("%-14s %6zu %5zu %4zu %8.2f %8.0f %6.0f %6.0f %6.0f %7.1f %7.1f\n", source.name.c_str(), V, F, K,
                1e3 * unit, 6e-9 * static_cast<double>(V * K * F) / unit, 100 * unit / times.all.seconds(),
                100 * unit / times.each.seconds(), 100 * unit / static_cast<double>(F) / times.one.seconds(),
                times.open.seconds() / unit, times.open_on_two.seconds() / unit);
    std::fflush(stdout);
}

PlayerSettings player_settings(int count, char** texts)
{
    PlayerSettings settings;
    settings.encode.quality.kg = 0.1;
    settings.encode.segment = one_segment;
    for (int i = 1; i < count; ++i) {
        const std::string option = texts[i];
        const bool more = i + 1 < count;
        if (option == "--fast-decode")
            settings.encode.fast_decode = true;
        else if (option == "--only" && more)
            settings.only = texts[++i];
        else if (option == "--data" && more)
            settings.data = texts[++i];
        else if (option == "--codec" && more)
            settings.encode.codec = texts[++i];
        else if (option == "--kg" && more)
            settings.encode.quality.kg = std::stod(texts[++i]);
        else
            throw std::runtime_error("usage: bench_player [--only NAME] [--codec NAME] [--kg X] [--fast-decode] "
                                     "[--data FOLDER]");
    }
    return settings;
}

int run_player(int count, char** texts)
{
    const PlayerSettings settings = player_settings(count, texts);
    std::printf("codec %s, KG error %g %%, kernel %s; product: [V x K] [K x 3F] in float32 on one core; posing in "
                "percent of its speed;\nopening, on 1 and 2 threads, in products\n",
                settings.encode.codec.c_str(), *settings.encode.quality.kg,
                std::string(player::kernels().back().name).c_str());
    std::printf("%-14s %6s %5s %4s %8s %8s %6s %6s %6s %7s %7s\n", "sequence", "V", "F", "K", "prod. ms", "GFLOP/s",
                "all %", "each %", "one %", "open 1", "open 2");
    for (const Source& source : bench::sources(settings.data, settings.only)) measure_and_print(source, settings);
    return 0;
}

} // namespace

int main(int count, char** texts)
{
    try {
        return run_player(count, texts);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
