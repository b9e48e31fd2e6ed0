/// Draco as a peer: a mesh and so many frames of integer positions as attributes of one .drc file, and back in the order they came in.
// SPDX-License-Identifier: MIT
#include <draco/compression/decode.h>
#include <draco/compression/expert_encode.h>
#include <draco/mesh/mesh.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

/// What crosses the border to Python: three counts, T x 3 vertex numbers, F x V x 3 levels; 32 bits each.
struct Frames {
    std::array<std::uint32_t, 3> counts{}; ///< V, F, T
    std::vector<std::uint32_t> triangles;
    std::vector<std::int32_t> levels;
};

/// What the processor has worked for this process.
double seconds_now()
{
    return static_cast<double>(std::clock()) / static_cast<double>(CLOCKS_PER_SEC);
}

std::vector<char> bytes_of(const std::string& path)
{
    std::ifstream file(path, std::ios::binary);
    if (!file) throw std::runtime_error(path + ": cannot be opened");
    return {std::istreambuf_iterator<char>(file), {}};
}

void write_bytes(std::ofstream& file, const void* data, std::size_t size)
{
    file.write(static_cast<const char*>(data), static_cast<std::streamsize>(size));
    if (!file) throw std::runtime_error("the output cannot be written");
}

Frames read_frames(const std::string& path)
{
    Frames frames;
    std::ifstream file(path, std::ios::binary);
    file.read(reinterpret_cast<char*>(frames.counts.data()), sizeof frames.counts);
    frames.triangles.resize(std::size_t{frames.counts[2]} * 3);
    frames.levels.resize(std::size_t{frames.counts[0]} * frames.counts[1] * 3);
    file.read(reinterpret_cast<char*>(frames.triangles.data()),
              static_cast<std::streamsize>(frames.triangles.size() * 4));
    file.read(reinterpret_cast<char*>(frames.levels.data()), static_cast<std::streamsize>(frames.levels.size() * 4));
    if (!file) throw std::runtime_error(path + ": shorter than its counts say");
    return frames;
}

void write_frames(const std::string& path, const Frames& frames)
{
    std::ofstream file(path, std::ios::binary);
    write_bytes(file, frames.counts.data(), sizeof frames.counts);
    write_bytes(file, frames.triangles.data(), frames.triangles.size() * 4);
    write_bytes(file, frames.levels.data(), frames.levels.size() * 4);
}

int add_attribute(draco::Mesh& mesh, draco::GeometryAttribute::Type type, const std::int32_t* values, int components)
{
    draco::PointAttribute attribute;
    attribute.Init(type, static_cast<std::int8_t>(components), draco::DT_INT32, false, mesh.num_points());
    attribute.buffer()->Write(0, values, std::size_t{4} * static_cast<std::size_t>(components) * mesh.num_points());
    return mesh.AddAttribute(std::make_unique<draco::PointAttribute>(std::move(attribute)));
}

/// The first frame is the mesh's position, the others are generic; the last attribute is each vertex's number, because
/// Edgebreaker writes vertices in an order of its own.
std::unique_ptr<draco::Mesh> mesh_of(const Frames& frames)
{
    const auto [V, F, T] = frames.counts;
    auto mesh = std::make_unique<draco::Mesh>();
    mesh->set_num_points(V);
    mesh->SetNumFaces(T);
    for (std::uint32_t t = 0; t < T; ++t) {
        const std::uint32_t* corner = &frames.triangles[std::size_t{t} * 3];
        mesh->SetFace(draco::FaceIndex(t),
                      {draco::PointIndex(corner[0]), draco::PointIndex(corner[1]), draco::PointIndex(corner[2])});
    }
    for (std::uint32_t f = 0; f < F; ++f) {
        const auto type = f == 0 ? draco::GeometryAttribute::POSITION : draco::GeometryAttribute::GENERIC;
        add_attribute(*mesh, type, &frames.levels[std::size_t{f} * V * 3], 3);
    }
    std::vector<std::int32_t> numbers(V);
    for (std::uint32_t v = 0; v < V; ++v) numbers[v] = static_cast<std::int32_t>(v);
    add_attribute(*mesh, draco::GeometryAttribute::GENERIC, numbers.data(), 1);
    return mesh;
}

