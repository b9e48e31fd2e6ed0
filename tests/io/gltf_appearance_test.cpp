/// What a glTF file looks like comes along bit for bit, and goes back out as it came.
// SPDX-License-Identifier: MIT
#include <algorithm>

#include "tests/io/gltf_made.h"

using namespace meshreel;
using namespace meshreel::io;
using namespace meshreel::io::test;

namespace {

template <class Number>
Bytes raw(const std::vector<Number>& values)
{
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(values.data());
    return Bytes(bytes, bytes + values.size() * sizeof(Number));
}

const Asset* asset(const Animation& animation, const std::string& name)
{
    for (const Asset& one : animation.appearance.assets)
        if (one.name == name) return &one;
    return nullptr;
}

Animation through_glb(const Animation& animation, const SaveOptions& options = {})
{
    const Folder folder;
    const Status saved = save(animation, folder / "back.glb", options);
    EXPECT_TRUE(saved.ok()) << why(saved);
    const auto read = load(folder / "back.glb");
    EXPECT_TRUE(read.ok()) << why(read);
    return read.ok() ? *read : Animation{};
}

/// The JSON of a GLB that holds the animation.
json written_json(const Animation& animation)
{
    const Folder folder;
    const Status saved = save(animation, folder / "out.gltf");
    EXPECT_TRUE(saved.ok()) << why(saved);
    return json::parse(read(folder / "out.gltf"));
}

/// Two materials, a texture, three primitives in two nodes of one name, attributes of several types.
GlbMaker dressed_glb()
{
    GlbMaker made;
    json first = made.triangle(), second = made.triangle(), third = made.triangle();
    first["attributes"]["TEXCOORD_0"] = made.floats({0, 0, 1, 0, 0, 1}, "VEC2");
    first["attributes"]["COLOR_0"] =
        made.accessor(std::vector<std::uint8_t>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}, "VEC4", 5121, true);
    second["attributes"]["TEXCOORD_0"] =
        made.accessor(std::vector<std::uint16_t>{1, 2, 3, 4, 5, 6}, "VEC2", 5123, true);
    third["attributes"]["_HEAT"] = made.accessor(std::vector<std::int8_t>{-1, -2, -3}, "SCALAR", 5120);
    made.root["accessors"].back()["byteOffset"] = 0;
    first["material"] = 1;
    second["material"] = 0;
    const std::string png = "\x89PNG not really";
    made.root["images"] = {
        {{"bufferView", made.view(png.data(), png.size())}, {"mimeType", "image/png"}, {"name", "bark"}},
        {{"uri", "data:image/jpeg;base64,/9j/AAEC"}}};
    made.root["samplers"] = {{{"wrapS", 33071}}};
    made.root["textures"] = {{{"sampler", 0}, {"source", 0}}, {{"source", 1}}};
    made.root["materials"] = {
        {{"name", "leaf"}, {"extensions", {{"KHR_materials_unlit", json::object()}}}},
        {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 1}}}, {"roughnessFactor", 0.1234567890123}}},
         {"extras", {{"key", "value"}}}}};
    made.root["extensionsUsed"] = {"KHR_materials_unlit", "KHR_unheard_of"};
    made.root["asset"]["copyright"] = "CC-BY someone";
    const std::size_t tree = made.add("meshes", {{"name", "tree/oak"}, {"primitives", {first, second}}});
    const std::size_t stone = made.add("meshes", {{"primitives", {third}}});
    made.node({{"name", "thing"}, {"mesh", tree}});
    made.node({{"name", "thing"}, {"mesh", stone}});
    return made;
}

} // namespace

TEST(GltfAppearance, AttributesKeepTheirTypeAndBits)
{
    GlbMaker made = dressed_glb();
    const Animation read = loaded(made);
    const Attribute* color = read.appearance.find("color0");
    ASSERT_NE(color, nullptr);
    EXPECT_EQ(color->type, Scalar::u8);
    EXPECT_TRUE(color->normalized);
    EXPECT_EQ(color->values, Bytes({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}));
    const std::uint32_t none = 0xffffffff;
    EXPECT_EQ(color->indices, std::vector<std::uint32_t>({0, 1, 2, none, none, none, none, none, none}));
    const Attribute* heat = read.appearance.find("_HEAT");
    ASSERT_NE(heat, nullptr);
    EXPECT_EQ(heat->values, Bytes({0xff, 0xfe, 0xfd}));
}

TEST(GltfAppearance, OneAttributeInTwoTypesIsKeptAsTwo)
{
    GlbMaker made = dressed_glb();
    const Animation read = loaded(made);
    const Attribute *floats = read.appearance.find("uv0"), *shorts = read.appearance.find("uv0|u16nx2");
    ASSERT_TRUE(floats != nullptr && shorts != nullptr);
    EXPECT_EQ(floats->values, raw<float>({0, 0, 1, 0, 0, 1}));
    EXPECT_EQ(shorts->values, raw<std::uint16_t>({1, 2, 3, 4, 5, 6}));
}

