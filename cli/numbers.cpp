/// Reads percents, frame ranges and memory sizes.
// SPDX-License-Identifier: MIT
#include "cli/numbers.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/hint.h"

namespace meshreel::cli {

namespace {

Error unreadable(std::string message)
{
    return {ErrorCode::usage, std::move(message)};
}

/// The whole text as a number; false where it is none.
bool read_double(const std::string& text, double& value)
{
    char* end = nullptr;
    value = std::strtod(text.c_str(), &end);
    return !text.empty() && end == text.c_str() + text.size() && std::isfinite(value);
}

bool read_count(std::string_view text, std::uint64_t& value)
{
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
    return problem == std::errc{} && end == text.data() + text.size();
}

} // namespace

Result<Amount> parse_amount(const std::string& text)
{
    Amount amount;
    amount.percent = !text.empty() && text.back() == '%';
    const std::string digits = amount.percent ? text.substr(0, text.size() - 1) : text;
    if (!read_double(digits, amount.value) || amount.value <= 0.0)
        return unreadable(fmt::format("'{}' is not a number above 0 such as 0.1% or 0.004", text));
    return amount;
}

Result<io::FrameRange> parse_frames(const std::string& text)
{
    const Error problem = unreadable(fmt::format("'{}' is not a range of frames such as 10:20, 10:20:2 or ::2", text));
    io::FrameRange range;
    const std::array<std::uint64_t*, 3> parts{&range.first, &range.last, &range.step};
    std::string_view rest = text;
    std::size_t colons = 0;
    for (std::uint64_t* part : parts) {
        const std::size_t colon = rest.find(':');
        const std::string_view piece = rest.substr(0, colon);
        if (!piece.empty() && !read_count(piece, *part)) return problem;
        if (colon == std::string_view::npos) {
            rest = {};
            break;
        }
        rest.remove_prefix(colon + 1);
        if (++colons == parts.size()) return problem;
    }
    if (text.empty() || range.step == 0) return problem;
    if (colons == 0) range.last = range.first;
    if (range.last < range.first) return unreadable(fmt::format("'{}' ends before it begins", text));
    return range;
}

Result<std::uint64_t> parse_memory(const std::string& text)
{
    std::string digits = text;
    double factor = 1.0;
    constexpr std::string_view suffixes = "KMGT";
    if (!digits.empty() && (digits.back() == 'B' || digits.back() == 'b')) digits.pop_back();
    if (!digits.empty()) {
        const auto place = suffixes.find(static_cast<char>(std::toupper(static_cast<unsigned char>(digits.back()))));
        if (place != std::string_view::npos) {
            factor = std::exp2(10.0 * static_cast<double>(place + 1));
            digits.pop_back();
        }
    }
    double value = 0.0;
    if (!read_double(digits, value) || value <= 0.0 || value * factor >= 0x1p63)
        return unreadable(fmt::format("'{}' is not a size such as 512M or 4G", text));
    return static_cast<std::uint64_t>(value * factor);
}

CLI::Validator positive()
{
    const auto check = [](std::string& text) {
        double value = 0.0;
        if (read_double(text, value) && value > 0.0) return std::string{};
        return fmt::format("'{}' is not a number above 0", text);
    };
    return {check, "", "positive"};
}

CLI::Validator one_of(std::vector<std::string> words)
{
    const auto check = [words = std::move(words)](std::string& text) {
        if (std::find(words.begin(), words.end(), text) != words.end()) return std::string{};
        const std::string near = nearest(text, words);
        const std::string hint = near.empty() ? "" : fmt::format("; did you mean '{}'?", near);
        return fmt::format("'{}' is none of {}{}", text, fmt::join(words, ", "), hint);
    };
    return {check, "", "one of"};
}

} // namespace meshreel::cli
