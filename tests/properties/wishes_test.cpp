/// The seven wishes of thesis 5.6 for a measure: which value keeps which is the table of docs/metrics.md, made by this test.
// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <numbers>
#include <sstream>

#include "meshreel/base/exact.h"
#include "meshreel/base/file.h"
#include "meshreel/base/random.h"
#include "meshreel/io/scores.h"
#include "meshreel/metrics/correlation.h"
#include "meshreel/metrics/measure.h"

using namespace meshreel;

namespace {

constexpr std::uint32_t wish_side = 9, wish_period = 8;
constexpr double amount = 1.0 / 32.0; ///< of a distortion, where an edge has length 1

using Point = std::array<double, 3>;
/// Where vertex v goes in frame f.
using Motion = std::function<Point(std::size_t v, std::size_t f, Point p)>;

/// Coordinates are multiples of 2^-14, so that small shifts lose nothing.
Animation wish_moved(Animation animation, const Motion& motion)
{
    for (std::size_t f = 0; f < animation.frame_count(); ++f)
        for (std::size_t v = 0; v < animation.vertex_count; ++v) {
            float* const p = animation.frame(f).data() + 3 * v;
            const Point moved = motion(v, f, {p[0], p[1], p[2]});
            for (std::size_t axis = 0; axis < 3; ++axis)
                p[axis] = static_cast<float>(static_cast<double>(exact::round(moved[axis] * 16384.0)) / 16384.0);
        }
    return animation;
}

/// A square sheet with waves that come back after wish_period frames.
Animation sheet(std::size_t frames)
{
    Animation animation;
    animation.vertex_count = wish_side * wish_side;
    animation.times_s = uniform_times(frames, 25.0);
    animation.positions.resize(frames * animation.vertex_count * 3);
    for (std::uint32_t i = 0; i + 1 < wish_side; ++i)
        for (std::uint32_t j = 0; j + 1 < wish_side; ++j) {
            const std::uint32_t v = wish_side * i + j, below = v + wish_side;
            animation.triangles.push_back({v, v + 1, below});
            animation.triangles.push_back({v + 1, below + 1, below});
        }
    return wish_moved(std::move(animation), [](std::size_t v, std::size_t f, Point) {
        const double x = static_cast<double>(v % wish_side), y = static_cast<double>(v / wish_side),
                     phase = 2.0 * std::numbers::pi * static_cast<double>(f % wish_period) / wish_period;
        return Point{x, y, 0.7 * std::sin(0.6 * x + phase) + 0.4 * std::sin(0.5 * y - phase)};
    });
}

/// How far each vertex is shifted: random, and the same amounts again after wish_period frames.
Point noise(std::size_t v, std::size_t f, Point p)
{
    Random random(1000 * (f % wish_period) + v);
    for (double& x : p) x += random.uniform(-amount, amount);
    return {p[0] + 2.0 * random.uniform(-amount, amount), p[1], p[2]};
}

/// Amounts that change smoothly over the sheet, or the same amounts shuffled.
std::vector<double> amounts(bool shuffled)
{
    std::vector<double> all;
    for (std::size_t v = 0; v < wish_side * wish_side; ++v)
        all.push_back(2.0 * amount * std::sin(0.7 * static_cast<double>(v % wish_side)));
    Random random(7);
    for (std::size_t i = all.size() - 1; i > 0 && shuffled; --i) std::swap(all[i], all[random.below(i + 1)]);
    return all;
}

/// How bad a value is, as a factor: decibels are taken out of their logarithm.
double badness(const metrics::Value& value, double number)
{
    if (value.unit != "dB") return number;
    return std::pow(10.0, (value.better == metrics::Better::less ? number : -number) / 20.0);
}

class Wishes {
public:
    explicit Wishes(metrics::FoundValue value) : value_(value) {}

