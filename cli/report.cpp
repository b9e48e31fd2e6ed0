/// Errors as JSON, and figures as people write them.
// SPDX-License-Identifier: MIT
#include "cli/report.h"

#include <array>
#include <cmath>

#include <fmt/format.h>

namespace meshreel::cli {

std::string code_name(ErrorCode code)
{
    switch (code) {
    case ErrorCode::usage:
        return "usage";
    case ErrorCode::io:
        return "io";
    case ErrorCode::bad_input:
        return "bad_input";
    case ErrorCode::runtime:
        return "runtime";
    case ErrorCode::unsupported:
        return "unsupported";
    case ErrorCode::missed:
        return "missed";
    }
    return "runtime";
}

Json error_json(const Error& error)
{
    Json json{{"code", code_name(error.code)}, {"exit", static_cast<int>(error.code)}};
    if (!error.file.empty()) json["file"] = error.file;
    if (error.place) json[error.place->unit == Place::Unit::byte ? "byte" : "line"] = error.place->number;
    if (!error.field.empty()) json["field"] = error.field;
    json["message"] = error.message;
    return json;
}

Json number(double value)
{
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

std::string human_bytes(double bytes)
{
    constexpr std::array units{"bytes", "kB", "MB", "GB", "TB"};
    std::size_t unit = 0;
    while (bytes >= 999.5 && unit + 1 < units.size()) {
        bytes /= 1000.0;
        ++unit;
    }
    return unit == 0 ? fmt::format("{:.0f} bytes", bytes) : fmt::format("{:.3g} {}", bytes, units[unit]);
}

std::string human_count(unsigned long long count)
{
    const std::string digits = fmt::format("{}", count);
    std::string text;
    for (std::size_t i = 0; i < digits.size(); ++i) {
        if (i > 0 && (digits.size() - i) % 3 == 0) text.push_back(' ');
        text.push_back(digits[i]);
    }
    return text;
}

std::string counted(unsigned long long count, const char* one, const char* many)
{
    return fmt::format("{} {}", human_count(count), count == 1 ? one : many);
}

} // namespace meshreel::cli
