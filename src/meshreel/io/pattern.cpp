/// Finding the files of a sequence.
// SPDX-License-Identifier: MIT
#include "meshreel/io/pattern.h"

#include <algorithm>
#include <filesystem>

#include "meshreel/base/text.h"

namespace meshreel::io {

namespace {

constexpr std::size_t most_digits = 18; ///< a number that always fits 64 bits

bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

/// A placeholder for a number inside a file name.
struct Placeholder {
    std::size_t begin = 0, length = 0, digits = 0;
};

/// "%d", "%04d" at `begin`, or nothing.
std::optional<Placeholder> printf_placeholder(std::string_view name, std::size_t begin)
{
    std::size_t end = begin + 1, digits = 0;
    while (end < name.size() && is_digit(name[end]) && digits <= most_digits)
        digits = digits * 10 + static_cast<std::size_t>(name[end++] - '0');
    if (end == name.size() || name[end] != 'd' || digits > most_digits) return std::nullopt;
    return Placeholder{begin, end + 1 - begin, std::max<std::size_t>(digits, 1)};
}

std::optional<Placeholder> next_placeholder(std::string_view name, std::size_t from)
{
    for (std::size_t i = from; i < name.size(); ++i) {
        if (name[i] == '%')
            if (const auto found = printf_placeholder(name, i)) return found;
        if (name[i] != '#') continue;
        const std::size_t end = std::min(name.find_first_not_of('#', i), name.size());
        return Placeholder{i, end - i, std::min(end - i, most_digits)};
    }
    return std::nullopt;
}

/// The number of a file name, where the name is one of the pattern's.
std::optional<std::uint64_t> number_of(const Pattern& pattern, std::string_view file)
{
    const std::string_view before = std::string_view(pattern.name).substr(0, pattern.hole);
    const std::string_view after = std::string_view(pattern.name).substr(pattern.hole);
    if (file.size() <= before.size() + after.size() || !file.starts_with(before) || !file.ends_with(after))
        return std::nullopt;
    const std::string_view digits = file.substr(before.size(), file.size() - before.size() - after.size());
    if (digits.size() > most_digits || !std::ranges::all_of(digits, is_digit)) return std::nullopt;
    const bool filled = digits.size() == *pattern.digits || (digits.size() > *pattern.digits && digits[0] != '0');
    if (!filled && *pattern.digits > 1) return std::nullopt;
    std::uint64_t number = 0;
    for (char c : digits) number = number * 10 + static_cast<std::uint64_t>(c - '0');
    return number;
}

Result<std::vector<std::string>> names_in(const std::string& folder)
{
    std::error_code problem;
    std::vector<std::string> names;
    auto entry = std::filesystem::directory_iterator(folder.empty() ? "." : folder, problem);
    for (; !problem && entry != std::filesystem::directory_iterator(); entry.increment(problem))
        names.push_back(entry->path().filename().string());
    if (problem) return Error{ErrorCode::io, "cannot read the folder: " + problem.message(), {}, folder, {}};
    return names;
}

Status refuse_doubles(const std::vector<FrameFile>& files)
{
    for (std::size_t i = 1; i < files.size(); ++i)
        if (files[i].number == files[i - 1].number)
            return bad_input(concat("this and ", files[i - 1].path, " are both number ", files[i].number));
    return Ok{};
}

} // namespace

std::string Pattern::path(std::uint64_t number) const
{
    std::string text = std::to_string(number);
    if (text.size() < *digits) text.insert(0, *digits - text.size(), '0');
    return folder + name.substr(0, hole) + text + name.substr(hole);
}

Result<std::optional<Pattern>> parse_pattern(const std::string& path)
{
    const std::size_t slash = path.rfind('/');
    Pattern pattern;
    pattern.folder = slash == std::string::npos ? "" : path.substr(0, slash + 1);
    pattern.name = slash == std::string::npos ? path : path.substr(slash + 1);
    if (const auto place = next_placeholder(pattern.name, 0)) {
        if (next_placeholder(pattern.name, place->begin + place->length))
            return Error{ErrorCode::usage, "a name of a sequence has one number, not two", {}, path, {}};
        pattern.name.erase(place->begin, place->length);
        pattern.hole = place->begin;
        pattern.digits = place->digits;
        return std::optional(pattern);
    }
    if (pattern.name.find_first_of("*?") != std::string::npos) return std::optional(pattern);
    return std::optional<Pattern>();
}

Result<std::vector<FrameFile>> list_files(const Pattern& pattern)
{
    MESHREEL_TRY(std::vector<std::string> names, names_in(pattern.folder));
    std::vector<FrameFile> files;
    for (const std::string& name : names) {
        if (!pattern.digits && glob_matches(pattern.name, name)) files.push_back({pattern.folder + name, 0});
        if (!pattern.digits) continue;
        if (const auto number = number_of(pattern, name)) files.push_back({pattern.folder + name, *number});
    }
    if (files.empty()) return Error{ErrorCode::io, "no file has a name like this", {}, {}, {}};
    if (pattern.digits) {
        std::ranges::sort(files, {}, &FrameFile::number);
        MESHREEL_CHECK(refuse_doubles(files));
        return files;
    }
    std::ranges::sort(files, natural_less, &FrameFile::path);
    for (std::size_t i = 0; i < files.size(); ++i) files[i].number = i;
    return files;
}

bool natural_less(std::string_view a, std::string_view b)
{
    std::size_t i = 0, j = 0;
    const auto digits = [](std::string_view text, std::size_t& at) {
        while (at < text.size() && text[at] == '0') ++at;
        const std::size_t begin = at;
        while (at < text.size() && is_digit(text[at])) ++at;
        return text.substr(begin, at - begin);
    };
    while (i < a.size() && j < b.size()) {
        if (is_digit(a[i]) && is_digit(b[j])) {
            const std::string_view x = digits(a, i), y = digits(b, j);
            if (x.size() != y.size()) return x.size() < y.size();
            if (x != y) return x < y;
        } else {
            if (a[i] != b[j]) return a[i] < b[j];
            ++i, ++j;
        }
    }
    if (i < a.size() || j < b.size()) return i == a.size();
    return a < b; // "7" and "007": any fixed order will do
}

bool glob_matches(std::string_view pattern, std::string_view name)
{
    std::size_t p = 0, n = 0, star = std::string_view::npos, retry = 0;
    while (n < name.size()) {
        if (p < pattern.size() && pattern[p] == '*') {
            star = p++;
            retry = n;
        } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == name[n])) {
            ++p, ++n;
        } else {
            if (star == std::string_view::npos) return false;
            p = star + 1;
            n = ++retry;
        }
    }
    while (p < pattern.size() && pattern[p] == '*') ++p;
    return p == pattern.size();
}

} // namespace meshreel::io