    /// Whether the value is the same when both animations are changed.
    bool invariant(const Motion& change) const
    {
        const Animation original = sheet(wish_period), distorted = wish_moved(original, noise);
        return same(measure(wish_moved(original, change), wish_moved(distorted, change)), measure(original, distorted));
    }
    bool does_not_grow_with_duration() const
    {
        const Animation once = sheet(wish_period), thrice = sheet(3 * wish_period);
        return same(measure(thrice, wish_moved(thrice, noise)), measure(once, wish_moved(once, noise)), 0.1);
    }
    /// How much worse shuffled shifts are than smooth ones of the same amounts.
    double rough_against_smooth() const
    {
        const auto with = [&](bool shuffled) {
            return measure_motion([all = amounts(shuffled)](std::size_t v, std::size_t, Point p) {
                return Point{p[0], p[1], p[2] + all[v]};
            });
        };
        return with(true) / with(false);
    }
    /// How much worse a shift is that turns back every frame than one that stays.
    double shaking_against_still() const
    {
        const auto with = [&](bool shaking) {
            return measure_motion([shaking](std::size_t, std::size_t f, Point p) {
                return Point{p[0], p[1], p[2] + (shaking && f % 2 == 1 ? -amount : amount)};
            });
        };
        return with(true) / with(false);
    }

private:
    static bool same(double a, double b, double tolerance = 0.01) { return std::abs(a / b - 1.0) <= tolerance; }
    double measure(const Animation& original, const Animation& distorted) const
    {
        const metrics::Value& value = value_.metric->values[value_.index];
        return badness(value, (*metrics::measure(original, distorted, {value_.metric})).values[value_.index]);
    }
    double measure_motion(const Motion& motion) const
    {
        return measure(sheet(wish_period), wish_moved(sheet(wish_period), motion));
    }

