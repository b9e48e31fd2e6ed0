/// Blender reads the same files to the same positions: an evaluation of skins, morph targets and caches not our own.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "meshreel/mesh/animation.h"
#include "tests/io/made.h"

using namespace meshreel;
using namespace meshreel::io;
using namespace meshreel::io::test;

namespace {

const std::string source = MESHREEL_SOURCE_DIR;
const std::string files = source + "/../shared/data/files/";

bool have_blender()
{
    return std::system("blender --version >/dev/null 2>&1 && /usr/bin/python3 -c 'import numpy' >/dev/null 2>&1") == 0;
}

/// What Blender sees: for each time or frame of the job, x y z of each of its vertices.
std::vector<float> blender_positions(const Folder& folder, nlohmann::json job)
{
    job["out"] = folder / "positions.bin";
    write(folder / "job.json", job.dump());
    const std::string command = "blender -b --factory-startup -noaudio --python-exit-code 1 -P '" + source +
                                "/tests/tools/blender_positions.py' -- '" + (folder / "job.json") + "' >'" +
                                (folder / "log") + "' 2>&1";
    if (std::system(command.c_str()) != 0) ADD_FAILURE() << read(folder / "log");
    const std::string raw = read(folder / "positions.bin");
    std::vector<float> positions(raw.size() / sizeof(float));
    std::memcpy(positions.data(), raw.data(), positions.size() * sizeof(float));
    return positions;
}

/// The largest distance, over some frames, between a vertex of one and a vertex of the other.
struct Sequence {
    const float* positions;
    std::size_t vertices;
    std::vector<std::size_t> frames;

