/// Checked steps through JSON.
// SPDX-License-Identifier: MIT
#include "meshreel/io/gltf_json.h"

#include <nlohmann/json.hpp>

#include "meshreel/base/text.h"

namespace meshreel::io {

namespace {

/// Nesting and number of values, counted before the parser allocates anything.
Status check_shape(std::string_view text, const DecodeLimits& limits)
{
    constexpr std::size_t deepest = 256, bytes_a_value = 128;
    std::size_t depth = 0, values = 1;
    bool quoted = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (quoted) {
            if (c == '\\') ++i;
            quoted = c != '"';
            continue;
        }
        quoted = c == '"';
        values += c == ',' || c == '[' || c == '{';
        depth += c == '[' || c == '{';
        depth -= (c == ']' || c == '}') && depth > 0;
        if (depth > deepest) return bad_input("is nested more than 256 levels deep", "JSON", at_byte(i));
    }
    return within(values * bytes_a_value + text.size(), limits.max_memory, "JSON");
}

} // namespace

Json Json::member(const char* name) const
{
    std::string place = path.empty() ? name : path + "." + name;
    if (value == nullptr || !value->is_object()) return {nullptr, std::move(place)};
    const auto found = value->find(name);
    return {found == value->end() ? nullptr : &*found, std::move(place)};
}

Json Json::element(std::size_t i) const
{
    return {i < size() ? &(*value)[i] : nullptr, concat(path, "[", i, "]")};
}

std::size_t Json::size() const
{
    return value != nullptr && value->is_array() ? value->size() : 0;
}

Result<std::uint64_t> Json::integer(std::uint64_t limit) const
{
    if (value == nullptr) return wrong("is missing");
    std::uint64_t number = 0;
    if (value->is_number_unsigned()) {
        number = value->get<std::uint64_t>();
    } else if (value->is_number_float()) {
        const double real = value->get<double>();
        if (!(real >= 0 && real < 9007199254740992.0)) return wrong("is not a whole number in range");
        number = static_cast<std::uint64_t>(real);
        if (static_cast<double>(number) != real) return wrong("is not a whole number");
    } else {
        return wrong("is not a whole number of at least 0");
    }
    if (number >= limit) return wrong(concat(number, " is beyond the ", limit, " allowed"));
    return number;
}

Result<std::uint64_t> Json::integer_or(std::uint64_t fallback, std::uint64_t limit) const
{
    if (value == nullptr) return fallback;
    return integer(limit);
}

Result<bool> Json::truth_or(bool fallback) const
{
    if (value == nullptr) return fallback;
    if (!value->is_boolean()) return wrong("is neither true nor false");
    return value->get<bool>();
}

Result<std::string> Json::text_or(const std::string& fallback) const
{
    if (value == nullptr) return fallback;
    if (!value->is_string()) return wrong("is not a string");
    return value->get<std::string>();
}

Status Json::numbers(std::span<double> into) const
{
    if (value == nullptr) return Ok{};
    if (!value->is_array() || value->size() != into.size())
        return wrong(concat("is not an array of ", into.size(), " numbers"));
    for (std::size_t i = 0; i < into.size(); ++i) {
        if (!(*value)[i].is_number()) return element(i).wrong("is not a number");
        into[i] = (*value)[i].get<double>();
    }
    return Ok{};
}

Error Json::wrong(std::string sentence) const
{
    return bad_input(std::move(sentence), path);
}

Result<nlohmann::json> parse_json(std::string_view text, const DecodeLimits& limits)
{
    MESHREEL_CHECK(check_shape(text, limits));
    try {
        nlohmann::json root = nlohmann::json::parse(text.begin(), text.end());
        if (!root.is_object()) return bad_input("is not an object", "JSON");
        return root;
    } catch (const nlohmann::json::parse_error& error) {
        return bad_input("does not follow the grammar", "JSON", at_byte(error.byte > 0 ? error.byte - 1 : 0));
    } catch (const nlohmann::json::exception&) {
        return bad_input("holds a number that is too large", "JSON");
    }
}

} // namespace meshreel::io
