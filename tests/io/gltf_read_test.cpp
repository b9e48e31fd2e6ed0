/// glTF in: node animation, skins, morph targets, clips, times.
// SPDX-License-Identifier: MIT
#include "tests/io/gltf_made.h"

using namespace meshreel;
using namespace meshreel::io;
using namespace meshreel::io::test;

namespace {

/// A triangle that a sampler moves along x.
GlbMaker moving(const std::vector<float>& times, const std::vector<float>& xs, const char* interpolation = "LINEAR")
{
    GlbMaker made;
    const std::size_t node = made.node({{"mesh", made.mesh(made.triangle())}});
    std::vector<float> values;
    for (float x : xs) values.insert(values.end(), {x, 0, 0});
    made.clip("move", node, "translation", made.sampler(times, values, "VEC3", interpolation));
    return made;
}

LoadOptions at_fps(double fps)
{
    LoadOptions options;
    options.fps = fps;
    return options;
}

} // namespace

TEST(GltfRead, AFileWithoutClipIsOneFrame)
{
    GlbMaker made;
    made.node({{"mesh", made.mesh(made.triangle())}, {"translation", {1, 2, 3}}, {"scale", {2, 2, 2}}});
    const Animation read = loaded(made);
    EXPECT_EQ(read.frame_count(), 1u);
    EXPECT_EQ(read.triangles, std::vector<Triangle>({{0, 1, 2}}));
    expect_point(read, 0, 1, {3, 2, 3});
    EXPECT_EQ(read.meta.up, Axis::y);
    EXPECT_EQ(read.meta.metres_per_unit, 1.0);
}

TEST(GltfRead, ChildrenStandWhereTheirParentsCarryThem)
{
    GlbMaker made;
    const std::size_t child = made.add("nodes", {{"mesh", made.mesh(made.triangle())}, {"translation", {1, 0, 0}}});
    const double half = std::sqrt(0.5);
    made.node({{"children", {child}}, {"rotation", {0, 0, half, half}}, {"translation", {0, 0, 7}}});
    const Animation read = loaded(made);
    expect_point(read, 0, 0, {0, 1, 7});
    expect_point(read, 0, 2, {-1, 1, 7});
}

TEST(GltfRead, AMatrixIsReadColumnByColumn)
{
    GlbMaker made;
    made.node({{"mesh", made.mesh(made.triangle())}, {"matrix", {0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1}}});
    expect_point(loaded(made), 0, 1, {5, 7, 7});
}

TEST(GltfRead, LinearKeysAreJoinedByStraightLines)
{
    GlbMaker made = moving({0, 1}, {0, 8});
    const Animation read = loaded(made, at_fps(4));
    ASSERT_EQ(read.frame_count(), 5u);
    expect_point(read, 1, 0, {2, 0, 0});
    EXPECT_EQ(read.times_s[3], 0.75);
    EXPECT_EQ(read.meta.fps, 4.0);
}

TEST(GltfRead, StepKeysHoldUntilTheNext)
{
    GlbMaker made = moving({0, 1}, {3, 8}, "STEP");
    const Animation read = loaded(made, at_fps(4));
    expect_point(read, 3, 0, {3, 0, 0});
    expect_point(read, 4, 0, {8, 0, 0});
}

TEST(GltfRead, CubicKeysFollowTheHermiteSpline)
{
    // in-tangent, value, out-tangent a key: from 0 with slope 3 to 1 with slope 0, over 2 s
    GlbMaker made = moving({0, 2}, {9, 0, 3, 0, 1, 9}, "CUBICSPLINE");
    const Animation read = loaded(made, at_fps(1));
    const double t = 0.5, expected = 2 * (t * t * t - 2 * t * t + t) * 3 + (-2 * t * t * t + 3 * t * t) * 1;
    expect_point(read, 1, 0, {expected, 0, 0});
    expect_point(read, 2, 0, {1, 0, 0});
}

TEST(GltfRead, RotationsTakeTheShorterArcAtConstantSpeed)
{
    GlbMaker made;
    const std::size_t node = made.node({{"mesh", made.mesh(made.triangle())}});
    const float s = std::sin(0.6f), c = std::cos(0.6f); // 1.2 rad about z, its quaternion negated
    made.clip("turn", node, "rotation", made.sampler({0, 1}, {0, 0, 0, 1, 0, 0, -s, -c}, "VEC4"));
    const Animation read = loaded(made, at_fps(4));
    for (std::size_t f = 0; f < 5; ++f)
        expect_point(read, f, 1, {std::cos(0.3 * double(f)), std::sin(0.3 * double(f)), 0});
}

