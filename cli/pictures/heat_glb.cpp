/// The heat map of a whole animation as GLB: morph targets, vertex colours, a colour bar of triangles.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/pictures/colour_bar_mesh.h"
#include "cli/pictures/heat_map.h"

namespace meshreel::cli {

namespace {

using GlbJson = nlohmann::json;

constexpr int code_u8 = 5121, code_u16 = 5123, code_u32 = 5125, code_f32 = 5126; ///< glTF 2.0, 3.6.2.2
constexpr int for_vertices = 34962, for_indices = 34963;
constexpr std::uint64_t glb_limit = 0xffffffff;

/// What a run of numbers is in the file.
struct GlbColumn {
    const char* type; ///< "VEC3"
    int code;
    int target = for_vertices; ///< 0: none
    bool normalized = false;
};

/// The JSON and the bytes of a GLB while they grow.
class GlbFile {
public:
    GlbFile() { root["asset"] = {{"version", "2.0"}, {"generator", "meshreel"}}; }

    template <class T>
    std::size_t add(std::span<const T> values, std::size_t count, const GlbColumn& column)
    {
        const std::size_t begin = bytes_.size(), size = values.size() * sizeof(T);
        bytes_.resize((begin + size + 3) / 4 * 4);
        std::memcpy(bytes_.data() + begin, values.data(), size);
        GlbJson view = {{"buffer", 0}, {"byteOffset", begin}, {"byteLength", size}};
        if (column.target != 0) view["target"] = column.target;
        GlbJson accessor = {{"bufferView", push("bufferViews", std::move(view))},
                            {"componentType", column.code},
                            {"count", count},
                            {"type", column.type}};
        if (column.normalized) accessor["normalized"] = true;
        return push("accessors", std::move(accessor));
    }

    /// The same with the smallest and the largest of each component.
    std::size_t add_bounded(std::span<const float> values, const GlbColumn& column, std::size_t components)
    {
        std::vector<float> low(components, std::numeric_limits<float>::infinity()), high(components, -low[0]);
        for (std::size_t i = 0; i < values.size(); ++i) {
            low[i % components] = std::min(low[i % components], values[i]);
            high[i % components] = std::max(high[i % components], values[i]);
        }
        const std::size_t place = add(values, values.size() / components, column);
        root["accessors"][place]["min"] = low;
        root["accessors"][place]["max"] = high;
        return place;
    }

    std::size_t push(const char* list, GlbJson item)
    {
        root[list].push_back(std::move(item));
        return root[list].size() - 1;
    }

    std::size_t size() const { return bytes_.size(); }

    Result<Bytes> finish()
    {
        root["buffers"] = {{{"byteLength", bytes_.size()}}};
        std::string text = root.dump(-1, ' ', false, GlbJson::error_handler_t::replace);
        text.resize((text.size() + 3) / 4 * 4, ' ');
        const std::uint64_t size = 28 + text.size() + bytes_.size();
        if (size > glb_limit) return unsupported("a GLB may have 4 GB; take fewer frames by --frames");
        Bytes file;
        file.reserve(size);
        for (std::uint64_t word :
             {std::uint64_t{0x46546c67}, std::uint64_t{2}, size, std::uint64_t{text.size()}, std::uint64_t{0x4e4f534a}})
            append_word(file, word);
        file.insert(file.end(), text.begin(), text.end());
        append_word(file, bytes_.size());
        append_word(file, 0x004e4942);
        file.insert(file.end(), bytes_.begin(), bytes_.end());
        return file;
    }

    GlbJson root;

private:
    static void append_word(Bytes& file, std::uint64_t word)
    {
        for (int shift = 0; shift < 32; shift += 8) file.push_back(static_cast<std::uint8_t>(word >> shift));
    }

