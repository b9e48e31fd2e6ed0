/// MeshLab's filter "Hausdorff Distance", METRO's heir, finds the same distances: an evaluation not our own.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "meshreel/io/io.h"
#include "meshreel/meshreel.h"
#include "meshreel/metrics/hausdorff.h"
#include "meshreel/metrics/surface_samples.h"
#include "tests/metrics/surfaces.h"

using namespace meshreel;
using namespace meshreel::metrics;
using namespace meshreel::metrics::test;

namespace {

constexpr std::size_t meshlab_samples = 200000;
const std::string real_data = MESHREEL_SOURCE_DIR "/../shared/data/";

bool have_meshlab()
{
    return std::system("command -v meshlabserver xvfb-run xauth >/dev/null 2>&1") == 0;
}

/// What MeshLab finds from one surface to another: of faces alone, as the RMS is defined, or of vertices and edges too.
SampledDistance meshlab_distance(const std::filesystem::path& folder, bool edges, bool back)
{
    std::ofstream script(folder / "script.mlx");
    script << "<!DOCTYPE FilterScript>\n<FilterScript><filter name=\"Hausdorff Distance\">";
    const auto set = [&](const char* type, const char* name, auto value, const char* more = "") {
        script << "<Param type=\"" << type << "\" name=\"" << name << "\" value=\"" << value << "\" " << more << "/>";
    };
    set("RichMesh", "SampledMesh", back ? 1 : 0);
    set("RichMesh", "TargetMesh", back ? 0 : 1);
    set("RichBool", "SaveSample", "false");
    for (const char* what : {"SampleVert", "SampleEdge"}) set("RichBool", what, edges ? "true" : "false");
    set("RichBool", "SampleFauxEdge", "false");
    set("RichBool", "SampleFace", "true");
    set("RichInt", "SampleNum", meshlab_samples);
    set("RichAbsPerc", "MaxDist", 100000, "min=\"0\" max=\"100000\"");
    script << "</filter></FilterScript>\n";
    script.close();
    const std::string command =
        "cd '" + folder.string() + "' && xvfb-run -a meshlabserver -i one.ply two.ply -s script.mlx >log 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0);
    std::stringstream log;
    log << std::ifstream(folder / "log").rdbuf();
    const std::string text = log.str();
    const auto number = [&](const char* name) {
        const std::size_t at = text.find(name); // the first is in units
        return at == std::string::npos ? std::nan("") : std::strtod(text.c_str() + at + std::strlen(name), nullptr);
    };
    const double largest = number("max "), rms = number("RMS :");
    return {largest * largest, rms * rms, 1};
}

/// The first frame, its body diagonal a thousand units: MeshLab prints six decimals.
Animation large_first_frame(Animation animation, double body)
{
    animation.times_s.resize(1);
    animation.positions.resize(animation.vertex_count * 3ul);
    animation.appearance = {};
    for (float& x : animation.positions) x = static_cast<float>(x * (1000 / body));
    return animation;
}

void expect_as_meshlab(const std::string& name, const Animation& given, const Animation& other_given)
{
    const double body = body_diagonal(given);
    const Animation one = large_first_frame(given, body), two = large_first_frame(other_given, body);
    const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / ("meshreel_meshlab_" + name);
    std::filesystem::create_directories(folder);
    io::SaveOptions overwrite;
    overwrite.overwrite = true;
    ASSERT_TRUE(io::save(one, folder / "one.ply", overwrite).ok());
    ASSERT_TRUE(io::save(two, folder / "two.ply", overwrite).ok());
    const SurfacePair pair(one.triangles, one.vertex_count, two.triangles, two.vertex_count);
    const FrameHausdorff ours =
        pair.measure(one.frame(0), two.frame(0), {.tolerance = 1e-6, .samples = meshlab_samples});
    for (const bool back : {false, true}) {
        const OneSided& way = back ? ours.backward : ours.forward;
        const SampledDistance points = meshlab_distance(folder, true, back),
                              faces = meshlab_distance(folder, false, back);
        const double largest = std::sqrt(points.largest);
        EXPECT_LE(way.hausdorff.upper - way.hausdorff.lower, 1e-6);
        EXPECT_LE(largest, way.hausdorff.upper + 1e-3) << "no sample is beyond the bound";
        EXPECT_GE(largest, 0.97 * way.hausdorff.lower) << "and some come near";
        // The variance of d^2 is at most max d^2 times its mean: twice the largest standard error an RMS can have.
        const double twice_error = way.hausdorff.upper / way.rms / std::sqrt(static_cast<double>(meshlab_samples));
        EXPECT_NEAR(faces.rms() / way.rms, 1, twice_error);
    }
    std::filesystem::remove_all(folder);
}

} // namespace

class RealFrame : public testing::TestWithParam<const char*> {};

TEST_P(RealFrame, IsAsFarFromItsDecodedSelfAndACoarserLevelAsMeshLabFinds)
{
    if (!have_meshlab()) GTEST_SKIP() << "no meshlabserver with xvfb-run";
    const std::string folder = real_data + GetParam();
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no data beside the project";
    io::LoadOptions options;
    options.mesh = folder + "/mesh.obj";
    options.frames = {40, 44};
    const auto original = io::load(folder + "/motion.pc2", options);
    ASSERT_TRUE(original.ok()) << original.error().sentence();
    const auto encoded = encode(*original);
    ASSERT_TRUE(encoded.ok());
    DecodeOptions coarse;
    coarse.level = 1;
    expect_as_meshlab(GetParam(), *original, *decode(encoded->bytes));
    expect_as_meshlab(GetParam(), *original, *decode(encoded->bytes, coarse));
}

INSTANTIATE_TEST_SUITE_P(Sequences, RealFrame, testing::Values("dance", "cow", "cloth", "crane"));