TEST(GltfRead, NormalisedIntegersOfAnAnimationAreFractions)
{
    GlbMaker made;
    const std::size_t node = made.node({{"mesh", made.mesh(made.triangle())}});
    const std::size_t turns =
        made.accessor(std::vector<std::int16_t>{0, 0, 0, 32767, 0, 0, 32767, 0}, "VEC4", 5122, true);
    made.clip("turn", node, "rotation", {{"input", made.floats({0, 1}, "SCALAR")}, {"output", turns}});
    expect_point(loaded(made, at_fps(2)), 1, 1, {0, 1, 0});
}

TEST(GltfRead, JointsBlendTheirMatricesAndTheMeshNodeIsIgnored)
{
    GlbMaker made = two_bones();
    const Animation read = loaded(made);
    ASSERT_EQ(read.frame_count(), 3u);
    expect_point(read, 0, 3, {1, 2, 0});
    expect_point(read, 2, 0, {0, 0, 0});
    expect_point(read, 2, 2, {-1, 1, 0}); // all of joint 1, a quarter turn about (0 1 0)
    expect_point(read, 2, 3, {0.5 * (1 - 1), 0.5 * (2 + 2), 0.5 * (5 + 5)}); // half of each, morphed first
    expect_point(read, 1, 3, {0, 2, 2.5});                                   // the morph half way
}

TEST(GltfRead, WeightsCountByTheirShare)
{
    GlbMaker made = two_bones();
    json& attributes = made.root["meshes"][0]["primitives"][0]["attributes"];
    attributes["WEIGHTS_0"] = made.floats({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 2, 2, 0, 0}, "VEC4");
    expect_point(loaded(made), 2, 3, {0, 2, 5});
}

