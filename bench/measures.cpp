/// Measures against one plain pass over both arrays, in one run, one thread: bench_measures [--data FOLDER] [--only NAME] [-n N].
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <limits>
#include <string>
#include <vector>

#include "bench/sources.h"
#include "meshreel/base/random.h"
#include "meshreel/metrics/kg.h"
#include "meshreel/metrics/measure.h"

using namespace meshreel;

namespace {

struct MeasureSettings {
    std::string data = bench::usual_data, only = "walker";
    int repetitions = 5;
};

/// What this program has used of a processor: what else the machine does counts less.
double used_processor_s()
{
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// What one plain pass is: the sum of squared differences of both arrays, read once from memory. Eight sums side by side,
/// so that memory bounds it and not the latency of an addition.
double plain_pass(const metrics::Pair<float>& pair)
{
    const std::span<const float> original = pair.original.values(), distorted = pair.distorted.values();
    double sums[8] = {};
    for (std::size_t i = 0; i + 8 <= original.size(); i += 8)
        for (std::size_t lane = 0; lane < 8; ++lane) {
            const double d = double{original[i + lane]} - distorted[i + lane];
            sums[lane] += d * d;
        }
    double sum = 0;
    for (const double part : sums) sum += part;
    return sum;
}

/// One row: a name, and the work whose result is kept, so that nobody leaves it out.
struct MeasureRow {
    std::string name;
    double (*work)(const Animation& original, const Animation& distorted);
    double seconds = std::numeric_limits<double>::infinity(), result = 0.0;
};

template <const char* Name>
double value_of(const Animation& original, const Animation& distorted)
{
    return metrics::measure(original, distorted, {metrics::find(Name)}, {Threads{1}})->values[0];
}

constexpr char kg_name[] = "kg", sted_name[] = "sted", da_name[] = "da", td_name[] = "td", ev_name[] = "ev",
               wev_name[] = "wev", error_name[] = "vertex_error";

std::vector<MeasureRow> measure_rows()
{
    return {{"plain pass", [](const Animation& a, const Animation& b) { return plain_pass(metrics::pair_of(a, b)); }},
            {"kg", value_of<kg_name>},
            {"vertex_error", value_of<error_name>},
            {"da", value_of<da_name>},
            {"td", value_of<td_name>},
            {"ev", value_of<ev_name>},
            {"wev", value_of<wev_name>},
            {"sted", value_of<sted_name>}};
}

Animation shaken(Animation animation)
{
    Random random(5);
    const double size = 1e-3 * body_diagonal(animation);
    for (float& value : animation.positions) value += static_cast<float>(random.uniform(-size, size));
    return animation;
}

void run_source(const bench::Source& source, int repetitions)
{
    const Animation original = source.load(), distorted = shaken(original);
    std::vector<MeasureRow> rows = measure_rows();
    for (int i = 0; i < repetitions; ++i)
        for (MeasureRow& row : rows) {
            const double start = used_processor_s();
            row.result = row.work(original, distorted);
            row.seconds = std::min(row.seconds, used_processor_s() - start);
        }
    std::printf("%s: V %u, T %zu, F %zu\n", source.name.c_str(), original.vertex_count, original.triangles.size(),
                original.frame_count());
    for (const MeasureRow& row : rows)
        std::printf("  %-14s %10.2f ms %8.2f x   (%.6g)\n", row.name.c_str(), 1e3 * row.seconds,
                    row.seconds / rows.front().seconds, row.result);
}

} // namespace

int main(int count, char** words)
{
    MeasureSettings settings;
    const bench::Options options{
        {"--data", [&](const std::string& value) { settings.data = value; }},
        {"--only", [&](const std::string& value) { settings.only = value; }},
        {"-n", [&](const std::string& value) { settings.repetitions = std::stoi(value); }},
    };
    return bench::program(count, words, options, [&] {
        for (const bench::Source& source : bench::sources(settings.data, settings.only))
            run_source(source, settings.repetitions);
        return 0;
    });
}
