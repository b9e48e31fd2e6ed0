/// The rows of the golden files.
// SPDX-License-Identifier: MIT
#include "tests/determinism/goldens.h"

#include <bit>
#include <limits>

#include "meshreel/codecs/codec.h"
#include "meshreel/codecs/opening.h"
#include "meshreel/container/chunks.h"
#include "meshreel/container/stream.h"

namespace meshreel::golden {

namespace {

/// The first files: every basis and entropy coder on one cloth.
void add_bases(std::vector<Golden>& rows)
{
    const auto add = [&](const char* codec, BasisCoding basis, const std::string& name) {
        for (const Entropy entropy : {Entropy::huffman, Entropy::range}) {
            EncodeOptions options = with_step(codec);
            options.basis = basis;
            options.entropy = entropy;
            rows.push_back({std::string(codec) + "_v1_" + name + (entropy == Entropy::range ? "_range" : "_huffman"),
                            cloth, options});
        }
    };
    const std::array names = {"raw", "uniform", "cobra", "lpc1", "lpc2", "lpc3", "lpc4"};
    for (std::size_t i = 0; i < names.size(); ++i) add("coddyac", static_cast<BasisCoding>(i), names.at(i));
    for (const char* codec : {"na", "lsp", "rbfp"}) add(codec, BasisCoding::cobra, "cobra");
    rows.push_back({"reel_v1_range", cloth, with_step("reel")});
    rows.push_back({"lossless_v1_floats", cloth, with_step("lossless")});
    rows.push_back({"lossless_v1_text", text_cloth, with_step("lossless")});
}

/// Every awkward connectivity, its order kept and not.
void add_shapes(std::vector<Golden>& rows)
{
    for (std::size_t i = 0; i < test_shapes::all().size(); ++i) {
        const std::string name = test_shapes::all()[i].name;
        const auto make = [i] { return test_shapes::all()[i].animation; };
        rows.push_back({"reel_v1_keep_" + name, make, with_step("reel")});
        rows.push_back({"lossless_v1_free_" + name, make, with_step("lossless", Order::free)});
    }
}

/// Numbers of full precision that follow the mesh, once a vertex and again at every corner with a few exceptions.
Animation smooth()
{
    Animation a = shape("walker", 400, 2);
    std::vector<float> by_vertex, by_corner;
    for (std::uint32_t v = 0; v < a.vertex_count; ++v)
        for (std::size_t c = 0; c < 3; ++c) by_vertex.push_back(1 / (1.7f + a.positions[3 * v + c]));
    for (const Triangle& t : a.triangles)
        for (const std::uint32_t v : t)
            by_corner.push_back(std::sqrt(2.3f + a.positions[3 * v]) - (t[0] % 40 == 0 ? 1 : 0));
    a.appearance = {};
    a.appearance.attributes.push_back(table("normal", Domain::vertex, Scalar::f32, by_vertex));
    a.appearance.attributes.back().components = 3;
    a.appearance.attributes.push_back(table("shade", Domain::corner, Scalar::f32, by_corner));
    return a;
}

/// The frames of a file coded again, in one segment, with settings that only a search chooses.
Bytes chosen(const Animation& animation, const Bytes& file, const codecs::Settings& settings)
{
    const container::StreamReader reader = *container::StreamReader::open(file);
    const auto topology = *codecs::read_topology(reader, *container::read_header(reader), nullptr);
    Matrix<float> frames(animation.frame_count(), 3ul * topology.surface.vertex_count);
    for (std::size_t f = 0; f < frames.rows; ++f)
        for (std::size_t i = 0; i < 3ul * animation.vertex_count; ++i)
            frames(f, 3ul * topology.surface_of[i / 3] + i % 3) = animation.frame(f)[i];
    const codecs::Sequence sequence{topology.surface, frames.view()};
    const auto trial = codecs::find("reel")->prepare(sequence, 512, {1})->encode(settings);
    container::MemoryWriter writer;
    for (const container::Chunk& chunk : reader.chunks()) {
        if (chunk.type != container::type::segm)
            writer.add(chunk.type, chunk.payload);
        else if (!writer.add(chunk.type, container::Segment{0, static_cast<std::uint32_t>(frames.rows), trial.payload})
                      .ok())
            return {};
    }
    return std::move(writer).finish();
}

Bytes relaxed(const Animation& animation, const Bytes& file)
{
    return chosen(animation, file, {.step = 0.02, .relax = true, .threads = {1}});
}

Bytes length_keeping(const Animation& animation, const Bytes& file)
{
    return chosen(animation, file, {.step = 0.02, .lengths = true, .relax = true, .threads = {1}});
}

/// Options of the codecs that the rows above leave at their defaults.
void add_options(std::vector<Golden>& rows)
{
    const auto walker = [] { return shape("walker", 300, 12); };
    for (const char* codec : {"coddyac", "na", "lsp", "rbfp"})
        rows.push_back({std::string(codec) + "_v1_free_walker", walker, with_step(codec, Order::free)});
    EncodeOptions fast = with_step("reel"), cut = with_step("reel", Order::free), few = with_step("reel");
    fast.fast_decode = true;
    cut.segment = 5;
    few.quality.max_error_relative.reset();
    few.quality.bases = 2;
    rows.push_back({"reel_v1_fast_walker", walker, fast});
    rows.push_back({"reel_v1_segments_walker", walker, cut});
    rows.push_back({"reel_v1_two_components", walker, few});
    rows.push_back({"reel_v1_levels_cloth", [] { return shape("cloth", 450, 6); }, with_step("reel")});
    rows.push_back({"reel_v1_base_cloth", cloth, with_step("reel", Order::base), "reel_v1_range"});
    EncodeOptions poses = few;
    poses.quality.bases = 4;
    poses.segment = one_segment;
    rows.push_back({"reel_v1_poses_cloth", [] { return shape("cloth", 30, 1100); }, poses});
    EncodeOptions exact = with_step("lossless");
    exact.segment = 6;
    rows.push_back({"lossless_v1_guess_wave", [] { return shape("wave", 100, 20); }, exact});
    rows.push_back({"reel_v1_relaxed_cloth", [] { return shape("cloth", 150, 20); }, with_step("reel"), {}, relaxed});
    rows.push_back(
        {"reel_v1_lengths_cloth", [] { return shape("cloth", 150, 20); }, with_step("reel"), {}, length_keeping});
    rows.push_back({"reel_v1_smooth", smooth, with_step("reel")});
    rows.push_back({"reel_v1_dressed", dressed, with_step("reel")});
    rows.push_back({"lossless_v1_dressed_free", dressed, with_step("lossless", Order::free)});
}

/// Tables of a value a vertex: smooth, decimal, awkward, and of small integers.
void dress_vertices(Animation& a)
{
    std::vector<float> smooth, exact, wild;
    std::vector<std::uint8_t> colour;
    std::vector<std::uint16_t> height;
    std::vector<std::int8_t> sign;
    for (std::uint32_t v = 0; v < a.vertex_count; ++v) {
        const float x = a.positions[3 * v], y = a.positions[3 * v + 1];
        smooth.push_back(0.5f + 0.25f * x);
        exact.push_back(std::round(1000 * y) / 1000);
        wild.push_back(v % 7 == 0   ? std::numeric_limits<float>::quiet_NaN()
                       : v % 5 == 0 ? -0.0f
                                    : 1 / (1 + static_cast<float>(v)));
        colour.push_back(static_cast<std::uint8_t>(v * v * 37));
        height.push_back(static_cast<std::uint16_t>(1000 * (1 + std::abs(y))));
        sign.push_back(static_cast<std::int8_t>(v % 3 == 0 ? -1 : 1));
    }
    auto& all = a.appearance.attributes;
    all.push_back(table("smooth", Domain::vertex, Scalar::f32, smooth));
    all.push_back(table("exact", Domain::vertex, Scalar::f32, exact));
    all.push_back(table("wild", Domain::vertex, Scalar::f32, wild));
    all.push_back(table("color0", Domain::vertex, Scalar::u8, colour));
    all.back().normalized = true;
    all.push_back(table("height", Domain::vertex, Scalar::u16, height));
    all.push_back(table("sign", Domain::vertex, Scalar::i8, sign));
}

/// Tables of a value a triangle, one with elements that have none.
void dress_triangles(Animation& a)
{
    std::vector<std::uint32_t> material, sparse;
    std::vector<std::int16_t> step;
    const std::size_t T = a.triangles.size();
    for (std::size_t t = 0; t < T; ++t) {
        material.push_back(t < T / 2 ? 0 : 1);
        sparse.push_back(t % 3 == 0 ? 0xffffffffu : 0);
        step.push_back(static_cast<std::int16_t>(static_cast<int>(3 * t) - 100));
    }
    auto& all = a.appearance.attributes;
    all.push_back(table("step", Domain::triangle, Scalar::i16, step));
    all.push_back(table("material", Domain::triangle, Scalar::u32, material));
    all.push_back(table("sparse", Domain::triangle, Scalar::u16, std::vector<std::uint16_t>{7}));
    all.back().indices = sparse;
}

/// Tables of a value a corner: a seam through UVs that follow the mesh, values said again at every corner, numbers.
void dress_corners(Animation& a)
{
    std::vector<float> uv, repeated;
    std::vector<std::uint32_t> place, number;
    for (std::uint32_t v = 0; v < a.vertex_count; ++v)
        uv.insert(uv.end(), {a.positions[3 * v], std::round(100 * a.positions[3 * v + 2]) / 100});
    uv.insert(uv.end(), {0.25f, 0.75f});
    for (std::uint32_t t = 0; t < a.triangles.size(); ++t)
        for (std::uint32_t i = 0; i < 3; ++i) {
            const std::uint32_t v = a.triangles[t][i];
            place.push_back(t > a.triangles.size() / 2 && i == 0 ? v + 1 : v);
            repeated.push_back(a.positions[3 * v]);
            number.push_back(i + t / 4);
        }
    auto& all = a.appearance.attributes;
    all.push_back(table("uv0", Domain::corner, Scalar::f32, uv));
    all.back().components = 2;
    all.back().indices = place;
    all.push_back(table("corner_x", Domain::corner, Scalar::f32, repeated));
    all.push_back(table("number", Domain::corner, Scalar::u32, number));
}

} // namespace

Animation dressed()
{
    Animation a = shape("cloth", 100, 3);
    a.times_s = {0.0, 0.1, 0.1 + 0.1 + 0.1};
    a.meta = {"dressed", true, Axis::z, 0.01, 24.0};
    a.appearance.materials = {"silk", "wool"};
    a.appearance.groups = {"sleeve"};
    a.appearance.assets = {{"note.txt", "text/plain", {'h', 'i'}}, {"zeros.bin", "", Bytes(5000, 0)}};
    dress_vertices(a);
    dress_triangles(a);
    dress_corners(a);
    return a;
}

std::vector<Golden> all()
{
    std::vector<Golden> rows;
    add_bases(rows);
    add_shapes(rows);
    add_options(rows);
    return rows;
}

} // namespace meshreel::golden