TEST(GltfRead, ASecondSetOfJointsCountsToo)
{
    GlbMaker made = two_bones();
    json& attributes = made.root["meshes"][0]["primitives"][0]["attributes"];
    attributes["JOINTS_1"] = made.shorts({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
    attributes["WEIGHTS_1"] =
        made.accessor(std::vector<std::uint8_t>{255, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC4", 5121, true);
    expect_point(loaded(made), 2, 0, {0.5 * (0 + 1), 0.5 * (0 + 1), 0}); // joint 1 turns (0 0 0) to (1 1 0)
}

TEST(GltfRead, MorphWeightsComeFromTheClipElseTheNodeElseTheMesh)
{
    GlbMaker made;
    json primitive = made.triangle();
    primitive["targets"] = {{{"POSITION", made.floats({1, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC3")}}};
    const std::size_t mesh = made.mesh(primitive);
    made.root["meshes"][mesh]["weights"] = {0.25};
    made.node({{"mesh", mesh}});
    made.node({{"mesh", mesh}, {"weights", {0.5}}});
    const std::size_t third = made.node({{"mesh", mesh}, {"weights", {0.5}}});
    made.clip("grow", third, "weights", made.sampler({0, 1}, {0, 1}, "SCALAR"));
    const Animation read = loaded(made);
    expect_point(read, 1, 0, {0.25, 0, 0});
    expect_point(read, 1, 3, {0.5, 0, 0});
    expect_point(read, 1, 6, {1, 0, 0});
}

TEST(GltfRead, QuantisedAndInterleavedPositionsAreRead)
{
    GlbMaker made;
    const std::vector<std::int16_t> raw = {0, 0, 0, 99, 32767, 0, 0, 99, 0, -32768, 0, 99};
    const std::size_t positions = made.accessor(raw, "VEC4", 5122, true);
    made.root["accessors"][positions]["type"] = "VEC3";
    made.root["bufferViews"].back()["byteStride"] = 8;
    made.root["extensionsRequired"] = {"KHR_mesh_quantization"};
    made.node({{"mesh", made.mesh({{"attributes", {{"POSITION", positions}}}})}});
    const Animation read = loaded(made);
    expect_point(read, 0, 1, {1, 0, 0});
    expect_point(read, 0, 2, {0, -1, 0});
}

TEST(GltfRead, StripsAndFansBecomeTrianglesThatFaceTheSameWay)
{
    GlbMaker made;
    const std::size_t positions = made.floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, "VEC3");
    made.node({{"mesh", made.mesh({{"attributes", {{"POSITION", positions}}}, {"mode", 5}})}});
    made.node({{"mesh", made.mesh({{"attributes", {{"POSITION", positions}}}, {"mode", 6}})}});
    EXPECT_EQ(loaded(made).triangles, std::vector<Triangle>({{0, 1, 2}, {1, 3, 2}, {1, 2, 0}, {2, 3, 0}}));
}

TEST(GltfRead, PointsAndLinesAreToldAndLeftOut)
{
    GlbMaker made;
    json primitives = {made.triangle(), made.triangle(), made.triangle()};
    primitives[0]["mode"] = 0;
    primitives[1]["mode"] = 1;
    made.node({{"mesh", made.add("meshes", {{"primitives", primitives}})}});
    const Listener listener;
    EXPECT_EQ(loaded(made, listener.options).vertex_count, 3u);
    EXPECT_TRUE(listener.has("meshes[0].primitives[0]: is made of points"));
    EXPECT_TRUE(listener.has("meshes[0].primitives[1]: is made of lines"));
}

TEST(GltfRead, EveryNodeThatShowsAMeshAddsItInNodeOrder)
{
    GlbMaker made;
    const std::size_t mesh = made.mesh(made.triangle());
    for (int x : {10, 20}) made.node({{"mesh", mesh}, {"translation", {x, 0, 0}}});
    made.add("nodes", {{"mesh", mesh}}); // in no scene
    const Animation read = loaded(made);
    EXPECT_EQ(read.vertex_count, 6u);
    expect_point(read, 0, 3, {20, 0, 0});
}

TEST(GltfRead, PrimitivesOfOneVertexBufferShareIt)
{
    GlbMaker made;
    json first = made.triangle(), second = first;
    first["indices"] = made.shorts({0, 1, 2});
    second["indices"] = made.accessor(std::vector<std::uint8_t>{2, 1, 0}, "SCALAR", 5121);
    made.node({{"mesh", made.add("meshes", {{"primitives", {first, second}}})}});
    const Animation read = loaded(made);
    EXPECT_EQ(read.vertex_count, 3u);
    EXPECT_EQ(read.triangles, std::vector<Triangle>({{0, 1, 2}, {2, 1, 0}}));
}

TEST(GltfRead, MeshesOfOneVertexBufferShareItWhereTheirNodesMoveAlike)
{
    GlbMaker made;
    json front = made.triangle(), back = front;
    front["targets"] = back["targets"] = {{{"POSITION", made.floats({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3")}}};
    back["indices"] = made.shorts({0, 2, 1});
    const std::size_t meshes[] = {made.mesh(front), made.mesh(back)};
    for (const std::size_t mesh : {meshes[0], meshes[1], meshes[1]}) made.node({{"mesh", mesh}});
    made.node({{"mesh", meshes[1]}, {"translation", {5, 0, 0}}});
    made.clip("rise", 0, "weights", made.sampler({0, 1}, {0, 1}, "SCALAR"));
    json channel = made.root["animations"][0]["channels"][0];
    channel["target"]["node"] = 1;
    made.root["animations"][0]["channels"].push_back(channel);
    const Animation read = loaded(made); // node 2 rests, node 3 stands elsewhere
    EXPECT_EQ(read.vertex_count, 9u);
    EXPECT_EQ(read.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 1}, {3, 5, 4}, {6, 8, 7}}));
    EXPECT_EQ(point(read, read.frame_count() - 1, 1), (std::array<double, 3>{1, 0, 1}));
    EXPECT_EQ(point(read, read.frame_count() - 1, 4), (std::array<double, 3>{1, 0, 0}));
    EXPECT_EQ(point(read, read.frame_count() - 1, 7), (std::array<double, 3>{6, 0, 0}));
}

TEST(GltfRead, TrianglesOfAMirroredNodeAreTurnedRound)
{
    GlbMaker made;
    made.node({{"mesh", made.mesh(made.triangle())}, {"scale", {-1, 1, 1}}});
    const Listener listener;
    EXPECT_EQ(loaded(made, listener.options).triangles, std::vector<Triangle>({{0, 2, 1}}));
    EXPECT_TRUE(listener.has("nodes[0]: is mirrored"));
}

TEST(GltfRead, NormalsTurnWithThePoseOfTheFirstFrame)
{
    GlbMaker made;
    json primitive = made.triangle();
    const float slant = std::sqrt(0.5f);
    primitive["attributes"]["NORMAL"] = made.floats({0, 0, 1, slant, slant, 0, 0, 1, 0}, "VEC3");
    made.node({{"mesh", made.mesh(primitive)}, {"scale", {2, 1, 1}}});
    const Animation read = loaded(made);
    const Attribute* normal = read.appearance.find("normal");
    ASSERT_NE(normal, nullptr);
    std::vector<float> values(9);
    std::memcpy(values.data(), normal->values.data(), 36);
    const std::vector<float> wanted = {0, 0, 1, std::sqrt(0.2f), std::sqrt(0.8f), 0, 0, 1, 0};
    for (std::size_t i = 0; i < 9; ++i) EXPECT_NEAR(values[i], wanted[i], 1e-6);
}

TEST(GltfTimes, UniformKeysAreTheFrames)
{
    GlbMaker made = moving({0.25f, 0.35f, 0.45f, 0.55f}, {0, 1, 2, 3});
    const Listener listener;
    const Animation read = loaded(made, listener.options);
    EXPECT_EQ(read.times_s, std::vector<double>({0.25f, 0.35f, 0.45f, 0.55f}));
    EXPECT_EQ(read.meta.fps, 10.0);
    EXPECT_EQ(read.meta.name, "move");
    EXPECT_TRUE(listener.heard.empty());
}

TEST(GltfTimes, KeysThatAnExporterLeftOutAreFramesToo)
{
    GlbMaker made = moving({0, 0.1f, 0.2f, 0.4f, 0.5f}, {0, 1, 2, 4, 5});
    const Animation read = loaded(made);
    ASSERT_EQ(read.frame_count(), 6u);
    expect_point(read, 3, 0, {3, 0, 0});
    EXPECT_EQ(read.times_s[4], static_cast<double>(0.4f));
}

TEST(GltfTimes, KeysOnNoGridAreSampledThirtyTimesASecondAndThatIsSaid)
{
    GlbMaker made = moving({0, 0.1f, 0.27f, 1}, {0, 1, 2, 3});
    const Listener listener;
    const Animation read = loaded(made, listener.options);
    EXPECT_EQ(read.frame_count(), 31u);
    EXPECT_EQ(read.meta.fps, 30.0);
    EXPECT_TRUE(listener.has("stand on no uniform grid"));
}

TEST(GltfTimes, ARateThatDoesNotReachTheEndIsSaid)
{
    GlbMaker made = moving({0, 1}, {0, 1});
    Listener listener;
    listener.options.fps = 3.5;
    EXPECT_EQ(loaded(made, listener.options).frame_count(), 4u);
    EXPECT_TRUE(listener.has("ends at 1"));
}

TEST(GltfTimes, FramesAreChosenByTheirPlaceInTheClip)
{
    GlbMaker made = moving({0, 1}, {0, 10});
    LoadOptions options = at_fps(10);
    options.frames = {2, 8, 3};
    const Animation read = loaded(made, options);
    ASSERT_EQ(read.frame_count(), 3u);
    expect_point(read, 1, 0, {5, 0, 0});
    EXPECT_NEAR(read.meta.fps, 10.0 / 3, 1e-12);
}

TEST(GltfTimes, AClipOfOneKeyIsOneFrame)
{
    GlbMaker made = moving({0.5f}, {4});
    const Animation read = loaded(made);
    EXPECT_EQ(read.times_s, std::vector<double>({0.5}));
    expect_point(read, 0, 0, {4, 0, 0});
}

TEST(GltfClips, AreChosenByNameElseByNumberElseTheFirst)
{
    GlbMaker made = moving({0, 1}, {0, 1});
    made.clip("", 0, "translation", made.sampler({0, 1}, {0, 0, 0, 2, 0, 0}, "VEC3"));
    Listener listener;
    expect_point(loaded(made, listener.options), 1, 0, {1, 0, 0});
    EXPECT_TRUE(listener.has("has 2 clips: \"move\", 1; the first is taken"));
    listener.options.clip = "1";
    expect_point(loaded(made, listener.options), 1, 0, {2, 0, 0});
    listener.options.clip = "jog";
    const auto none = load_bytes(made.bytes(), listener.options);
    ASSERT_FALSE(none.ok());
    EXPECT_EQ(none.error().code, ErrorCode::usage);
    EXPECT_NE(none.error().message.find("has no clip \"jog\"; there are: \"move\", 1"), std::string::npos);
}

TEST(GltfClips, ChannelsThatCannotBeFollowedAreToldAndLeftOut)
{
    GlbMaker made = moving({0, 1}, {0, 1});
    json pointer = made.root["animations"][0]["channels"][0];
    pointer["target"] = {{"path", "pointer"}};
    made.root["animations"][0]["channels"].push_back(pointer);
    const Listener listener;
    EXPECT_EQ(loaded(made, listener.options).frame_count(), 2u);
    EXPECT_TRUE(listener.has("animations[0].channels[1]: animates pointer"));
}