    Bytes bytes_;
};

/// y is up in glTF: where another axis is, a node turns the mesh.
std::array<double, 3> glb_point(const float* p, Axis up)
{
    if (up == Axis::z) return {p[0], p[2], -static_cast<double>(p[1])};
    if (up == Axis::x) return {-static_cast<double>(p[1]), p[0], p[2]};
    return {p[0], p[1], p[2]};
}

class HeatGlb {
public:
    HeatGlb(const Surfaces& surfaces, const HeatMapOptions& options)
        : surfaces_(surfaces), options_(options), source_(surfaces.coloured()),
          errors_(surfaces.heat->values(options.of)), scale_(surfaces.scale_for(errors_))
    {
    }

    Result<Bytes> write()
    {
        const std::uint64_t size = std::uint64_t{source_.frame_count()} * source_.still().vertex_count * 12;
        if (size > glb_limit) return unsupported("a GLB may have 4 GB; take fewer frames by --frames");
        MESHREEL_CHECK(add_mesh());
        if (source_.frame_count() > 1) MESHREEL_CHECK(add_clip());
        add_colour_bar();
        const HeatLabel& label = surfaces_.heat->label();
        file_.root["scene"] = 0;
        file_.root["scenes"] = {{{"nodes", {0, 1}},
                                 {"extras",
                                  {{"meshreel",
                                    {{"measure", label.name},
                                     {"title", label.title},
                                     {"unit", label.unit},
                                     {"of", options_.of.text()},
                                     {"colour_map", "viridis"},
                                     {"range", {0.0, scale_.top}},
                                     {"values", "_ERROR"}}}}}}};
        return file_.finish();
    }

private:
    Status add_mesh()
    {
        const Animation& still = source_.still();
        GlbJson primitive = {{"mode", still.triangles.empty() ? 0 : 4}, {"material", 0}};
        if (!still.triangles.empty())
            primitive["indices"] =
                file_.add(std::span<const std::uint32_t>(still.triangles.front().data(), still.triangles.size() * 3),
                          still.triangles.size() * 3, {"SCALAR", code_u32, for_indices});
        std::vector<float> values;
        for (double error : errors_)
            values.push_back(std::isfinite(error) ? static_cast<float>(error) : largest_float());
        std::vector<std::uint16_t> colours;
        for (double error : errors_) {
            for (float channel : viridis(scale_.place(error)))
                colours.push_back(static_cast<std::uint16_t>(std::lround(65535.0f * channel)));
            colours.push_back(65535);
        }
        MESHREEL_CHECK(add_positions(primitive));
        primitive["attributes"]["COLOR_0"] =
            file_.add(std::span<const std::uint16_t>(colours), values.size(), {"VEC4", code_u16, for_vertices, true});
        primitive["attributes"]["_ERROR"] =
            file_.add(std::span<const float>(values), values.size(), {"SCALAR", code_f32});
        GlbJson mesh = {{"name", surfaces_.heat->label().title}, {"primitives", {std::move(primitive)}}};
        if (source_.frame_count() > 1) mesh["weights"] = std::vector<float>(source_.frame_count() - 1, 0.0f);
        GlbJson node = {{"name", "heat map"}, {"mesh", file_.push("meshes", std::move(mesh))}};
        constexpr double half = 0.70710678118654752;
        if (surfaces_.upright() == Axis::z) node["rotation"] = {-half, 0.0, 0.0, half};
        if (surfaces_.upright() == Axis::x) node["rotation"] = {0.0, 0.0, half, half};
        file_.push("nodes", std::move(node));
        file_.push("materials", {{"name", "error"},
                                 {"doubleSided", true},
                                 {"pbrMetallicRoughness", {{"metallicFactor", 0.0}, {"roughnessFactor", 0.9}}}});
        return Ok{};
    }

    static float largest_float() { return std::numeric_limits<float>::max(); }