    const float* at(std::size_t i, std::size_t v) const { return positions + (frames[i] * vertices + v) * 3; }
};

double distance(const Sequence& a, std::size_t v, const Sequence& b, std::size_t w, double give_up)
{
    double largest = 0;
    for (std::size_t i = 0; i < a.frames.size() && largest < give_up; ++i) {
        const float *p = a.at(i, v), *q = b.at(i, w);
        largest = std::max(largest, std::hypot(double(p[0]) - q[0], double(p[1]) - q[1], double(p[2]) - q[2]));
    }
    return largest;
}

/// The largest distance from a vertex of one to the vertex of the other that moves most like it: 0 for a permutation.
double largest_distance(const Sequence& from, const Sequence& to)
{
    double largest = 0;
    for (std::size_t v = 0; v < from.vertices; ++v) {
        double nearest = v < to.vertices ? distance(from, v, to, v, 1e30) : 1e30;
        for (std::size_t w = 0; w < to.vertices && nearest > largest; ++w)
            nearest = std::min(nearest, distance(from, v, to, w, nearest));
        largest = std::max(largest, nearest);
    }
    return largest;
}

/// Distance between Blender's vertices at the frames and ours, fraction of the body diagonal, both ways.
double disagreement(const Animation& ours, const std::vector<std::size_t>& frames, const std::vector<float>& blender)
{
    std::vector<std::size_t> all(frames.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
    const Sequence a{ours.positions.data(), ours.vertex_count, frames};
    const Sequence b{blender.data(), blender.size() / 3 / frames.size(), all};
    EXPECT_GT(b.vertices, 0u);
    return std::max(largest_distance(a, b), largest_distance(b, a)) / body_diagonal(ours);
}

std::vector<std::size_t> some_frames(const Animation& animation)
{
    const std::size_t last = animation.frame_count() - 1;
    return {0, last / 3, last / 2 + 1, last};
}

nlohmann::json scene_job(const std::string& path, const Animation& animation, const std::string& clip)
{
    std::vector<double> times;
    for (std::size_t f : some_frames(animation)) times.push_back(animation.times_s[f]);
    return {{"scene", path}, {"clip", clip}, {"fps", 24}, {"times", times}};
}

struct Case {
    const char* file;
    const char* clip;
    double tolerance; ///< Blender turns between keys by components, not along the arc; at keys it agrees to rounding
};

/// A body of 32 vertices that turns, bends and stretches.
Animation made_body()
{
    Animation body;
    body.vertex_count = 32;
    for (std::uint32_t i = 0; i < 30; ++i) body.triangles.push_back({i, i + 1 + i % 2, i + 2 - i % 2});
    body.times_s = uniform_times(20, 25);
    for (std::size_t f = 0; f < 20; ++f)
        for (std::size_t v = 0; v < 32; ++v) {
            const double along = double(v / 2), angle = 0.05 * along * double(f), side = v % 2 == 0 ? -1 : 1;
            for (double x : {along * 0.3 + 0.01 * double(f), side * std::cos(angle),
                             side * std::sin(angle) + 0.02 * double(f * f)})
                body.positions.push_back(static_cast<float>(x));
        }
    return body;
}

} // namespace

class InBlender : public testing::TestWithParam<Case> {};

TEST_P(InBlender, ARealFileStandsWhereWeBakeIt)
{
    const auto [file, clip, tolerance] = GetParam();
    if (!have_blender()) GTEST_SKIP() << "no Blender with numpy";
    if (!std::filesystem::exists(files + file)) GTEST_SKIP() << "no data beside the project";
    LoadOptions options;
    options.clip = clip;
    const auto ours = load(files + file, options);
    ASSERT_TRUE(ours.ok()) << why(ours);
    const Folder folder;
    const auto seen = blender_positions(folder, scene_job(files + file, *ours, clip));
    EXPECT_LT(disagreement(*ours, some_frames(*ours), seen), tolerance);
}

// Not lumberjack.glb: Blender 3.4 cannot give bones a scale at rest and shows it torn apart.
INSTANTIATE_TEST_SUITE_P(Files, InBlender,
                         testing::Values(Case{"CesiumMan.glb", "", 2e-6}, Case{"Fox.glb", "Survey", 2e-6},
                                         Case{"Fox.glb", "Walk", 2e-6}, Case{"Fox.glb", "Run", 1e-3},
                                         Case{"RobotExpressive.glb", "Jump", 2e-6},
                                         Case{"MorphStressTest.gltf", "TheWave", 2e-6}));

class OurGlbInBlender : public testing::TestWithParam<Morphs> {};

TEST_P(OurGlbInBlender, StandsWhereTheAnimationIs)
{
    if (!have_blender()) GTEST_SKIP() << "no Blender with numpy";
    const Folder folder;
    const std::string path = folder / "body.glb";
    const Animation body = made_body();
    SaveOptions options;
    options.morphs = GetParam();
    ASSERT_TRUE(save(body, path, options).ok());
    const auto seen = blender_positions(folder, scene_job(path, body, ""));
    EXPECT_LT(disagreement(body, some_frames(body), seen), GetParam() == Morphs::pca ? 1.02e-4 : 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Morphs, OurGlbInBlender, testing::Values(Morphs::frames, Morphs::pca));

class OurCacheInBlender : public testing::TestWithParam<const char*> {};

TEST_P(OurCacheInBlender, StandsWhereTheAnimationIs)
{
    if (!have_blender()) GTEST_SKIP() << "no Blender with numpy";
    const Folder folder;
    Animation body = made_body(), first = body;
    first.times_s.resize(1);
    first.positions.resize(body.vertex_count * 3);
    ASSERT_TRUE(save(first, folder / "body.obj").ok());
    const std::string cache = folder / (std::string("body.") + GetParam());
    ASSERT_TRUE(save(body, cache).ok());
    const auto seen =
        blender_positions(folder, {{"mesh", folder / "body.obj"}, {"cache", cache}, {"frames", some_frames(body)}});
    EXPECT_LT(disagreement(body, some_frames(body), seen), 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Formats, OurCacheInBlender, testing::Values("pc2", "mdd"));
