/// glTF that lies: every count, index, range and path is checked, and the error names file and field.
// SPDX-License-Identifier: MIT
#include "tests/io/gltf_made.h"

using namespace meshreel;
using namespace meshreel::io;
using namespace meshreel::io::test;

namespace {

/// What is put at a place of two_bones() (null: taken away), and what the error must say.
struct Lie {
    const char* place;
    json value;
    const char* said;
};

LoadOptions small_limits()
{
    LoadOptions options;
    options.limits.max_memory = 64 << 20;
    return options;
}

void expect_refused(const std::string& bytes, const std::string& said, ErrorCode code = ErrorCode::bad_input)
{
    const auto read = load_bytes(bytes, small_limits());
    ASSERT_FALSE(read.ok()) << "was read, but should be refused: " << said;
    EXPECT_EQ(read.error().code, code) << why(read);
    EXPECT_NE(why(read).find(said), std::string::npos) << why(read);
    EXPECT_NE(why(read).find("made.glb"), std::string::npos) << why(read);
}

const Lie lies[] = {
    {"/asset", nullptr, "asset.version"},
    {"/accessors/0/count", 5, "accessors[0].byteOffset: 5 elements reach beyond"},
    {"/accessors/0/count", 1e300, "accessors[0].count"},
    {"/accessors/0/count", -1, "accessors[0].count"},
    {"/accessors/0/count", "4", "accessors[0].count"},
    {"/accessors/0/count", nullptr, "accessors[0].count: is missing"},
    {"/accessors/0/byteOffset", 4, "reach beyond"},
    {"/accessors/0/byteOffset", 18446744073709551615ull, "accessors[0].byteOffset"},
    {"/accessors/0/componentType", 5124, "accessors[0].componentType: 5124 is no component type"},
    {"/accessors/0/componentType", 5125.5, "accessors[0].componentType"},
    {"/accessors/0/type", "VEC5", "accessors[0].type"},
    {"/accessors/0/type", "VEC2", "2 components where 3 are needed"},
    {"/accessors/0/normalized", 1, "accessors[0].normalized"},
    {"/accessors/0/bufferView", 99, "accessors[0].bufferView: 99 is beyond"},
    {"/accessors/1/sparse/count", 5, "accessors[1].sparse.count"},
    {"/accessors/1/sparse/indices/bufferView", 99, "accessors[1].sparse.indices.bufferView"},
    {"/accessors/1/sparse/indices/componentType", 5126, "is no unsigned type"},
    {"/accessors/1/sparse/values/byteOffset", 4, "accessors[1].sparse.values.byteOffset"},
    {"/accessors/1/count", 2, "offsets for 4 vertices"},
    {"/bufferViews/0/buffer", 1, "bufferViews[0].buffer"},
    {"/bufferViews/0/byteOffset", 1 << 30, "bufferViews[0].byteOffset"},
    {"/bufferViews/0/byteLength", 1 << 30, "bufferViews[0].byteLength"},
    {"/bufferViews/0/byteStride", 4, "bufferViews[0].byteStride: is smaller than an element"},
    {"/buffers/0/byteLength", 1 << 20, "buffers[0].byteLength"},
    {"/buffers/0/byteLength", 1ull << 60, "buffers[0].byteLength"},
    {"/buffers/0/uri", "http://example.org/x.bin", "buffers[0].uri: is remote"},
    {"/buffers/0/uri", "../x.bin", "buffers[0].uri: leads out of the file's folder"},
    {"/buffers/0/uri", "/etc/passwd", "buffers[0].uri: leads out"},
    {"/buffers/0/uri", "a/%2e%2e/%2e%2e/x.bin", "buffers[0].uri: leads out"},
    {"/buffers/0/uri", "a\\..\\x.bin", "buffers[0].uri: leads out"},
    {"/buffers/0/uri", "data:application/octet-stream;base64,A*==", "buffers[0].uri: is not base64"},
    {"/buffers/0/uri", "data:,ab", "buffers[0].byteLength"},
    {"/buffers", {{{"byteLength", 0}}}, "bufferViews[6].byteOffset: 168 is beyond"},
    {"/meshes/0/primitives/0/indices", 99, "meshes[0].primitives[0].indices"},
    {"/meshes/0/primitives/0/mode", 7, "meshes[0].primitives[0].mode"},
    {"/meshes/0/primitives/0/mode", 4, "no whole number of triangles"},
    {"/meshes/0/primitives/0/material", 0, "meshes[0].primitives[0].material"},
    {"/meshes/0/primitives/0/attributes/POSITION", nullptr, "attributes.POSITION: is missing"},
    {"/meshes/0/primitives/0/attributes/WEIGHTS_0", nullptr, "attributes.WEIGHTS_0: is missing"},
    {"/meshes/0/primitives/0/attributes/JOINTS_0", 3, "is no unsigned type"},
    {"/meshes/0/primitives/0/attributes/NORMAL", 5, "2 values for 4 vertices"},
    {"/nodes/0/mesh", 1, "nodes[0].mesh"},
    {"/nodes/0/mesh", nullptr, "the scene shows no triangle mesh"},
    {"/nodes/0/skin", -1, "nodes[0].skin"},
    {"/nodes/0/translation", {1, 2}, "nodes[0].translation: is not an array of 3 numbers"},
    {"/nodes/0/translation", {1, "2", 3}, "nodes[0].translation[1]"},
    {"/nodes/0/matrix", {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, "nodes[0].matrix: is no affine matrix"},
    {"/nodes/2/matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, "which has a matrix"},
    {"/nodes/1/children", {1}, "two parents"},
    {"/nodes/2/children", {1}, "nodes: the hierarchy has a cycle"},
    {"/nodes/2/children", {2}, "two parents"},
    {"/nodes/0/children", {2}, "node 2 has two parents"},
    {"/nodes/1/children", {77}, "nodes[1].children[0]"},
    {"/scene", 4, "scene"},
    {"/scenes/0/nodes", {9}, "scenes[0].nodes[0]"},
    {"/skins/0/joints", json::array(), "skins[0].joints: names no joint"},
    {"/skins/0/joints", {1}, "names joint 1 of a skin with 1"},
    {"/skins/0/joints", {1, 2, 2}, "2 matrices for 3 joints"},
    {"/skins/0/inverseBindMatrices", 0, "components where 16 are needed"},
    {"/animations/0/samplers/0/input", 0, "components where 1 are needed"},
    {"/animations/0/samplers/0/output", 0,
     "animations[0].channels[0]: its sampler has 3 components a value, but 4 are needed"},
    {"/animations/0/samplers/0/interpolation", "BEZIER", "is no interpolation"},
    {"/animations/0/samplers/0/interpolation", "CUBICSPLINE", "its sampler has 12 numbers"},
    {"/animations/0/channels/0/sampler", 2, "animations[0].channels[0].sampler"},
    {"/animations/0/channels/0/target/node", 5, "animations[0].channels[0].target.node"},
    {"/accessors", 5, "accessors: is not an array"},
    {"/nodes", {{"0", 1}}, "nodes: is not an array"},
    {"/images", {{{"bufferView", 99}}}, "images[0].bufferView"},
    {"/images", {{{"name", "no bytes"}}}, "images[0]: has neither"},
    {"/images", {{{"uri", "../../etc/passwd"}}}, "images[0].uri: leads out"},
};

} // namespace

TEST(GltfMalformed, EveryLieIsFoundAndItsFieldNamed)
{
    for (const Lie& lie : lies) {
        SCOPED_TRACE(std::string(lie.place) + " = " + lie.value.dump());
        GlbMaker made = two_bones();
        made.bytes(); // writes "buffers"
        const json::json_pointer place(lie.place);
        if (lie.value.is_null())
            made.root[place.parent_pointer()].erase(place.back());
        else
            made.root[place] = lie.value;
        const bool remote = std::string(lie.said).find("is remote") != std::string::npos;
        expect_refused(made.bytes(), lie.said, remote ? ErrorCode::unsupported : ErrorCode::bad_input);
    }
}

TEST(GltfMalformed, EveryTruncationIsRefused)
{
    GlbMaker made = two_bones();
    const std::string whole = made.bytes();
    for (std::size_t size = 0; size < whole.size(); ++size)
        EXPECT_FALSE(load_bytes(whole.substr(0, size)).ok()) << size;
}

TEST(GltfMalformed, AFlippedByteIsRefusedOrGivesAValidAnimation)
{
    GlbMaker made = two_bones();
    std::string whole = made.bytes();
    for (std::size_t at = 0; at < whole.size(); ++at)
        for (int flip : {0x02, 0xff}) {
            whole[at] = static_cast<char>(whole[at] ^ flip);
            const auto read = load_bytes(whole, small_limits());
            EXPECT_TRUE(!read.ok() || validate(*read).ok());
            whole[at] = static_cast<char>(whole[at] ^ flip);
        }
}

TEST(GltfMalformed, AnIndexBeyondTheVerticesIsRefused)
{
    GlbMaker made;
    json primitive = made.triangle();
    primitive["indices"] = made.shorts({0, 1, 3});
    made.node({{"mesh", made.mesh(primitive)}});
    expect_refused(made.bytes(), "accessors[1]: index 2 is 3, beyond the 3 vertices");
}

TEST(GltfMalformed, ASparseIndexBeyondTheElementsIsRefused)
{
    GlbMaker made = two_bones();
    const std::uint16_t wrong[] = {4};
    made.root["accessors"][1]["sparse"]["indices"]["bufferView"] = made.view(wrong, sizeof wrong);
    expect_refused(made.bytes(), "accessors[1].sparse.indices: index 4 is beyond the 4 elements");
}

TEST(GltfMalformed, NumbersThatAreNoneAreRefused)
{
    for (float wrong : {std::nanf(""), INFINITY}) {
        GlbMaker made;
        made.node({{"mesh", made.mesh({{"attributes",
                                        {{"POSITION", made.floats({0, 0, 0, 1, 0, 0, 0, wrong, 0}, "VEC3")}}}})}});
        expect_refused(made.bytes(), "accessors[0]: element 2 is not a finite number");
    }
}

TEST(GltfMalformed, PositionsThatOverflowAreRefusedByFrameAndVertex)
{
    GlbMaker made;
    made.node({{"mesh", made.mesh(made.triangle())}, {"scale", {1e300, 1, 1}}});
    expect_refused(made.bytes(), "frame 0, vertex 1, x is infinite");
}

TEST(GltfMalformed, KeysMustFollowEachOther)
{
    GlbMaker made;
    const std::size_t node = made.node({{"mesh", made.mesh(made.triangle())}});
    made.clip("move", node, "translation", made.sampler({0, 1, 1}, std::vector<float>(9), "VEC3"));
    expect_refused(made.bytes(), "key 2 is not later than the key before it");
}

TEST(GltfMalformed, AClipOfAThousandYearsIsRefusedBeforeAnythingIsAllocated)
{
    GlbMaker made;
    const std::size_t node = made.node({{"mesh", made.mesh(made.triangle())}});
    made.clip("wait", node, "translation", made.sampler({0, 1, 3e10f}, std::vector<float>(9), "VEC3"));
    expect_refused(made.bytes(), "more than 1000000 frames");
}

TEST(GltfMalformed, AMillionFramesOfManyInstancesAreRefusedByTheMemoryLimit)
{
    GlbMaker made;
    const std::size_t mesh = made.mesh(made.triangle());
    for (int n = 0; n < 1000; ++n) made.node({{"mesh", mesh}, {"translation", {n, 0, 0}}});
    made.clip("wait", 0, "translation", made.sampler({0, 10, 9000}, std::vector<float>(9), "VEC3"));
    LoadOptions options = small_limits();
    options.fps = 100;
    const auto read = load_bytes(made.bytes(), options);
    ASSERT_FALSE(read.ok());
    EXPECT_NE(why(read).find("memory limit"), std::string::npos) << why(read);
}

TEST(GltfMalformed, AMillionFramesOfManyNodesAreRefusedByTheWorkLimit)
{
    GlbMaker made;
    made.node({{"mesh", made.mesh(made.triangle())}});
    for (int n = 0; n < 1000; ++n) made.node(json::object());
    made.clip("wait", 0, "translation", made.sampler({0, 10, 9000}, std::vector<float>(9), "VEC3"));
    LoadOptions options;
    options.fps = 100;
    options.limits.max_work = 1'000'000;
    const auto read = load_bytes(made.bytes(), options);
    ASSERT_FALSE(read.ok());
    EXPECT_NE(why(read).find("900001 sums of 66102 products are above the limit"), std::string::npos) << why(read);
}

TEST(GltfMalformed, AccessorsWithoutDataCannotAskForTheWorld)
{
    GlbMaker made;
    const std::size_t huge = made.add("accessors", {{"componentType", 5126}, {"count", 4000000}, {"type", "VEC3"}});
    json primitives = json::array();
    for (int p = 0; p < 50; ++p)
        primitives.push_back({{"attributes", {{"POSITION", huge}, {"_" + std::to_string(p), huge}}}});
    made.node({{"mesh", made.add("meshes", {{"primitives", primitives}})}});
    expect_refused(made.bytes(), "memory limit leaves only");
}

TEST(GltfMalformed, DeepNestingIsRefusedBeforeItIsParsed)
{
    std::string text =
        R"({"asset":{"version":"2.0"},"extras":)" + std::string(100000, '[') + std::string(100000, ']') + "}";
    expect_refused(text, "nested more than 256 levels deep");
}

TEST(GltfMalformed, BrokenJsonIsPlacedByByte)
{
    expect_refused(R"({"asset":{"version":"2.0"},)", "byte 27");
    expect_refused("[]", "JSON: is not an object");
    expect_refused("", "JSON");
    expect_refused(R"({"asset":{"version":"2.0"},"scene":1e999})", "a number that is too large");
}

TEST(GltfMalformed, OtherVersionsAndUnknownGeometryAreUnsupported)
{
    expect_refused(R"({"asset":{"version":"1.0"}})", "glTF version 1.0", ErrorCode::unsupported);
    GlbMaker made = two_bones();
    made.root["extensionsRequired"] = {"KHR_materials_unlit", "KHR_draco_mesh_compression"};
    expect_refused(made.bytes(), "extensionsRequired[1]: the extension KHR_draco_mesh_compression",
                   ErrorCode::unsupported);
    std::string old = two_bones().bytes();
    old[4] = 1;
    expect_refused(old, "GLB version 1", ErrorCode::unsupported);
}

TEST(GltfMalformed, AMissingNeighbourIsAnIoError)
{
    GlbMaker made = two_bones();
    made.bytes();
    made.root["buffers"][0]["uri"] = "missing.bin";
    const auto read = load_bytes(made.bytes());
    ASSERT_FALSE(read.ok());
    EXPECT_EQ(read.error().code, ErrorCode::io);
    EXPECT_NE(why(read).find("missing.bin"), std::string::npos);
}
