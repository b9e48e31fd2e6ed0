/// What a .reel file means, as JSON: counts and texts as they are, tables of numbers by hash.
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdio>
#include <string>

#include <nlohmann/json.hpp>

#include "meshreel/container/field.h"
#include "meshreel/container/stream.h"
#include "meshreel/meshreel.h"

namespace meshreel::golden {

using Json = nlohmann::ordered_json;

/// XXH3-64 of the bytes, as hexadecimal digits.
inline std::string hash_text(ByteView bytes)
{
    std::array<char, 20> text{};
    std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(container::hash_of(bytes)));
    return text.data();
}

/// The same of numbers, each in its bytes, the lowest first.
inline std::string hash_of_reals(const auto& numbers)
{
    Bytes bytes(numbers.size() * sizeof numbers[0]);
    for (std::size_t i = 0; i < numbers.size(); ++i)
        container::store_real(numbers[i], bytes.data() + sizeof numbers[0] * i);
    return hash_text(bytes);
}

inline std::string hash_of_indices(const std::vector<std::uint32_t>& numbers)
{
    Bytes bytes;
    for (const std::uint32_t number : numbers)
        for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<std::uint8_t>(number >> shift));
    return hash_text(bytes);
}

inline std::string hash_of_triangles(const std::vector<Triangle>& triangles)
{
    std::vector<std::uint32_t> corners;
    for (const Triangle& t : triangles) corners.insert(corners.end(), t.begin(), t.end());
    return hash_of_indices(corners);
}

inline Json meaning_of(const Attribute& a)
{
    const std::array domains = {"vertex", "corner", "triangle"};
    const std::array types = {"f32", "u8", "u16", "u32", "i8", "i16"};
    return {{"name", a.name},
            {"domain", domains.at(static_cast<std::size_t>(a.domain))},
            {"type", types.at(static_cast<std::size_t>(a.type))},
            {"components", a.components},
            {"normalized", a.normalized},
            {"value_count", a.value_count()},
            {"values", hash_text(a.values)},
            {"indices", a.indices.empty() ? Json() : Json(hash_of_indices(a.indices))}};
}

inline Json meaning_of(const Metadata& meta)
{
    return {{"name", meta.name},
            {"loop", meta.loop},
            {"up", static_cast<int>(meta.up)},
            {"metres_per_unit", meta.metres_per_unit},
            {"fps", meta.fps}};
}

/// A level of detail: its vertices, its triangles between them, where they are.
inline Json meaning_of_level(const Animation& level)
{
    return {{"vertices", level.vertex_count},
            {"triangle_count", level.triangles.size()},
            {"triangles", hash_of_triangles(level.triangles)},
            {"positions", hash_of_reals(level.positions)}};
}

/// Everything that decoding gives, the levels of detail too. base: of files that need one.
inline Result<Json> meaning_of(ByteView reel, const Animation* base)
{
    MESHREEL_TRY(const Info said, info(reel));
    DecodeOptions options;
    options.base = base;
    MESHREEL_TRY(const Animation all, decode(reel, options));
    const std::array orders = {"keep", "free", "base"};
    Json json = {{"codec", said.codec},
                 {"order", orders.at(static_cast<std::size_t>(said.order))},
                 {"vertices", all.vertex_count},
                 {"coded_vertices", said.coded_vertices},
                 {"triangle_count", all.triangles.size()},
                 {"frames", all.frame_count()},
                 {"triangles", hash_of_triangles(all.triangles)},
                 {"positions", hash_of_reals(all.positions)},
                 {"times", hash_of_reals(all.times_s)},
                 {"meta", meaning_of(all.meta)},
                 {"materials", all.appearance.materials},
                 {"groups", all.appearance.groups}};
    for (const char* list : {"attributes", "assets", "levels"}) json[list] = Json::array();
    for (const Attribute& attribute : all.appearance.attributes) json["attributes"].push_back(meaning_of(attribute));
    for (const Asset& a : all.appearance.assets)
        json["assets"].push_back(
            {{"name", a.name}, {"mime_type", a.mime_type}, {"size", a.bytes.size()}, {"bytes", hash_text(a.bytes)}});
    for (options.level = 1; options.level < said.level_bytes.size(); ++options.level) {
        MESHREEL_TRY(const Animation level, decode(reel, options));
        json["levels"].push_back(meaning_of_level(level));
    }
    return json;
}

} // namespace meshreel::golden
