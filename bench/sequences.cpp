/// Speeds and memory of encoding, decoding and PCA for every real sequence at hand and every generated shape.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/Dense>

#include "bench/measured.h"
#include "bench/sources.h"
#include "meshreel/linalg/pca.h"
#include "meshreel/meshreel.h"

using namespace meshreel;
using bench::measure_apart;
using bench::Measured;
using bench::must;
using bench::Source;

namespace {

constexpr std::size_t prepared_bases = 256; // as many as the encoder begins with

struct Settings {
    std::string data = bench::usual_data;
    std::string csv;
    std::string only; ///< a part of the names wanted; empty: all
    Threads threads{1};
};

/// One line of the table. Rates are megabytes of float32 positions a second.
struct Row {
    std::string name;
    double vertices = 0, frames = 0, megabytes = 0, bases = 0, bpfv = 0;
    double encode = 0, decode = 0, copy = 0, product = 0;
    double encode_peak = 0, decode_peak = 0; ///< megabytes
    double pca_seconds = 0, pca_times = 0;   ///< peak of PCA as a multiple of the animation, the animation included
};

/// The time of encoding over that of ten PCAs and a decode.
double encode_share(const Row& row)
{
    return row.megabytes / row.encode / (10 * row.pca_seconds + row.megabytes / row.decode);
}

double rate(const Row& row, const std::optional<Measured>& measured)
{
    return measured ? row.megabytes / measured->seconds : 0.0;
}

void measure_pca(Row& row, const Source& source, const Settings& settings)
{
    const auto pca = measure_apart(
        [&] {
            auto animation = std::make_shared<Animation>(source.load());
            return [animation, &settings](Measured&) {
                const MatrixView<const float> frames{animation->positions.data(), animation->frame_count(),
                                                     3ul * animation->vertex_count};
                (void)linalg::pca_of_trajectories(frames, prepared_bases, settings.threads);
            };
        },
        3);
    if (!pca) return;
    row.pca_seconds = pca->seconds;
    row.pca_times = 1.0 + (pca->peak_bytes - pca->before_bytes) / (1e6 * row.megabytes);
}

EncodeOptions encode_options(const Settings& settings)
{
    EncodeOptions options;
    options.quality.kg = 0.1;
    options.threads = settings.threads;
    return options;
}

void measure_encode(Row& row, const Source& source, const Settings& settings)
{
    const auto encoded = measure_apart(
        [&] {
            auto animation = std::make_shared<Animation>(source.load());
            return [animation, &settings](Measured& measured) {
                const Encoded result = must(encode(*animation, encode_options(settings)));
                measured.figures = {result.bpfv, static_cast<double>(result.bases)};
            };
        },
        1);
    if (!encoded) return;
    row.encode = rate(row, encoded);
    row.encode_peak = encoded->peak_bytes / 1e6;
    row.bpfv = encoded->figures[0];
    row.bases = encoded->figures[1];
}

void measure_decode(Row& row, const Source& source, const Settings& settings)
{
    const auto decoded = measure_apart(
        [&] {
            auto reel = std::make_shared<Bytes>(must(encode(source.load(), encode_options(settings))).bytes);
            return [reel, &settings](Measured&) {
                DecodeOptions options;
                options.threads = settings.threads;
                (void)must(decode(*reel, options));
            };
        },
        5);
    if (!decoded) return;
    row.decode = rate(row, decoded);
    row.decode_peak = decoded->peak_bytes / 1e6;
}

/// What no decoder can beat: a copy, and the product of coefficients and basis, [V x K] [K x 3F].
void measure_limits(Row& row)
{
    const auto copied = measure_apart(
        [&] {
            const std::size_t size = static_cast<std::size_t>(row.megabytes * 1e6);
            auto from = std::make_shared<Bytes>(size, std::uint8_t{1});
            auto to = std::make_shared<Bytes>(size, std::uint8_t{2});
            return [from, to](Measured& measured) {
                std::memcpy(to->data(), from->data(), to->size());
                measured.figures[0] += (*to)[to->size() / 2];
            };
        },
        9);
    const auto multiplied = measure_apart(
        [&] {
            using Dense = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
            const auto size = [](double x) { return static_cast<Eigen::Index>(x); };
            auto coefficients = std::make_shared<Dense>(Dense::Random(size(row.vertices), size(row.bases)));
            auto basis = std::make_shared<Dense>(Dense::Random(size(row.bases), size(3 * row.frames)));
            auto positions = std::make_shared<Dense>(Dense::Zero(size(row.vertices), size(3 * row.frames)));
            return [=](Measured& measured) {
                positions->noalias() = *coefficients * *basis;
                measured.figures[0] += (*positions)(0, 0);
            };
        },
        5);
    row.copy = rate(row, copied);
    row.product = rate(row, multiplied);
}

Row described(const Source& source)
{
    Row row;
    row.name = source.name;
    const Animation animation = source.load();
    row.vertices = animation.vertex_count;
    row.frames = static_cast<double>(animation.frame_count());
    row.megabytes = static_cast<double>(animation.positions.size() * sizeof(float)) / 1e6;
    return row;
}

Row measure(const Source& source, const Settings& settings)
{
    Row row = described(source);
    measure_pca(row, source, settings);
    measure_encode(row, source, settings);
    measure_decode(row, source, settings);
    measure_limits(row);
    return row;
}

void print(const Row& row, std::FILE* csv)
{
    std::printf("%-14s %6.0f %5.0f %7.1f %4.0f %7.3f %8.2f %8.1f %8.0f %8.0f %8.0f %8.0f %7.2f %6.2f %7.2f\n",
                row.name.c_str(), row.vertices, row.frames, row.megabytes, row.bases, row.bpfv, row.encode, row.decode,
                row.copy, row.product, row.encode_peak, row.decode_peak, row.pca_seconds, row.pca_times,
                encode_share(row));
    std::fflush(stdout);
    if (csv != nullptr)
        std::fprintf(csv, "%s,%.0f,%.0f,%.3f,%.0f,%.4f,%.3f,%.3f,%.1f,%.1f,%.1f,%.1f,%.3f,%.3f,%.3f\n",
                     row.name.c_str(), row.vertices, row.frames, row.megabytes, row.bases, row.bpfv, row.encode,
                     row.decode, row.copy, row.product, row.encode_peak, row.decode_peak, row.pca_seconds,
                     row.pca_times, encode_share(row));
}

int run(const Settings& settings)
{
    std::FILE* csv = settings.csv.empty() ? nullptr : std::fopen(settings.csv.c_str(), "w");
    if (!settings.csv.empty() && csv == nullptr) throw std::runtime_error("cannot write " + settings.csv);
    const char* head = "sequence,V,F,MB,K,bpfv,encode MB/s,decode MB/s,memcpy MB/s,product MB/s,encode peak MB,"
                       "decode peak MB,PCA s,PCA memory / animation,encode / (10 PCA + decode)";
    if (csv != nullptr) std::fprintf(csv, "%s\n", head);
    std::printf(
        "%u thread(s); rates in megabytes of float32 positions a second; KG error 0.1 %%\n%-14s %6s %5s %7s %4s "
        "%7s %8s %8s %8s %8s %8s %8s %7s %6s %7s\n",
        settings.threads.used(), "sequence", "V", "F", "MB", "K", "bpfv", "encode", "decode", "memcpy", "product",
        "enc.pkMB", "dec.pkMB", "PCA s", "PCA x", "enc/PCA");
    for (const Source& source : bench::sources(settings.data, settings.only)) print(measure(source, settings), csv);
    return csv == nullptr || std::fclose(csv) == 0 ? 0 : 1;
}

} // namespace

int main(int count, char** words)
{
    Settings settings;
    const bench::Options options{
        {"--csv", [&](const std::string& value) { settings.csv = value; }},
        {"--only", [&](const std::string& value) { settings.only = value; }},
        {"--data", [&](const std::string& value) { settings.data = value; }},
        {"--threads",
         [&](const std::string& value) { settings.threads.count = static_cast<unsigned>(std::stoul(value)); }},
    };
    return bench::program(count, words, options, [&] { return run(settings); });
}