    /// The first frame, and of the others what is to be added to it.
    Status add_positions(GlbJson& primitive)
    {
        std::vector<float> base;
        return for_frame_runs(source_, [&](std::size_t first, MatrixView<const float> frames) -> Status {
            for (std::size_t i = 0; i < frames.rows; ++i) {
                const std::span<const float> row = frames.row(i);
                take_bounds(row);
                if (first + i == 0) {
                    base.assign(row.begin(), row.end());
                    primitive["attributes"]["POSITION"] = file_.add_bounded(base, {"VEC3", code_f32}, 3);
                    continue;
                }
                std::vector<float> moved(row.begin(), row.end());
                for (std::size_t j = 0; j < moved.size(); ++j) moved[j] -= base[j];
                primitive["targets"].push_back({{"POSITION", file_.add_bounded(moved, {"VEC3", code_f32}, 3)}});
            }
            return Ok{};
        });
    }

    void take_bounds(std::span<const float> row)
    {
        for (std::size_t v = 0; v < row.size(); v += 3) {
            const std::array<double, 3> p = glb_point(&row[v], surfaces_.upright());
            for (std::size_t c = 0; c < 3; ++c) {
                bounds_.low[c] = std::min(bounds_.low[c], p[c]);
                bounds_.high[c] = std::max(bounds_.high[c], p[c]);
            }
        }
    }

    Status add_clip()
    {
        const std::vector<double>& seconds = source_.still().times_s;
        const double start = std::min(seconds.front(), 0.0); // there are no times below 0
        std::vector<float> times;
        for (double t : seconds) times.push_back(static_cast<float>(t - start));
        if (std::adjacent_find(times.begin(), times.end(), std::greater_equal<>{}) != times.end())
            return unsupported("two frames are at the same time in glTF's 32-bit floats", "times");
        const std::size_t F = times.size();
        std::vector<float> weights(F * (F - 1), 0.0f);
        for (std::size_t f = 1; f < F; ++f) weights[f * (F - 1) + f - 1] = 1.0f;
        const std::size_t input = file_.add_bounded(times, {"SCALAR", code_f32, 0}, 1);
        const std::size_t output = file_.add(std::span<const float>(weights), weights.size(), {"SCALAR", code_f32, 0});
        file_.push("animations", {{"samplers", {{{"input", input}, {"output", output}, {"interpolation", "LINEAR"}}}},
                                  {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}}});
        return Ok{};
    }

    void add_colour_bar()
    {
        const HeatLabel& label = surfaces_.heat->label();
        const ColourBarMesh bar = colour_bar_mesh(bounds_, scale_, {label.title, label.unit, options_.of.text()});
        GlbJson primitive = {{"material", 1}};
        primitive["attributes"]["POSITION"] = file_.add_bounded(bar.positions, {"VEC3", code_f32}, 3);
        primitive["attributes"]["COLOR_0"] = file_.add(std::span<const std::uint16_t>(bar.colours),
                                                       bar.colours.size() / 4, {"VEC4", code_u16, for_vertices, true});
        primitive["indices"] = file_.add(std::span<const std::uint32_t>(bar.indices), bar.indices.size(),
                                         {"SCALAR", code_u32, for_indices});
        file_.push("materials", {{"name", "colour bar"},
                                 {"doubleSided", true},
                                 {"pbrMetallicRoughness", {{"metallicFactor", 0.0}, {"roughnessFactor", 1.0}}},
                                 {"extensions", {{"KHR_materials_unlit", GlbJson::object()}}}});
        file_.root["extensionsUsed"] = {"KHR_materials_unlit"};
        file_.push("nodes", {{"name", "colour bar"},
                             {"mesh", file_.push("meshes", {{"name", "colour bar"}, {"primitives", {primitive}}})}});
    }

    const Surfaces& surfaces_;
    const HeatMapOptions& options_;
    FrameSource& source_;
    const std::vector<double> errors_; ///< [V]
    const Scale scale_;
    Bounds3 bounds_; ///< of all frames, y up
    GlbFile file_;
};

} // namespace

Result<Bytes> heat_glb(const Surfaces& surfaces, const HeatMapOptions& options)
{
    return HeatGlb(surfaces, options).write();
}

} // namespace meshreel::cli
