/// glTF out: morph targets, weight tracks, primitives, splits, and what cannot be written.
// SPDX-License-Identifier: MIT
#include "meshreel/io/attributes.h"
#include "tests/io/gltf_made.h"

using namespace meshreel;
using namespace meshreel::io;
using namespace meshreel::io::test;

namespace {

/// A sheet of side x side vertices that swings in two ways.
Animation sheet(std::uint32_t side, std::size_t frames)
{
    Animation made;
    made.vertex_count = side * side;
    for (std::uint32_t y = 0; y + 1 < side; ++y)
        for (std::uint32_t x = 0; x + 1 < side; ++x) {
            const std::uint32_t v = y * side + x;
            made.triangles.push_back({v, v + 1, v + side});
            made.triangles.push_back({v + 1, v + side + 1, v + side});
        }
    made.times_s = uniform_times(frames, 25);
    for (std::size_t f = 0; f < frames; ++f)
        for (std::uint32_t v = 0; v < side * side; ++v) {
            const double x = double(v % side) / side, y = double(v / side) / side, t = double(f) / 25;
            for (double p : {x, y + 0.1 * t * x, 0.2 * std::sin(3 * x + 5 * t) + 0.1 * std::sin(4 * y - 7 * t)})
                made.positions.push_back(static_cast<float>(p));
        }
    return made;
}

Animation through(const Animation& animation, const std::string& name, const SaveOptions& options = {})
{
    const Folder folder;
    const Status saved = save(animation, folder / name, options);
    EXPECT_TRUE(saved.ok()) << why(saved);
    const auto read = load(folder / name);
    EXPECT_TRUE(read.ok()) << why(read);
    return read.ok() ? *read : Animation{};
}

double largest_error(const Animation& a, const Animation& b)
{
    EXPECT_EQ(a.positions.size(), b.positions.size());
    double largest = 0;
    for (std::size_t i = 0; i + 2 < std::min(a.positions.size(), b.positions.size()); i += 3)
        largest = std::max(largest, std::hypot(double(a.positions[i]) - b.positions[i],
                                               double(a.positions[i + 1]) - b.positions[i + 1],
                                               double(a.positions[i + 2]) - b.positions[i + 2]));
    return largest;
}

/// The vertices once, in their order; the triangles in the order named.
void expect_sorted(const Animation& back, const Animation& made, const std::vector<std::size_t>& order)
{
    EXPECT_EQ(back.vertex_count, made.vertex_count);
    std::vector<Triangle> sorted;
    for (const std::size_t t : order) sorted.push_back(made.triangles[t]);
    EXPECT_EQ(back.triangles, sorted);
}

struct Teller {
    std::vector<std::string> heard;
    SaveOptions options;
    Teller()
    {
        options.warn = [this](std::string sentence) { heard.push_back(std::move(sentence)); };
    }
};

} // namespace

TEST(GltfWrite, EveryFrameComesBackAtItsTime)
{
    Animation made = sheet(5, 7);
    made.meta.name = "wave";
    const Animation back = through(made, "sheet.glb");
    EXPECT_EQ(back.triangles, made.triangles);
    ASSERT_EQ(back.frame_count(), 7u);
    for (std::size_t f = 0; f < 7; ++f)
        EXPECT_EQ(back.times_s[f], static_cast<double>(static_cast<float>(made.times_s[f])));
    EXPECT_LT(largest_error(made, back), 1e-7 * body_diagonal(made));
    EXPECT_EQ(back.meta.name, "wave");
    EXPECT_EQ(back.meta.fps, 25.0);
}

TEST(GltfWrite, BetweenFramesAPlayerGoesStraight)
{
    const Animation made = sheet(3, 2);
    const Folder folder;
    ASSERT_TRUE(save(made, folder / "sheet.glb").ok());
    LoadOptions options;
    options.fps = 50;
    const auto read = load(folder / "sheet.glb", options);
    ASSERT_TRUE(read.ok()) << why(read);
    EXPECT_NEAR(read->frame(1)[2], (double(made.frame(0)[2]) + made.frame(1)[2]) / 2, 1e-7);
}

