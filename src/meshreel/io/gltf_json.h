/// Looks into a glTF document's JSON, knowing at every step where it is and trusting nothing.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "meshreel/base/limits.h"
#include "meshreel/base/result.h"
#include "meshreel/base/views.h"

namespace meshreel::io {

/// A JSON value, or its absence, and its place: "meshes[2].primitives[0].mode". Lives as long as the document.
struct Json {
    const nlohmann::json* value = nullptr; ///< null: absent
    std::string path;

    explicit operator bool() const { return value != nullptr; }

    /// A member of an object; absent where this is absent or not an object.
    Json member(const char* name) const;
    /// An element of an array; absent beyond its end.
    Json element(std::size_t i) const;
    /// Elements of an array; 0 where absent or no array.
    std::size_t size() const;

    /// A whole number below `limit`. @fails bad_input: absent, no whole number, or too large.
    Result<std::uint64_t> integer(std::uint64_t limit) const;
    Result<std::uint64_t> integer_or(std::uint64_t fallback, std::uint64_t limit) const;
    /// @fails bad_input: present, but not a truth value.
    Result<bool> truth_or(bool fallback) const;
    /// @fails bad_input: present, but not a string.
    Result<std::string> text_or(const std::string& fallback) const;
    /// Fills `into` from an array of exactly that many numbers; leaves it alone where absent.
    Status numbers(std::span<double> into) const;

    /// bad_input with this place as the field.
    Error wrong(std::string sentence) const;
};

/// Parses text, refusing nesting beyond 256 levels and documents that would not fit the limits. @fails bad_input.
Result<nlohmann::json> parse_json(std::string_view text, const DecodeLimits& limits);

} // namespace meshreel::io