TEST(GltfAppearance, TrianglesKnowTheirMaterialNodeMeshAndPrimitive)
{
    GlbMaker made = dressed_glb();
    const Animation read = loaded(made);
    EXPECT_EQ(read.appearance.materials, std::vector<std::string>({"leaf", "material_1"}));
    EXPECT_EQ(read.appearance.groups,
              std::vector<std::string>({"thing/tree%2Foak#0", "thing/tree%2Foak#1", "thing@2/#0"}));
    EXPECT_EQ(read.appearance.find("group")->values, raw<std::uint32_t>({0, 1, 2}));
    EXPECT_EQ(read.appearance.find("material")->indices.back(), 0xffffffffu);
}

TEST(GltfAppearance, ImagesAreAssetsWithTheirBytesAndType)
{
    GlbMaker made = dressed_glb();
    const Animation read = loaded(made);
    ASSERT_NE(asset(read, "gltf/images/0"), nullptr);
    EXPECT_EQ(text_of(asset(read, "gltf/images/0")->bytes), "\x89PNG not really");
    EXPECT_EQ(asset(read, "gltf/images/1")->mime_type, "image/jpeg");
    EXPECT_EQ(asset(read, "gltf/images/1")->bytes, Bytes({0xff, 0xd8, 0xff, 0, 1, 2}));
    EXPECT_EQ(asset(read, "gltf/materials")->mime_type, "model/gltf+json;materials");
}

TEST(GltfAppearance, AnImageThatIsMissingIsToldAndKeepsItsReference)
{
    GlbMaker made = dressed_glb();
    made.root["images"][1] = {{"uri", "missing.jpg"}};
    const Listener listener;
    const Animation read = loaded(made, listener.options);
    EXPECT_TRUE(listener.has("missing.jpg"));
    EXPECT_EQ(asset(read, "gltf/images/1"), nullptr);
    EXPECT_EQ(written_json(read)["images"][1]["uri"], "missing.jpg");
}

TEST(GltfAppearance, ABinaryAndAnImageBesideTheFileAreRead)
{
    GlbMaker made = dressed_glb();
    made.bytes();
    const Folder folder;
    write(folder / "a b.bin", text_of(made.binary));
    write(folder / "c.webp", std::string("RIFF\4\0\0\0WEBP", 12));
    made.root["buffers"][0]["uri"] = "a%20b.bin";
    made.root["images"][1] = {{"uri", "c.webp"}};
    write(folder / "made.gltf", made.root.dump());
    const auto read = load(folder / "made.gltf");
    ASSERT_TRUE(read.ok()) << why(read);
    EXPECT_EQ(asset(*read, "gltf/images/1")->mime_type, "image/webp");
}

TEST(GltfAppearance, AGlbGoesOutAsItCameIn)
{
    GlbMaker made = dressed_glb();
    const Animation once = loaded(made), twice = through_glb(once);
    EXPECT_EQ(twice.triangles, once.triangles);
    EXPECT_TRUE(same_bits(twice.positions, once.positions));
    EXPECT_EQ(twice.appearance.groups, once.appearance.groups);
    EXPECT_EQ(twice.appearance.materials, once.appearance.materials);
    ASSERT_EQ(twice.appearance.attributes.size(), once.appearance.attributes.size());
    for (const Attribute& attribute : once.appearance.attributes) {
        ASSERT_NE(twice.appearance.find(attribute.name), nullptr) << attribute.name;
        EXPECT_EQ(twice.appearance.find(attribute.name)->values, attribute.values) << attribute.name;
        EXPECT_EQ(twice.appearance.find(attribute.name)->indices, attribute.indices) << attribute.name;
    }
    ASSERT_EQ(twice.appearance.assets.size(), once.appearance.assets.size());
    for (std::size_t i = 1; i < once.appearance.assets.size(); ++i)
        EXPECT_EQ(twice.appearance.assets[i].bytes, once.appearance.assets[i].bytes);
}

TEST(GltfAppearance, MaterialsTexturesSamplersAndCreditsGoOutAsTheyCameIn)
{
    GlbMaker made = dressed_glb();
    const json out = written_json(loaded(made));
    for (const char* list : {"materials", "textures", "samplers"}) EXPECT_EQ(out[list], made.root[list]) << list;
    EXPECT_EQ(out["asset"]["copyright"], "CC-BY someone");
    EXPECT_EQ(out["extensionsUsed"], json::array({"KHR_materials_unlit"}));
    EXPECT_EQ(out["images"][0]["name"], "bark");
    EXPECT_EQ(out["nodes"][0]["name"], "thing");
    EXPECT_EQ(out["meshes"][0]["name"], "tree/oak");
}

TEST(GltfAppearance, ACopyOfMaterialsThatDoesNotFitIsNotUsed)
{
    GlbMaker made = dressed_glb();
    Animation read = loaded(made);
    read.appearance.materials.push_back("one more");
    const json out = written_json(read);
    EXPECT_EQ(out["materials"], json::parse(R"([{"name":"leaf"},{"name":"material_1"},{"name":"one more"}])"));
    EXPECT_FALSE(out.contains("textures"));
}