double encode(const std::string& input, const std::string& output)
{
    const Frames frames = read_frames(input);
    const double start = seconds_now();
    const std::unique_ptr<draco::Mesh> mesh = mesh_of(frames);
    draco::ExpertEncoder encoder(*mesh);
    encoder.SetSpeedOptions(0, 0);
    encoder.SetEncodingMethod(draco::MESH_EDGEBREAKER_ENCODING);
    encoder.options().SetGlobalBool("split_mesh_on_seams", true); // one attribute encoder: more than 255 frames
    const auto scheme = encoder.SetAttributePredictionScheme(mesh->num_attributes() - 1, draco::PREDICTION_DIFFERENCE);
    if (!scheme.ok()) throw std::runtime_error(scheme.error_msg_string());
    draco::EncoderBuffer buffer;
    const draco::Status status = encoder.EncodeToBuffer(&buffer);
    if (!status.ok()) throw std::runtime_error(status.error_msg_string());
    const double seconds = seconds_now() - start;
    std::ofstream file(output, std::ios::binary);
    write_bytes(file, buffer.data(), buffer.size());
    return seconds;
}

/// Vertex numbers by point; an error where a vertex is missing (one in no triangle, which Edgebreaker drops).
std::vector<std::uint32_t> numbers_of(const draco::Mesh& mesh)
{
    std::vector<std::uint32_t> numbers(mesh.num_points());
    const draco::PointAttribute& last = *mesh.attribute(mesh.num_attributes() - 1);
    std::uint32_t count = 0;
    for (std::uint32_t p = 0; p < numbers.size(); ++p) {
        last.GetMappedValue(draco::PointIndex(p), &numbers[p]);
        count = std::max(count, numbers[p] + 1);
    }
    std::vector<bool> seen(count);
    for (const std::uint32_t number : numbers) seen[number] = true;
    if (count == 0 || std::find(seen.begin(), seen.end(), false) != seen.end())
        throw std::runtime_error("Draco did not give back every vertex");
    return numbers;
}

Frames frames_of(const draco::Mesh& mesh)
{
    const std::vector<std::uint32_t> numbers = numbers_of(mesh);
    const std::uint32_t V = *std::max_element(numbers.begin(), numbers.end()) + 1;
    Frames frames;
    frames.counts = {V, static_cast<std::uint32_t>(mesh.num_attributes()) - 1, mesh.num_faces()};
    frames.levels.resize(std::size_t{V} * frames.counts[1] * 3);
    for (std::uint32_t f = 0; f < frames.counts[1]; ++f) {
        const draco::PointAttribute& attribute = *mesh.attribute(static_cast<int>(f));
        std::int32_t* frame = &frames.levels[std::size_t{f} * V * 3];
        for (std::uint32_t p = 0; p < numbers.size(); ++p)
            attribute.GetMappedValue(draco::PointIndex(p), frame + std::size_t{numbers[p]} * 3);
    }
    for (std::uint32_t t = 0; t < mesh.num_faces(); ++t)
        for (const draco::PointIndex& corner : mesh.face(draco::FaceIndex(t)))
            frames.triangles.push_back(numbers[corner.value()]);
    return frames;
}

double decode(const std::string& input, const std::string& output)
{
    const std::vector<char> bytes = bytes_of(input);
    const double start = seconds_now();
    draco::DecoderBuffer buffer;
    buffer.Init(bytes.data(), bytes.size());
    draco::Decoder decoder;
    auto mesh = decoder.DecodeMeshFromBuffer(&buffer);
    if (!mesh.ok()) throw std::runtime_error(mesh.status().error_msg_string());
    const Frames frames = frames_of(*mesh.value());
    const double seconds = seconds_now() - start;
    write_frames(output, frames);
    return seconds;
}

} // namespace

int main(int argc, char** argv)
{
    const std::string verb = argc == 4 ? argv[1] : "";
    if (verb != "encode" && verb != "decode") {
        std::fputs("usage: meshreel-peer-draco encode|decode INPUT OUTPUT; prints the codec's seconds\n", stderr);
        return 1;
    }
    try {
        std::printf("%.9f\n", verb == "encode" ? encode(argv[2], argv[3]) : decode(argv[2], argv[3]));
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 4;
    }
    return 0;
}