    metrics::FoundValue value_;
};

/// "yes", or "likes it" where the worse animation gets the better value.
std::string detection(double ratio)
{
    return ratio > 1.5 ? "yes" : ratio < 1 / 1.5 ? "likes them" : "";
}

/// The lowest of the correlations with what people saw that follow from the thesis' tables 7.3 to 7.5.
std::string agreement(std::string_view name)
{
    constexpr std::array<std::array<std::string_view, 3>, 9> printed{{{"kg", "table_7_3", "KG error"},
                                                                      {"da", "table_7_3", "Ribbon mean"},
                                                                      {"da_peak", "table_7_3", "Ribbon peak"},
                                                                      {"td", "table_7_3", "TD error"},
                                                                      {"wev", "table_7_3", "WEV 5"},
                                                                      {"sted", "table_7_5", "STED"},
                                                                      {"sted_spatial", "table_7_4", "STED spatial"},
                                                                      {"hausdorff", "table_7_3", "Hausdorff"},
                                                                      {"surface_rms", "table_7_3", "RMS"}}};
    const auto row = std::ranges::find(printed, name, [](const auto& one) { return one[0]; });
    if (row == printed.end()) return "";
    const std::string path = std::string(MESHREEL_SOURCE_DIR "/tests/metrics/study/").append((*row)[1]).append(".csv");
    const io::Scores scores = *io::read_scores(*io::parse_csv(*read_file(path)));
    const auto measure = std::ranges::find(scores.measures, (*row)[2], &io::ScoredMeasure::name);
    double lowest = 1.0;
    for (std::size_t dataset = 0; dataset < scores.datasets.size(); ++dataset) {
        std::vector<double> x, y;
        for (std::size_t i = 0; i < scores.stimuli.size(); ++i) {
            if (scores.stimuli[i].dataset != dataset) continue;
            x.push_back(*measure->values[i]);
            y.push_back(scores.stimuli[i].mos);
        }
        lowest = std::min(lowest, *metrics::pearson(x, y).value);
    }
    std::ostringstream text;
    text.precision(2);
    text << std::fixed << lowest;
    return text.str();
}

Point wish_shifted(std::size_t, std::size_t, Point p)
{
    return {p[0] + 5, p[1] - 3, p[2] + 2};
}
Point wish_turned(std::size_t, std::size_t, Point p) // by the angle whose cosine is 0.6, about two axes
{
    p = {0.6 * p[0] - 0.8 * p[1], 0.8 * p[0] + 0.6 * p[1], p[2]};
    return {p[0], 0.6 * p[1] - 0.8 * p[2], 0.8 * p[1] + 0.6 * p[2]};
}
Point wish_scaled(std::size_t, std::size_t, Point p)
{
    return {2 * p[0], 2 * p[1], 2 * p[2]};
}

/// One row; the wishes that a value promises are compared with what it does.
std::string wish_row(metrics::FoundValue found)
{
    const metrics::Value& value = found.metric->values[found.index];
    const Wishes wishes(found);
    const bool shift = wishes.invariant(wish_shifted), turn = wishes.invariant(wish_turned),
               scale = wishes.invariant(wish_scaled), duration = wishes.does_not_grow_with_duration();
    EXPECT_EQ(shift, value.invariance.translation) << value.name;
    EXPECT_EQ(turn, value.invariance.rotation) << value.name;
    EXPECT_EQ(scale, value.invariance.scale) << value.name;
    EXPECT_EQ(duration, value.invariance.duration) << value.name;
    const auto yes = [](bool kept) { return kept ? "yes" : ""; };
    std::ostringstream text;
    text << "| `" << value.name << "` | " << yes(shift) << " | " << yes(turn) << " | " << yes(scale) << " | "
         << yes(duration) << " | " << detection(wishes.rough_against_smooth()) << " | "
         << detection(wishes.shaking_against_still()) << " | " << agreement(value.name) << " |\n";
    return text.str();
}

std::string wishes_table()
{
    std::string table = "| value | 1 shift | 2 rotation | 3 scale | 4 duration | 5 rough errors | 6 shaking errors | "
                        "7 people |\n|---|---|---|---|---|---|---|---|\n";
    for (const metrics::Metric& metric : metrics::all())
        for (std::size_t i = 0; i < metric.values.size(); ++i) table += wish_row({&metric, i});
    return table;
}

/// The page of a measure beside its source.
std::string page_of(const metrics::Metric& metric)
{
    const std::string_view name = metric.name == "ev" || metric.name == "wev" ? "error_vectors" : metric.name;
    return std::string("src/meshreel/metrics/").append(name).append(".md");
}

std::string values_table()
{
    std::ostringstream table;
    table << "| measure | needs in common | value | what | unit | better | source |\n|---|---|---|---|---|---|---|\n";
    for (const metrics::Metric& metric : metrics::all())
        for (const metrics::Value& value : metric.values) {
            const bool first = &value == &metric.values.front();
            constexpr std::array needs{"nothing", "F", "V, F, triangles"};
            table << "| ";
            if (first)
                table << "[`" << metric.name << "`](../" << page_of(metric) << ")" << (metric.slow ? ", slow" : "");
            table << " | " << (first ? needs[static_cast<std::size_t>(metric.common)] : "") << " | `" << value.name
                  << "` | " << value.title << " | " << value.unit << " | "
                  << (value.better == metrics::Better::less ? "less" : "more") << " | " << value.source << " |\n";
        }
    return table.str();
}

std::string parameters_table()
{
    std::ostringstream table;
    table << "| parameter | what | unit | default | from | to |\n|---|---|---|---|---|---|\n";
    for (const metrics::Metric& metric : metrics::all())
        for (const metrics::Parameter& parameter : metric.parameters)
            table << "| `" << metric.name << "." << parameter.name << "` | " << parameter.title << " | "
                  << parameter.unit << " | " << parameter.usual << " | " << parameter.least << " | " << parameter.most
                  << " |\n";
    return table.str();
}

/// Compares a part of docs/metrics.md, or renews it.
void expect_documented(const std::string& part, const std::string& table)
{
    const std::string path = MESHREEL_SOURCE_DIR "/docs/metrics.md",
                      head = "<!-- made by tests/properties/wishes_test.cpp: " + part + " -->\n";
    const Bytes bytes = *read_file(path);
    const std::string page(bytes.begin(), bytes.end());
    ASSERT_NE(page.find(head), std::string::npos) << head;
    const std::size_t begin = page.find(head) + head.size(), end = page.find("<!-- up to here -->", begin);
    ASSERT_NE(end, std::string::npos);
    if (std::getenv("MESHREEL_UPDATE") != nullptr)
        std::ofstream(path, std::ios::binary) << page.substr(0, begin) + table + page.substr(end);
    else
        EXPECT_EQ(page.substr(begin, end - begin), table) << "MESHREEL_UPDATE=1 renews docs/metrics.md";
}

} // namespace

TEST(Wishes, AreKeptAsTheTableInTheDocumentationSays)
{
    expect_documented("wishes", wishes_table());
}

TEST(Wishes, ValuesAndParametersAreThoseOfTheDocumentation)
{
    expect_documented("values", values_table());
    expect_documented("parameters", parameters_table());
}

TEST(Wishes, EveryMeasureHasItsPage)
{
    for (const metrics::Metric& metric : metrics::all())
        EXPECT_TRUE(read_file(MESHREEL_SOURCE_DIR "/" + page_of(metric)).ok()) << metric.name;
}
