/// Makes GLB files, right ones and wrong ones.
// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>

#include "tests/io/made.h"

namespace meshreel::io::test {

using nlohmann::json;

/// Grows a GLB; `root` may be bent before it is written.
struct GlbMaker {
    json root = {{"asset", {{"version", "2.0"}}}, {"scene", 0}, {"scenes", {{{"nodes", json::array()}}}}};
    Bytes binary;

    std::size_t add(const char* list, json item)
    {
        root[list].push_back(std::move(item));
        return root[list].size() - 1;
    }

    std::size_t view(const void* data, std::size_t size)
    {
        binary.resize((binary.size() + 3) / 4 * 4);
        const auto* bytes = static_cast<const std::uint8_t*>(data);
        binary.insert(binary.end(), bytes, bytes + size);
        return add("bufferViews", {{"buffer", 0}, {"byteOffset", binary.size() - size}, {"byteLength", size}});
    }

    template <class Number>
    std::size_t accessor(const std::vector<Number>& values, const char* type, int component_type,
                         bool normalized = false)
    {
        const std::string_view name = type;
        const std::size_t components = name == "SCALAR" ? 1
                                       : name == "MAT4" ? 16
                                                        : static_cast<std::size_t>(name[3] - '0');
        json item = {{"bufferView", view(values.data(), values.size() * sizeof(Number))},
                     {"componentType", component_type},
                     {"count", values.size() / components},
                     {"type", type}};
        if (normalized) item["normalized"] = true;
        return add("accessors", std::move(item));
    }
    std::size_t floats(const std::vector<float>& values, const char* type) { return accessor(values, type, 5126); }
    std::size_t shorts(const std::vector<std::uint16_t>& values, const char* type = "SCALAR")
    {
        return accessor(values, type, 5123);
    }

    /// A node at the root of the scene.
    std::size_t node(json item)
    {
        const std::size_t n = add("nodes", std::move(item));
        root["scenes"][0]["nodes"].push_back(n);
        return n;
    }

    /// A mesh of one primitive with the given attributes.
    std::size_t mesh(json primitive) { return add("meshes", {{"primitives", {std::move(primitive)}}}); }

    /// The triangle (0 0 0) (1 0 0) (0 1 0) as a primitive.
    json triangle() { return {{"attributes", {{"POSITION", floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3")}}}}; }

    /// A clip of one channel.
    void clip(const std::string& name, std::size_t target, const char* path, json sampler)
    {
        add("animations", {{"name", name},
                           {"samplers", {std::move(sampler)}},
                           {"channels", {{{"sampler", 0}, {"target", {{"node", target}, {"path", path}}}}}}});
    }
    json sampler(const std::vector<float>& times, const std::vector<float>& values, const char* type,
                 const char* interpolation = "LINEAR")
    {
        return {{"input", floats(times, "SCALAR")}, {"output", floats(values, type)}, {"interpolation", interpolation}};
    }

    std::string bytes()
    {
        binary.resize((binary.size() + 3) / 4 * 4);
        if (!root.contains("buffers")) root["buffers"] = {{{"byteLength", binary.size()}}};
        std::string text = root.dump();
        text.resize((text.size() + 3) / 4 * 4, ' ');
        std::string file;
        for (std::size_t word : {0x46546c67ul, 2ul, 28 + text.size() + binary.size(), text.size(), 0x4e4f534aul})
            put(file, word);
        file += text;
        for (std::size_t word : {binary.size(), 0x004e4942ul}) put(file, word);
        return file + std::string(binary.begin(), binary.end());
    }

private:
    static void put(std::string& file, std::size_t word)
    {
        for (int shift = 0; shift < 32; shift += 8) file += static_cast<char>(word >> shift);
    }
};

inline Result<Animation> load_bytes(const std::string& bytes, const LoadOptions& options = {})
{
    const Folder folder;
    write(folder / "made.glb", bytes);
    return load(folder / "made.glb", options);
}

inline Animation loaded(GlbMaker& maker, const LoadOptions& options = {})
{
    auto result = load_bytes(maker.bytes(), options);
    if (!result.ok()) {
        ADD_FAILURE() << result.error().sentence();
        return {};
    }
    return *std::move(result);
}

/// Coordinates of one vertex in one frame.
inline std::array<double, 3> point(const Animation& animation, std::size_t frame, std::size_t vertex)
{
    if (animation.frame_count() <= frame || animation.vertex_count <= vertex) return {NAN, NAN, NAN};
    const auto p = animation.frame(frame).subspan(vertex * 3, 3);
    return {p[0], p[1], p[2]};
}

inline void expect_point(const Animation& animation, std::size_t frame, std::size_t vertex,
                         std::array<double, 3> wanted)
{
    const auto found = point(animation, frame, vertex);
    for (std::size_t axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(found[axis], wanted[axis], 1e-6) << "frame " << frame << " vertex " << vertex << " axis " << axis;
}

/// A strip of two triangles on two joints, the second of which turns; one morph target, sparse; a clip of three keys.
inline GlbMaker two_bones()
{
    GlbMaker made;
    const std::size_t positions = made.floats({0, 0, 0, 1, 0, 0, 0, 2, 0, 1, 2, 0}, "VEC3");
    const std::uint16_t indices[] = {3};
    const float offsets[] = {0, 0, 5};
    const std::size_t index_view = made.view(indices, sizeof indices), value_view = made.view(offsets, sizeof offsets);
    const std::size_t target =
        made.add("accessors", {{"componentType", 5126},
                               {"count", 4},
                               {"type", "VEC3"},
                               {"sparse",
                                {{"count", 1},
                                 {"indices", {{"bufferView", index_view}, {"componentType", 5123}}},
                                 {"values", {{"bufferView", value_view}}}}}});
    const std::size_t joints = made.shorts({0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}, "VEC4");
    const std::size_t weights = made.floats({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0.5f, 0.5f, 0, 0}, "VEC4");
    const std::size_t strip =
        made.mesh({{"attributes", {{"POSITION", positions}, {"JOINTS_0", joints}, {"WEIGHTS_0", weights}}},
                   {"indices", made.shorts({0, 1, 2, 3})},
                   {"mode", 5},
                   {"targets", {{{"POSITION", target}}}}});
    made.node({{"mesh", strip}, {"skin", 0}, {"translation", {100, 0, 0}}}); // a skinned mesh ignores its node
    made.node({{"name", "hip"}, {"children", {2}}});
    made.add("nodes", {{"name", "knee"}, {"translation", {0, 1, 0}}});
    made.add("skins", {{"joints", {1, 2}},
                       {"inverseBindMatrices", made.floats({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0,  0, 1,
                                                            1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1},
                                                           "MAT4")}});
    const float half = 0.70710678f;
    made.add("animations", {{"name", "bend"},
                            {"samplers",
                             {made.sampler({0, 0.5f, 1}, {0, 0, 0, 1, 0, 0, half, half, 0, 0, half, half}, "VEC4"),
                              made.sampler({0, 1}, {0, 1}, "SCALAR")}},
                            {"channels",
                             {{{"sampler", 0}, {"target", {{"node", 2}, {"path", "rotation"}}}},
                              {{"sampler", 1}, {"target", {{"node", 0}, {"path", "weights"}}}}}}});
    return made;
}

} // namespace meshreel::io::test
