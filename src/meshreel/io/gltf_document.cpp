/// Takes a GLB or glTF file apart: chunks, JSON, buffers, URIs.
// SPDX-License-Identifier: MIT
#include "meshreel/io/gltf_document.h"

#include <array>
#include <cstring>
#include <nlohmann/json.hpp>

#include "meshreel/base/file.h"
#include "meshreel/base/text.h"

namespace meshreel::io {

namespace {

std::uint32_t u32_at(ByteView bytes, std::size_t offset)
{
    return bytes[offset] | static_cast<std::uint32_t>(bytes[offset + 1]) << 8 |
           static_cast<std::uint32_t>(bytes[offset + 2]) << 16 | static_cast<std::uint32_t>(bytes[offset + 3]) << 24;
}

constexpr std::uint32_t glb_magic = 0x46546c67, json_chunk = 0x4e4f534a, binary_chunk = 0x004e4942;

struct GlbChunks {
    std::string_view json;
    ByteView binary;
    bool has_binary = false;
};

Result<GlbChunks> read_chunks(ByteView file)
{
    if (file.size() < 20) return bad_input("a GLB has at least 20 bytes", "header", at_byte(file.size()));
    if (u32_at(file, 4) != 2)
        return unsupported(concat("GLB version ", u32_at(file, 4), "; only 2 is known"), "version");
    if (u32_at(file, 8) != file.size())
        return bad_input(concat("is ", u32_at(file, 8), ", but the file has ", file.size(), " bytes"), "length",
                         at_byte(8));
    GlbChunks chunks;
    std::size_t at = 12;
    for (std::size_t number = 0; at < file.size(); ++number) {
        if (file.size() - at < 8) return bad_input("a chunk's header is cut short", "chunk", at_byte(at));
        const std::size_t length = u32_at(file, at);
        const std::uint32_t type = u32_at(file, at + 4);
        if (length > file.size() - at - 8)
            return bad_input("reaches beyond the file's end", "chunkLength", at_byte(at));
        const ByteView body = file.subspan(at + 8, length);
        if ((type == json_chunk) != (number == 0))
            return bad_input("the first chunk, and only it, is JSON", "chunkType", at_byte(at + 4));
        if (type == json_chunk) chunks.json = {reinterpret_cast<const char*>(body.data()), body.size()};
        if (type == binary_chunk && number == 1) {
            chunks.binary = body;
            chunks.has_binary = true;
        }
        at += 8 + length;
    }
    return chunks;
}

int base64_value(char c)
{
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    if (c == '+' || c == '-') return 62;
    return c == '/' || c == '_' ? 63 : -1;
}

Result<Bytes> decode_base64(std::string_view text, const Json& field)
{
    while (!text.empty() && text.back() == '=') text.remove_suffix(1);
    Bytes bytes;
    bytes.reserve(text.size() / 4 * 3 + 3);
    std::uint32_t bits = 0;
    unsigned filled = 0;
    for (char c : text) {
        const int value = base64_value(c);
        if (value < 0) return field.wrong("is not base64");
        bits = bits << 6 | static_cast<std::uint32_t>(value);
        filled += 6;
        if (filled < 8) continue;
        filled -= 8;
        bytes.push_back(static_cast<std::uint8_t>(bits >> filled));
    }
    return bytes;
}

int hex_value(char c)
{
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

std::string percent_decoded(std::string_view uri)
{
    std::string plain;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        const bool escape =
            uri[i] == '%' && i + 2 < uri.size() && hex_value(uri[i + 1]) >= 0 && hex_value(uri[i + 2]) >= 0;
        plain += escape ? static_cast<char>(hex_value(uri[i + 1]) * 16 + hex_value(uri[i + 2])) : uri[i];
        if (escape) i += 2;
    }
    return plain;
}

/// Relative, and never above where it starts.
bool stays_below(std::string_view path)
{
    if (path.empty() || path.front() == '/' || path.find('\\') != path.npos || path.find('\0') != path.npos)
        return false;
    for (std::size_t at = 0; at <= path.size();) {
        const std::size_t end = std::min(path.find('/', at), path.size());
        if (path.substr(at, end - at) == "..") return false;
        at = end + 1;
    }
    return true;
}

/// Extensions that change geometry in ways we do not read make a file unreadable; those of materials just travel along.
bool known_extension(std::string_view name)
{
    constexpr std::array<std::string_view, 8> travelling = {"KHR_materials_", "KHR_texture_",   "EXT_texture_",
                                                            "MSFT_texture_",  "EXT_materials_", "ADOBE_materials_",
                                                            "KHR_lights_",    "KHR_xmp"};
    if (name == "KHR_mesh_quantization") return true;
    for (std::string_view start : travelling)
        if (name.substr(0, start.size()) == start) return true;
    return false;
}

Status check_header(const GltfDocument& document)
{
    MESHREEL_TRY(const std::string version, document.json().member("asset").member("version").text_or(""));
    if (version.empty())
        return document.json().member("asset").member("version").wrong("is missing: this is no glTF 2 file");
    if (version != "2" && version.compare(0, 2, "2.") != 0)
        return unsupported(concat("glTF version ", version, "; only 2 is known"), "asset.version");
    const Json required = document.json().member("extensionsRequired");
    for (std::size_t i = 0; i < required.size(); ++i) {
        MESHREEL_TRY(const std::string name, required.element(i).text_or(""));
        if (!known_extension(name))
            return unsupported(concat("the extension ", name, " is required, but not known"), required.element(i).path);
    }
    for (const char* list :
         {"accessors", "animations", "bufferViews", "buffers", "images", "materials", "meshes", "nodes", "samplers",
          "scenes", "skins", "textures", "extensionsUsed", "extensionsRequired"}) {
        const Json member = document.json().member(list);
        if (member && !member.value->is_array()) return member.wrong("is not an array");
    }
    return Ok{};
}

Status load_buffers(GltfDocument& document, const GlbChunks& chunks)
{
    const Json buffers = document.json().member("buffers");
    document.loaded.resize(buffers.size());
    document.buffers.resize(buffers.size());
    for (std::size_t i = 0; i < buffers.size(); ++i) {
        const Json buffer = buffers.element(i);
        MESHREEL_TRY(const std::uint64_t length, buffer.member("byteLength").integer(document.limits.max_memory));
        MESHREEL_TRY(const std::string uri, buffer.member("uri").text_or(""));
        if (buffer.member("uri")) {
            MESHREEL_TRY(document.loaded[i], read_uri(uri, document.path, document.limits, buffer.member("uri")));
            MESHREEL_CHECK(document.budget->take(document.loaded[i].size(), buffer));
        } else if (i != 0 || !chunks.has_binary) {
            return buffer.wrong("has neither a URI nor the file's binary chunk");
        }
        const ByteView bytes = buffer.member("uri") ? ByteView(document.loaded[i]) : chunks.binary;
        if (length > bytes.size())
            return buffer.member("byteLength").wrong(concat(length, " bytes, but there are ", bytes.size()));
        document.buffers[i] = bytes.first(length);
    }
    return Ok{};
}

} // namespace

GltfDocument::GltfDocument() = default;
GltfDocument::GltfDocument(GltfDocument&&) noexcept = default;
GltfDocument::~GltfDocument() = default;

Result<Bytes> read_uri(const std::string& uri, const std::string& beside, const DecodeLimits& limits, const Json& field)
{
    if (uri.compare(0, 5, "data:") == 0) {
        const std::size_t comma = uri.find(',');
        if (comma == uri.npos) return field.wrong("is a data URI without data");
        const std::string_view header = std::string_view(uri).substr(0, comma),
                               body = std::string_view(uri).substr(comma + 1);
        if (header.find(";base64") != header.npos) return decode_base64(body, field);
        const std::string plain = percent_decoded(body);
        return Bytes(plain.begin(), plain.end());
    }
    if (uri.find("://") != uri.npos)
        return unsupported("is remote; only data URIs and files beside this one are read", field.path);
    const std::string relative = percent_decoded(uri);
    if (!stays_below(relative)) return field.wrong("leads out of the file's folder");
    const std::size_t slash = beside.rfind('/');
    return read_file(slash == beside.npos ? relative : beside.substr(0, slash + 1) + relative, limits);
}

Result<GltfDocument> read_gltf_document(const std::string& path, const DecodeLimits& limits)
{
    GltfDocument document;
    document.path = path;
    document.limits = limits;
    MESHREEL_TRY(document.file, read_file(path, limits));
    document.budget = std::make_unique<Budget>(
        Budget{limits.max_memory - std::min<std::uint64_t>(limits.max_memory, document.file.size())});
    GlbChunks chunks;
    if (document.file.size() >= 4 && u32_at(document.file, 0) == glb_magic) {
        MESHREEL_TRY(chunks, read_chunks(document.file));
    } else {
        chunks.json = {reinterpret_cast<const char*>(document.file.data()), document.file.size()};
    }
    MESHREEL_TRY(nlohmann::json root, parse_json(chunks.json, limits));
    document.root = std::make_unique<const nlohmann::json>(std::move(root));
    MESHREEL_CHECK(check_header(document));
    MESHREEL_CHECK(load_buffers(document, chunks));
    return document;
}

Result<ByteView> buffer_view(const GltfDocument& document, std::uint64_t i)
{
    const Json view = document.item("bufferViews", i);
    MESHREEL_TRY(const std::uint64_t buffer, view.member("buffer").integer(document.buffers.size()));
    const ByteView bytes = document.buffers[buffer];
    MESHREEL_TRY(const std::uint64_t offset, view.member("byteOffset").integer_or(0, bytes.size() + 1));
    MESHREEL_TRY(const std::uint64_t length, view.member("byteLength").integer(bytes.size() - offset + 1));
    return bytes.subspan(offset, length);
}

} // namespace meshreel::io
