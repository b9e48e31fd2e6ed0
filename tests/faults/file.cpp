/// Files taken apart and put together.
// SPDX-License-Identifier: MIT
#include "tests/faults/file.h"

#include <algorithm>
#include <filesystem>
#include <sstream>

#include <gtest/gtest.h>

#include "meshreel/coding/varint.h"
#include "meshreel/container/stream.h"
#include "meshreel/mesh/test_shapes.h"
#include "meshreel/meshreel.h"

namespace meshreel::faults {

namespace {

constexpr const char* golden_folder = MESHREEL_SOURCE_DIR "/tests/golden";

void put_number(Bytes& bytes, std::uint64_t number, int size)
{
    for (int i = 0; i < size; ++i) bytes.push_back(static_cast<std::uint8_t>(number >> (8 * i)));
}

void put_part(Bytes& file, const Part& part)
{
    Bytes chunk(part.type.begin(), part.type.end());
    coding::put_varint(chunk, part.payload.size());
    chunk.insert(chunk.end(), part.payload.begin(), part.payload.end());
    put_number(chunk, container::hash_of(chunk), 4);
    file.insert(file.end(), chunk.begin(), chunk.end());
}

Bytes preamble()
{
    Bytes bytes = {0x8d, 0x52, 0x45, 0x45, 0x4c, 0x0d, 0x0a, 0x0a, 1, 0, 0, 0};
    put_number(bytes, container::hash_of(bytes), 4);
    return bytes;
}

} // namespace

std::vector<Part> parts_of(ByteView file)
{
    std::vector<Part> parts;
    for (std::size_t at = 16; at < file.size();) {
        Part part{std::string(file.begin() + at, file.begin() + at + 4), {}};
        std::uint64_t size = 0;
        at += 4;
        for (int shift = 0;; shift += 7) {
            size |= std::uint64_t{file[at] & 127u} << shift;
            if (file[at++] < 128) break;
        }
        part.payload.assign(file.begin() + at, file.begin() + at + size);
        at += size + 4;
        parts.push_back(std::move(part));
    }
    return parts;
}

Bytes sealed(const std::vector<Part>& parts)
{
    Bytes file = preamble();
    for (const Part& part : parts) put_part(file, part);
    return file;
}

Bytes indexed(std::vector<Part> parts)
{
    std::erase_if(parts, [](const Part& part) { return part.type == "INDX" || part.type == "TAIL"; });
    Bytes file = preamble(), index, tail;
    coding::put_varint(index, parts.size());
    for (const Part& part : parts) {
        index.insert(index.end(), part.type.begin(), part.type.end());
        coding::put_varint(index, file.size());
        coding::put_varint(index, part.payload.size());
        put_part(file, part);
    }
    put_number(tail, file.size(), 8);
    put_part(file, {"INDX", index});
    put_number(tail, file.size() + 25, 8);
    put_part(file, {"TAIL", tail});
    return file;
}

std::vector<Field> fields_of(ByteView file)
{
    std::vector<std::size_t> begins;
    const std::vector<Part> parts = parts_of(file);
    std::size_t at = 16;
    for (const Part& part : parts) {
        Bytes alone;
        put_part(alone, part);
        begins.push_back(at + alone.size() - 4 - part.payload.size());
        at += alone.size();
    }
    std::vector<Field> fields;
    std::istringstream lines(*explain(file));
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::size_t offset = 0;
        Field field;
        if (!(words >> offset >> field.size >> field.name)) continue;
        field.part =
            static_cast<std::size_t>(std::upper_bound(begins.begin(), begins.end(), offset) - begins.begin()) - 1;
        if (field.part >= parts.size() || field.size == 0) continue;
        field.begin = offset - begins[field.part];
        if (field.begin + field.size <= parts[field.part].payload.size()) fields.push_back(field);
    }
    return fields;
}

std::vector<std::string> golden_names()
{
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(golden_folder))
        if (entry.path().extension() == ".reel") names.push_back(entry.path().stem());
    std::ranges::sort(names);
    return names;
}

Bytes golden_file(const std::string& name)
{
    return *read_file(std::string(golden_folder) + "/" + name + ".reel");
}

Bytes small_file(const std::string& codec)
{
    constexpr std::size_t frames = 6;
    Animation a = test_shapes::two_components();
    a.positions.resize(frames * 3 * a.vertex_count);
    a.times_s.resize(frames);
    a.times_s.back() += 0.5;
    a.meta = {"small", true, Axis::y, 0.01, 25.0};
    a.appearance.materials = {"skin"};
    a.appearance.assets = {{"zeros", "", Bytes(500, 0)}};
    Attribute uv{"uv0", Domain::corner, Scalar::f32, 1, false, Bytes(4ul * a.vertex_count), {}};
    for (std::size_t i = 0; i < uv.values.size(); ++i)
        uv.values[i] = static_cast<std::uint8_t>(i % 4 == 3 ? 60 : i * i);
    for (const Triangle& t : a.triangles) uv.indices.insert(uv.indices.end(), t.begin(), t.end());
    a.appearance.attributes = {uv};
    EncodeOptions options;
    options.codec = codec;
    if (codec != "lossless") options.quality.max_error_relative = 0.3;
    options.segment = 3;
    options.threads = {1};
    const auto encoded = encode(a, options);
    EXPECT_TRUE(encoded.ok()) << encoded.error().sentence();
    return encoded->bytes;
}

} // namespace meshreel::faults