TEST(GltfWrite, ModesReachATenThousandthOfTheDiagonalWithFarFewerTargets)
{
    const Animation made = sheet(12, 60);
    SaveOptions options;
    options.morphs = Morphs::pca;
    const Folder folder;
    ASSERT_TRUE(save(made, folder / "sheet.gltf", options).ok());
    const json root = json::parse(read(folder / "sheet.gltf"));
    EXPECT_LT(root["meshes"][0]["primitives"][0]["targets"].size(), 8u);
    EXPECT_LE(largest_error(made, *load(folder / "sheet.gltf")), 1e-4 * body_diagonal(made));
}

TEST(GltfWrite, AsManyModesAreWrittenAsAreAskedFor)
{
    SaveOptions options;
    options.morphs = Morphs::pca;
    options.bases = 2;
    const Folder folder;
    ASSERT_TRUE(save(sheet(5, 20), folder / "sheet.gltf", options).ok());
    const json root = json::parse(read(folder / "sheet.gltf"));
    EXPECT_EQ(root["meshes"][0]["weights"].size(), 2u);
    EXPECT_EQ(root["accessors"][root["animations"][0]["samplers"][0]["output"].get<std::size_t>()]["count"], 40);
}

TEST(GltfWrite, ASingleFrameIsAPlainMesh)
{
    const Folder folder;
    for (Morphs morphs : {Morphs::frames, Morphs::pca}) {
        SaveOptions options;
        options.morphs = morphs;
        options.overwrite = true;
        ASSERT_TRUE(save(sheet(3, 1), folder / "sheet.gltf", options).ok());
        EXPECT_FALSE(json::parse(read(folder / "sheet.gltf")).contains("animations"));
        EXPECT_EQ(load(folder / "sheet.gltf")->positions, sheet(3, 1).positions);
    }
}

TEST(GltfWrite, TimesAndNamesSurviveWhereNothingMoves)
{
    Animation still = sheet(3, 1);
    still.meta.name = "pose";
    still.times_s = {0.5};
    EXPECT_EQ(through(still, "sheet.glb").meta.name, "pose");
    EXPECT_EQ(through(still, "sheet.glb").times_s, still.times_s);
    still.times_s = {0.5, 0.75, 1};
    for (int copy = 0; copy < 2; ++copy)
        still.positions.insert(still.positions.end(), still.positions.begin(), still.positions.begin() + 27);
    SaveOptions options;
    options.morphs = Morphs::pca;
    EXPECT_EQ(through(still, "sheet.glb", options).times_s, still.times_s);
}

TEST(GltfWrite, GltfPutsItsBinaryBesideItselfWhateverItsName)
{
    const Folder folder;
    ASSERT_TRUE(save(sheet(3, 2), folder / "a sheet #1.gltf").ok());
    EXPECT_TRUE(std::filesystem::exists(folder / "a sheet #1.bin"));
    EXPECT_TRUE(load(folder / "a sheet #1.gltf").ok());
}

TEST(GltfWrite, OnePrimitiveAMaterialAndGroupAndVerticesAreShared)
{
    Animation made = sheet(3, 2);
    made.appearance.materials = {"red", "blue"};
    made.appearance.attributes = {triangle_numbers("material", std::vector<std::uint32_t>{1, 1, 0, 0, 1, 1, 0, 0})};
    const Animation back = through(made, "sheet.glb");
    expect_sorted(back, made, {0, 1, 4, 5, 2, 3, 6, 7});
    EXPECT_EQ(back.appearance.materials, made.appearance.materials);
}

TEST(GltfWrite, GroupsAreNodesAndShareTheirVertices)
{
    Animation made = sheet(3, 2);
    made.appearance.groups = {"left", "right"};
    made.appearance.attributes = {triangle_numbers("group", std::vector<std::uint32_t>{0, 0, 1, 1, 0, 0, 1, 1})};
    const Animation back = through(made, "sheet.glb");
    expect_sorted(back, made, {0, 1, 4, 5, 2, 3, 6, 7});
    EXPECT_EQ(back.appearance.groups, std::vector<std::string>({"left/left#0", "right/right#0"}));
    SaveOptions few;
    few.morphs = Morphs::pca;
    expect_sorted(through(made, "sheet.glb", few), made, {0, 1, 4, 5, 2, 3, 6, 7});
}

