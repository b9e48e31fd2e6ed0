/// Rows of Markdown from fields.
// SPDX-License-Identifier: MIT
#include "meshreel/container/table.h"

#include <cstdio>

#include "meshreel/base/text.h"

namespace meshreel::container {

namespace {

std::string_view name_of_encoding(Encoding encoding)
{
    constexpr std::string_view names[] = {"u8",  "u16", "u32",  "u64",   "varint", "zigzag",   "f32",
                                          "f64", "tag", "text", "bytes", "rest",   "constant", "varint"};
    return names[static_cast<std::size_t>(encoding)];
}

std::string_view name_of_limit(Limit limit)
{
    constexpr std::string_view names[] = {"", "max_vertices", "max_triangles", "max_frames", "max_memory"};
    return names[static_cast<std::size_t>(limit)];
}

std::string range_text(const Field& field)
{
    const Range range = field.range;
    if (!field.names.empty()) {
        std::string all;
        for (std::size_t i = 0; i < field.names.size(); ++i) all += concat(i == 0 ? "" : ", ", i, " ", field.names[i]);
        return all;
    }
    if (range.limit != Limit::none) return concat(range.low, " .. ", name_of_limit(range.limit));
    if (range.high == any.high) return range.low == 0 ? "any" : concat(range.low, " or more");
    return concat(range.low, " .. ", range.high);
}

std::string real_text(RealRange range)
{
    if (range.low == positive.low && range.high == finite.high) return "above 0";
    if (range.low == finite.low && range.high == finite.high) return "finite";
    char low[32], high[32];
    std::snprintf(low, sizeof low, "%.17g", range.low);
    std::snprintf(high, sizeof high, "%.17g", range.high);
    return range.high == finite.high ? concat(low, " or more") : concat(low, " .. ", high);
}

std::string signed_text(SignedRange range)
{
    return concat(range.low, " .. ", range.high);
}

} // namespace

void Table::row(const Field& field, std::string encoding, const std::string& range)
{
    std::string name, condition;
    for (const std::string& step : path_) name += step + ".";
    for (const std::string& text : conditions_) condition += condition.empty() ? "if " + text : " and " + text;
    if (!condition.empty()) condition += ": ";
    std::string line =
        concat("| `", name, field.name, "` | ", encoding, " | ", range, " | ", condition, field.meaning, " |");
    rows_ += line + "\n";
}

std::uint64_t Table::integer(const Field& field, std::uint64_t)
{
    const bool tag = field.encoding == Encoding::tag, whole = field.encoding == Encoding::zigzag;
    row(field, std::string(name_of_encoding(field.encoding)),
        tag     ? "four letters"
        : whole ? signed_text(field.whole)
                : range_text(field));
    return 0;
}

double Table::real(const Field& field, double)
{
    row(field, std::string(name_of_encoding(field.encoding)), real_text(field.real));
    return 0.0;
}

ByteView Table::bytes(const Field& field, ByteView expected)
{
    std::string range = field.encoding == Encoding::rest ? "" : range_text(field) + " bytes";
    if (field.range.high == any.high && field.range.low == 0) range = "";
    if (field.encoding == Encoding::constant) {
        range.clear();
        for (const std::uint8_t byte : expected) {
            char text[4];
            std::snprintf(text, sizeof text, "%02x ", byte);
            range += text;
        }
    }
    row(field, std::string(name_of_encoding(field.encoding)), range);
    return {};
}

ByteView Table::array(const Field& field, ByteView, std::uint64_t)
{
    row(field, concat(name_of_encoding(field.encoding), " x ", field.times), "finite");
    return {};
}

std::uint64_t Table::list_count(const Field& field, std::uint64_t, std::size_t)
{
    row(field, "varint, then items", range_text(field));
    return 1;
}

void Table::enter(std::string_view name, std::uint64_t index)
{
    path_.push_back(concat(name, index == any.high ? "" : "[i]"));
}

void Table::leave()
{
    path_.pop_back();
}

bool Table::begin_when(bool /*condition*/, std::string_view text)
{
    conditions_.push_back(std::string(text));
    return true;
}

void Table::end_when()
{
    conditions_.pop_back();
}

void Table::rule(bool /*holds*/, std::string_view name, std::string_view rule)
{
    row({.name = name, .encoding = Encoding::u8, .meaning = rule}, "(rule)", "");
}

std::string Table::markdown() const
{
    return "| field | encoding | values | meaning |\n|---|---|---|---|\n" + rows_;
}

} // namespace meshreel::container
