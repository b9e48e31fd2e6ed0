/// Saves an animation as glTF: the mesh, its morph targets, the weight track.
// SPDX-License-Identifier: MIT
#include <cmath>

#include "meshreel/base/text.h"
#include "meshreel/io/attributes.h"
#include "meshreel/io/file_set.h"
#include "meshreel/io/frames.h"
#include "meshreel/io/gltf.h"
#include "meshreel/io/gltf_names.h"
#include "meshreel/io/gltf_write_attributes.h"
#include "meshreel/linalg/pca_shapes.h"

namespace meshreel::io {

namespace {

using nlohmann::json;

/// What moves the mesh: frame f = base + sum_k weights(f, k) targets(k).
struct Motion {
    std::span<const float> base;    ///< [V x 3]
    Matrix<float> weights;          ///< [F x K]
    std::vector<std::string> names; ///< [K]
    linalg::ShapeModes modes;       ///< where Morphs::pca
};

Motion frame_motion(const Animation& animation)
{
    Motion motion;
    motion.base = animation.frame(0);
    const std::size_t F = animation.frame_count();
    motion.weights = Matrix<float>(F, F - 1);
    for (std::size_t f = 1; f < F; ++f) {
        motion.weights(f, f - 1) = 1.0f;
        motion.names.push_back(concat("frame_", f));
    }
    return motion;
}

Motion pca_motion(const Animation& animation, const SaveOptions& options)
{
    constexpr double tolerance = 0.97e-4; // 0.01 %, with room for the rounding of base and modes
    Motion motion;
    const MatrixView<const float> frames{animation.positions.data(), animation.frame_count(),
                                         animation.vertex_count * 3ul};
    motion.modes =
        linalg::pca_of_shapes(frames, {options.bases, tolerance * body_diagonal(animation), {}, options.progress});
    const double error = motion.modes.largest_error / body_diagonal(animation);
    if (error > 1e-4)
        tell(options,
             concat(motion.modes.modes.rows, " modes leave an error of ", error * 100, " % of the body diagonal"));
    motion.base = motion.modes.base;
    motion.weights = std::move(motion.modes.weights);
    for (std::size_t k = 0; k < motion.weights.cols; ++k) motion.names.push_back(concat("mode_", k));
    return motion;
}

/// The offset that, added to `from` in float, gives `to`, or the nearest to that.
float offset(float from, float to)
{
    const float plain = to - from;
    if (from + plain == to) return plain;
    const float above = std::nextafter(plain, INFINITY), below = std::nextafter(plain, -INFINITY);
    return from + above == to ? above : from + below == to ? below : plain;
}

/// Target k of the vertices of a set.
std::vector<float> target_values(const Animation& animation, const Motion& motion, std::size_t k,
                                 const GltfVertexSet& set)
{
    std::vector<float> values(set.sources.size() * 3);
    for (std::size_t i = 0; i < values.size(); ++i) {
        const std::size_t at = set.sources[i / 3] * 3ul + i % 3;
        values[i] = motion.modes.modes.rows > 0 ? motion.modes.modes(k, at)
                                                : offset(motion.base[at], animation.frame(k + 1)[at]);
    }
    return values;
}

/// What the primitives of a set have in common: "attributes" with POSITION, and "targets".
json add_positions(GltfBuilder& builder, const Animation& animation, const Motion& motion, const GltfVertexSet& set)
{
    std::vector<float> base(set.sources.size() * 3);
    for (std::size_t i = 0; i < base.size(); ++i) base[i] = motion.base[set.sources[i / 3] * 3ul + i % 3];
    json shared = json::object();
    builder.open_view(12);
    shared["attributes"]["POSITION"] = builder.add_floats(base, "VEC3", true);
    builder.close_view();
    if (motion.weights.cols == 0) return shared;
    builder.open_view(12);
    for (std::size_t k = 0; k < motion.weights.cols; ++k)
        shared["targets"].push_back(
            {{"POSITION", builder.add_floats(target_values(animation, motion, k, set), "VEC3", true)}});
    builder.close_view();
    return shared;
}

std::size_t add_indices(GltfBuilder& builder, const GltfPrimitive& primitive, std::size_t vertex_count)
{
    const bool small = vertex_count <= 65535; // 65535 itself would restart a primitive
    builder.open_view(0, true);
    for (std::uint32_t index : primitive.indices) {
        if (small)
            append_little(builder.binary, static_cast<std::uint16_t>(index));
        else
            append_little(builder.binary, index);
    }
    builder.close_view();
    return builder.add("accessors", {{"bufferView", builder.view()},
                                     {"componentType", small ? 5123 : 5125},
                                     {"count", primitive.indices.size()},
                                     {"type", "SCALAR"}});
}

json mesh_json(const GltfNodeOut& node, const std::vector<json>& primitives, const Motion& motion)
{
    json mesh = {{"primitives", json::array()}};
    if (!node.mesh.empty()) mesh["name"] = node.mesh;
    for (std::size_t p : node.primitives) mesh["primitives"].push_back(primitives[p]);
    if (motion.weights.cols == 0) return mesh;
    mesh["weights"] = std::vector<float>(motion.weights.row(0).begin(), motion.weights.row(0).end());
    mesh["extras"] = {{"targetNames", motion.names}};
    return mesh;
}

void add_meshes(GltfBuilder& builder, const Animation& animation, const Motion& motion, const SaveOptions& options)
{
    const GltfLayout layout = gltf_layout(animation);
    std::vector<json> shared, primitives;
    for (const GltfVertexSet& set : layout.sets) {
        report(options.progress, "writing meshes",
               static_cast<double>(shared.size()) / static_cast<double>(layout.sets.size()));
        const json attributes = add_attributes(builder, animation, set, options);
        shared.push_back(add_positions(builder, animation, motion, set));
        shared.back()["attributes"].update(attributes);
    }
    const std::size_t materials = builder.root.contains("materials") ? builder.root["materials"].size() : 0;
    for (const GltfPrimitive& primitive : layout.primitives) {
        json item = shared[primitive.set];
        item["indices"] = add_indices(builder, primitive, layout.sets[primitive.set].sources.size());
        if (primitive.material < materials) item["material"] = primitive.material;
        primitives.push_back(std::move(item));
    }
    for (const GltfNodeOut& node : layout.nodes) {
        json item = {{"mesh", builder.add("meshes", mesh_json(node, primitives, motion))}};
        if (!node.name.empty()) item["name"] = node.name;
        builder.root["scenes"][0]["nodes"].push_back(builder.add("nodes", std::move(item)));
    }
}

/// One track for all nodes: the weights, or, where there are none, a rest that keeps the times and the clip's name.
void add_clip(GltfBuilder& builder, const Animation& animation, const Motion& motion)
{
    const bool moves = motion.weights.cols > 0;
    const std::vector<float> times(animation.times_s.begin(), animation.times_s.end()), rest(times.size() * 3);
    builder.open_view(0);
    const std::size_t input = builder.add_floats(times, "SCALAR", true);
    builder.close_view();
    builder.open_view(0);
    const std::size_t output =
        moves ? builder.add_floats(motion.weights.values, "SCALAR", false) : builder.add_floats(rest, "VEC3", false);
    builder.close_view();
    json clip = {{"samplers", {{{"input", input}, {"output", output}, {"interpolation", "LINEAR"}}}},
                 {"channels", json::array()}};
    if (!animation.meta.name.empty()) clip["name"] = animation.meta.name;
    for (std::size_t n = 0; n < builder.root["nodes"].size(); ++n)
        clip["channels"].push_back(
            {{"sampler", 0}, {"target", {{"node", n}, {"path", moves ? "weights" : "translation"}}}});
    builder.add("animations", std::move(clip));
}

/// A single frame at time 0 without a name is a plain mesh.
bool has_clip(const Animation& animation)
{
    return animation.frame_count() > 1 || animation.times_s[0] > 0 || !animation.meta.name.empty();
}

/// Times become float32; they must stay apart, and none may be negative.
Status check_times(const Animation& animation)
{
    for (std::size_t f = 0; f < animation.frame_count(); ++f) {
        const double time = animation.times_s[f];
        if (time < 0)
            return unsupported(concat("frame ", f, " is at ", time, " s; glTF has no negative times"), "times");
        if (f > 0 && !(static_cast<float>(time) > static_cast<float>(animation.times_s[f - 1])))
            return unsupported(concat("frames ", f - 1, " and ", f, " are at the same time in glTF's 32-bit floats"),
                               "times");
    }
    return Ok{};
}

void tell_losses(const Animation& animation, const SaveOptions& options)
{
    if (animation.meta.up == Axis::x || animation.meta.up == Axis::z)
        tell(options, "glTF takes y as up; the positions are written as they are");
    if (animation.meta.metres_per_unit != 0 && animation.meta.metres_per_unit != 1)
        tell(options, "glTF counts in metres; the positions are written as they are");
    for (const Attribute& attribute : animation.appearance.attributes)
        if (!attribute_semantic(attribute.name) && attribute.name != "material" && attribute.name != "group")
            tell(options, concat("the file cannot hold the attribute ", attribute.name));
}

void append_chunk(Bytes& file, std::uint32_t type, ByteView body, std::uint8_t padding)
{
    append_little(file, static_cast<std::uint32_t>((body.size() + 3) / 4 * 4));
    append_little(file, type);
    file.insert(file.end(), body.begin(), body.end());
    file.resize((file.size() + 3) / 4 * 4, padding);
}

Status write_glb(FileSet& files, const std::string& path, const std::string& text, const Bytes& binary)
{
    constexpr std::uint32_t magic = 0x46546c67, json_chunk = 0x4e4f534a, binary_chunk = 0x004e4942;
    const std::uint64_t size = 28 + (text.size() + 3) / 4 * 4 + (binary.size() + 3) / 4 * 4;
    if (size > 0xffffffff)
        return unsupported(concat("a GLB of ", size, " bytes; it may have 4 GB. Write .gltf"), "length");
    Bytes file;
    file.reserve(size);
    append_little(file, magic);
    append_little(file, std::uint32_t{2});
    append_little(file, static_cast<std::uint32_t>(size));
    append_chunk(file, json_chunk, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, ' ');
    append_chunk(file, binary_chunk, binary, 0);
    return files.add(path, file);
}

bool ends_with_gltf(const std::string& path)
{
    return path.size() > 5 && (path[path.size() - 4] == 'g' || path[path.size() - 4] == 'G') &&
           path[path.size() - 5] == '.';
}

/// "some walk.gltf" refers to "some%20walk.bin".
std::string binary_uri(const std::string& path)
{
    constexpr std::string_view digits = "0123456789ABCDEF", plain = "-._~";
    const std::size_t slash = path.rfind('/');
    std::string uri;
    for (char c : path.substr(slash == path.npos ? 0 : slash + 1)) {
        const bool word =
            (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || plain.find(c) != plain.npos;
        const auto byte = static_cast<unsigned char>(c);
        uri += word ? std::string(1, c)
                    : concat("%", std::string(1, digits[byte / 16]), std::string(1, digits[byte % 16]));
    }
    return uri;
}

} // namespace

Status save_gltf(const Animation& animation, const std::string& path, const SaveOptions& options)
{
    if (animation.triangles.empty()) return unsupported("a mesh without triangles", "triangles");
    MESHREEL_CHECK(check_times(animation));
    tell_losses(animation, options);
    GltfBuilder builder;
    builder.root["asset"] = {{"version", "2.0"}, {"generator", "meshreel"}};
    builder.root["scene"] = 0;
    add_materials(builder, animation, options);
    const Motion motion = options.morphs == Morphs::pca ? pca_motion(animation, options) : frame_motion(animation);
    add_meshes(builder, animation, motion, options);
    if (has_clip(animation)) add_clip(builder, animation, motion);
    const bool separate = ends_with_gltf(path);
    const std::string binary_path = separate ? path.substr(0, path.size() - 5) + ".bin" : std::string();
    builder.root["buffers"] = {{{"byteLength", builder.binary.size()}}};
    if (separate) builder.root["buffers"][0]["uri"] = binary_uri(binary_path);
    const std::string text = builder.root.dump(separate ? 1 : -1, ' ', false, json::error_handler_t::replace);
    FileSet files(options.overwrite);
    if (!separate) {
        MESHREEL_CHECK(write_glb(files, path, text, builder.binary));
    } else {
        MESHREEL_CHECK(files.add(binary_path, builder.binary));
        MESHREEL_CHECK(files.add(path, ByteView(reinterpret_cast<const std::uint8_t*>(text.data()), text.size())));
    }
    return files.commit();
}

} // namespace meshreel::io