TEST(GltfWrite, AVertexWithTwoValuesAtItsCornersIsSplit)
{
    Animation made = sheet(2, 2);
    std::vector<float> uvs;
    for (int corner = 0; corner < 6; ++corner) uvs.insert(uvs.end(), {float(corner), 0});
    made.appearance.attributes = {indexed(float_attribute("uv0", Domain::corner, 2, uvs),
                                          {0, 1, 2, 3, 4, 2})}; // vertex 2 shares, vertex 1 does not
    const Animation back = through(made, "sheet.glb");
    EXPECT_EQ(back.vertex_count, 5u);
    const Attribute* uv = back.appearance.find("uv0");
    ASSERT_NE(uv, nullptr);
    for (std::size_t corner : {0, 1, 2, 3, 4, 5})
        EXPECT_EQ(attribute_float(*uv, back.triangles[corner / 3][corner % 3], 0), corner == 5 ? 2.0f : float(corner));
}

TEST(GltfWrite, VerticesWithoutTriangleAreKeptInTheirPlace)
{
    Animation made = sheet(3, 2);
    made.triangles.resize(2);
    EXPECT_EQ(through(made, "sheet.glb").positions, through(sheet(3, 2), "sheet.glb").positions);
}

TEST(GltfWrite, MoreThan65535VerticesGetWideIndices)
{
    const Animation made = sheet(257, 1);
    EXPECT_EQ(through(made, "sheet.glb").triangles, made.triangles);
}

TEST(GltfWrite, NormalsThatAreNotOfLengthOneAreScaledAndThatIsSaid)
{
    Animation made = sheet(2, 1);
    made.appearance.attributes = {
        float_attribute("normal", Domain::vertex, 3, std::vector<float>{0, 0, 2, 0, 0, 1, 0, 1, 0, 0, 0, 0})};
    Teller teller;
    const Animation back = through(made, "sheet.glb", teller.options);
    EXPECT_EQ(attribute_float(*back.appearance.find("normal"), 0, 2), 1.0f);
    ASSERT_EQ(teller.heard.size(), 1u);
    EXPECT_NE(teller.heard[0].find("not of length 1"), std::string::npos);
}

TEST(GltfWrite, WhatGltfCannotHoldIsSaid)
{
    Animation made = sheet(2, 1);
    made.meta.up = Axis::z;
    made.appearance.attributes = {float_attribute("temperature", Domain::vertex, 1, std::vector<float>(4)),
                                  float_attribute("uv1", Domain::vertex, 2, std::vector<float>(8))};
    Teller teller;
    through(made, "sheet.glb", teller.options);
    ASSERT_EQ(teller.heard.size(), 3u);
    EXPECT_NE(teller.heard[0].find("y as up"), std::string::npos);
    EXPECT_NE(teller.heard[1].find("temperature"), std::string::npos);
    EXPECT_NE(teller.heard[2].find("TEXCOORD_1"), std::string::npos);
}

TEST(GltfWrite, TimesThatGltfCannotHoldAreRefused)
{
    const Folder folder;
    Animation made = sheet(2, 2);
    made.times_s = {-1, 0};
    EXPECT_NE(why(save(made, folder / "a.glb")).find("frame 0 is at -1"), std::string::npos);
    made.times_s = {1e6, 1e6 + 1e-6};
    EXPECT_NE(why(save(made, folder / "a.glb")).find("frames 0 and 1 are at the same time"), std::string::npos);
    made.triangles.clear();
    EXPECT_EQ(save(made, folder / "a.glb").error().code, ErrorCode::unsupported);
    EXPECT_EQ(folder.file_count(), 0u);
}

TEST(GltfWrite, AFileThatExistsStaysAndNothingIsLeftBehind)
{
    const Folder folder;
    write(folder / "a.gltf", "mine");
    EXPECT_EQ(save(sheet(2, 2), folder / "a.gltf").error().code, ErrorCode::usage);
    EXPECT_EQ(folder.file_count(), 1u);
    EXPECT_EQ(read(folder / "a.gltf"), "mine");
}

TEST(GltfWrite, NamesThatAreNoUtf8AreStillWritten)
{
    Animation made = sheet(2, 2);
    made.meta.name = "caf\xe9";
    EXPECT_EQ(through(made, "sheet.glb").frame_count(), 2u);
}

TEST(GltfWrite, TheSameAnimationGivesTheSameBytes)
{
    const Folder folder;
    SaveOptions options;
    options.morphs = Morphs::pca;
    for (const char* name : {"a.glb", "b.glb"}) ASSERT_TRUE(save(sheet(40, 30), folder / name, options).ok());
    EXPECT_EQ(read(folder / "a.glb"), read(folder / "b.glb"));
}
