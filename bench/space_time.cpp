/// The 4D Hausdorff distance of a sequence to its decoded self, over F: bench_space_time [--data FOLDER] [--only NAME] [--threads N].
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/measured.h"
#include "bench/sources.h"
#include "meshreel/meshreel.h"
#include "meshreel/metrics/hausdorff_4d.h"

using namespace meshreel;
using bench::Measured;
using bench::must;

namespace {

struct SpaceTimeSettings {
    std::string data = bench::usual_data, only = "cloth";
    Threads threads{};
};

metrics::MovingMesh moving_mesh(const Animation& a)
{
    return {a, {a.positions.data(), a.frame_count(), 3ul * a.vertex_count}};
}

/// The F frames in the middle of an animation.
Animation middle_frames(const Animation& all, std::size_t F)
{
    const std::size_t first = (all.frame_count() - F) / 2, size = 3ul * all.vertex_count;
    Animation part = all;
    part.times_s.assign(all.times_s.begin() + static_cast<long>(first),
                        all.times_s.begin() + static_cast<long>(first + F));
    part.positions.assign(all.positions.begin() + static_cast<long>(first * size),
                          all.positions.begin() + static_cast<long>((first + F) * size));
    return part;
}

/// Seconds that one point takes with all tetrahedra of an interval, the smallest part of the naive search.
double seconds_a_naive_interval(const Animation& a)
{
    const std::vector<Tetrahedron> tetrahedra = interval_tetrahedra(a.triangles, a.vertex_count);
    const metrics::MovingMesh mesh = moving_mesh(a);
    const metrics::MovingSurface surface{a.vertex_count, tetrahedra, mesh.frames, a.times_s};
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 5; ++i) {
        const auto start = std::chrono::steady_clock::now();
        double nearest = std::numeric_limits<double>::infinity();
        for (std::size_t t = 0; t < tetrahedra.size(); ++t)
            nearest = std::min(
                nearest, metrics::squared_distance_to_tetrahedron(surface.point(0, 0), surface.corners(0, t), nearest));
        const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
        if (nearest >= 0.0) least = std::min(least, taken.count());
    }
    return least;
}

/// Both directions in a process of their own. figures: cells and entries an interval, megabytes of layers, processor seconds.
Measured measure_part(const Animation& a, const Animation& b, const metrics::Hausdorff4dOptions& options)
{
    const auto measured = bench::measure_apart(
        [&] {
            return [&](Measured& found) {
                const std::clock_t start = std::clock();
                const metrics::Hausdorff4d h = metrics::hausdorff_4d(moving_mesh(a), moving_mesh(b), options);
                const metrics::GridCost& cost = h.forward.cost;
                const auto layers = static_cast<double>(std::max<std::size_t>(1, cost.layers));
                found.figures = {static_cast<double>(cost.cells) / layers, static_cast<double>(cost.entries) / layers,
                                 static_cast<double>(cost.most_bytes) / 1e6,
                                 static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC};
            };
        },
        1);
    if (!measured) throw std::runtime_error("the measurement failed");
    return *measured;
}

void run_sequence(const bench::Source& source, const SpaceTimeSettings& settings)
{
    const Animation original = source.load();
    EncodeOptions encoding;
    encoding.quality.kg = 0.1;
    const Animation decoded = must(decode(must(encode(original, encoding)).bytes));
    const double naive = seconds_a_naive_interval(original);
    std::printf("%s: V %u, T %zu, decoded at a KG error of 0.1 %%\n", source.name.c_str(), original.vertex_count,
                original.triangles.size());
    std::printf(
        "   F  points a side  tetrahedra a side  seconds  processor s  ms a frame  times less than naive  cells  "
        "tetrahedra in cells  MB of cells  MB more\n");
    for (const double samples : {0.0, 0.5})
        for (const std::size_t F : {25ul, 50ul, 100ul, 200ul}) {
            if (F > original.frame_count()) continue;
            const Animation a = middle_frames(original, F), b = middle_frames(decoded, F);
            const Measured m = measure_part(a, b, {.samples = samples, .threads = settings.threads});
            const auto intervals = static_cast<double>(F - 1), T = static_cast<double>(a.triangles.size());
            const double points = a.vertex_count * static_cast<double>(F) + samples * T * intervals;
            std::printf("%4zu %14.0f %18.0f %8.2f %12.2f %11.1f %21.0f %6.0f %20.0f %12.1f %8.1f\n", F, points,
                        3 * T * intervals, m.seconds, m.figures[3], 1e3 * m.figures[3] / static_cast<double>(F),
                        2 * points * intervals * naive / m.figures[3], m.figures[0], m.figures[1], m.figures[2],
                        (m.peak_bytes - m.before_bytes) / 1e6);
            std::fflush(stdout);
        }
}

} // namespace

int main(int count, char** words)
{
    SpaceTimeSettings settings;
    const bench::Options options{
        {"--data", [&](const std::string& value) { settings.data = value; }},
        {"--only", [&](const std::string& value) { settings.only = value; }},
        {"--threads",
         [&](const std::string& value) { settings.threads.count = static_cast<unsigned>(std::stoul(value)); }},
    };
    return bench::program(count, words, options, [&] {
        for (const bench::Source& source : bench::sources(settings.data, settings.only)) run_sequence(source, settings);
        return 0;
    });
}
