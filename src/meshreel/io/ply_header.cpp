/// Reading the header of a PLY file.
// SPDX-License-Identifier: MIT
#include "meshreel/io/ply_header.h"

#include <algorithm>
#include <array>

#include "meshreel/base/text.h"
#include "meshreel/io/text_scan.h"

namespace meshreel::io {

namespace {

struct TypeName {
    std::string_view name;
    PlyType type;
};
constexpr std::array type_names{
    TypeName{"char", PlyType::i8},    TypeName{"int8", PlyType::i8},     TypeName{"uchar", PlyType::u8},
    TypeName{"uint8", PlyType::u8},   TypeName{"short", PlyType::i16},   TypeName{"int16", PlyType::i16},
    TypeName{"ushort", PlyType::u16}, TypeName{"uint16", PlyType::u16},  TypeName{"int", PlyType::i32},
    TypeName{"int32", PlyType::i32},  TypeName{"uint", PlyType::u32},    TypeName{"uint32", PlyType::u32},
    TypeName{"float", PlyType::f32},  TypeName{"float32", PlyType::f32}, TypeName{"double", PlyType::f64},
    TypeName{"float64", PlyType::f64}};

class HeaderReader {
public:
    explicit HeaderReader(ByteView bytes) : lines_(bytes) {}
    Result<PlyHeader> read();

private:
    Status statement(std::string_view keyword);
    Status format();
    Status element();
    Status property();
    void comment();
    Result<PlyType> type();
    Error wrong(std::string message, std::string field) const
    {
        return bad_input(std::move(message), std::move(field), at_line(lines_.line()));
    }

    LineScanner lines_;
    PlyHeader header_;
    bool has_format_ = false;
};

Status HeaderReader::format()
{
    const std::string_view coding = lines_.word(), version = lines_.word();
    if (coding == "ascii")
        header_.coding = PlyCoding::text;
    else if (coding == "binary_little_endian")
        header_.coding = PlyCoding::little;
    else if (coding == "binary_big_endian")
        header_.coding = PlyCoding::big;
    else
        return wrong(in_quotes(coding) + " is no format of a PLY file", "format");
    if (version != "1.0") return wrong("version " + in_quotes(version) + "; 1.0 is known", "format");
    has_format_ = true;
    return Ok{};
}

Status HeaderReader::element()
{
    PlyElement element;
    element.name = lines_.word();
    const std::string_view word = lines_.word();
    const auto count = to_integer(word);
    if (!count || *count < 0) return wrong(in_quotes(word) + " is not a count", "element");
    element.count = static_cast<std::uint64_t>(*count);
    for (const PlyElement& other : header_.elements)
        if (other.name == element.name) return wrong("a second element " + in_quotes(element.name), "element");
    header_.elements.push_back(std::move(element));
    return Ok{};
}

Result<PlyType> HeaderReader::type()
{
    const std::string_view word = lines_.word();
    const auto found = std::ranges::find(type_names, word, &TypeName::name);
    if (found == type_names.end()) return wrong(in_quotes(word) + " is no type", "property");
    return found->type;
}

Status HeaderReader::property()
{
    if (header_.elements.empty()) return wrong("a property before the first element", "property");
    PlyProperty property;
    LineScanner after_list = lines_;
    if (after_list.word() == "list") {
        lines_ = after_list;
        MESHREEL_TRY(property.count_type, type());
        if (*property.count_type >= PlyType::f32) return wrong("the length of a list is no whole number", "property");
    }
    MESHREEL_TRY(property.type, type());
    property.name = lines_.word();
    if (property.name.empty()) return wrong("a property without a name", "property");
    std::vector<PlyProperty>& properties = header_.elements.back().properties;
    if (std::ranges::find(properties, property.name, &PlyProperty::name) != properties.end())
        return wrong("a second property " + in_quotes(property.name), "property");
    if (std::ranges::any_of(property.name, [](char c) { return c > '\0' ? c < '!' || c > '~' : c == '\0'; }))
        return wrong(in_quotes(property.name) + " is no name", "property");
    properties.push_back(std::move(property));
    return Ok{};
}

void HeaderReader::comment()
{
    if (lines_.word() != ply_comment_tag) return;
    const std::string_view what = lines_.word();
    if (what == "material") header_.materials.emplace_back(lines_.rest());
    if (what == "group") header_.groups.emplace_back(lines_.rest());
}

Status HeaderReader::statement(std::string_view keyword)
{
    if (keyword == "format") return format();
    if (keyword == "element") return element();
    if (keyword == "property") return property();
    if (keyword == "comment") comment();
    if (keyword == "comment" || keyword == "obj_info" || keyword.empty()) return Ok{};
    return wrong(in_quotes(keyword) + " is no statement of a PLY header", "header");
}

Result<PlyHeader> HeaderReader::read()
{
    if (!lines_.next_line() || lines_.word() != "ply")
        return bad_input("this is no PLY file: its first line is not 'ply'", "signature", at_line(1));
    while (lines_.next_line()) {
        const std::string_view keyword = lines_.word();
        if (keyword != "end_header") {
            MESHREEL_CHECK(statement(keyword));
            continue;
        }
        if (!has_format_) return wrong("the header names no format", "format");
        header_.size = lines_.next_offset();
        header_.lines = lines_.line();
        return std::move(header_);
    }
    return wrong("the file ends before 'end_header'", "header");
}

} // namespace

std::size_t size_of(PlyType type)
{
    constexpr std::size_t sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
    return sizes[static_cast<std::size_t>(type)];
}

std::size_t PlyElement::smallest_row(PlyCoding coding) const
{
    std::size_t size = 0;
    for (const PlyProperty& property : properties)
        size += coding == PlyCoding::text ? 2 : size_of(property.count_type.value_or(property.type));
    return size;
}

Result<PlyHeader> parse_ply_header(ByteView bytes)
{
    return HeaderReader(bytes).read();
}

} // namespace meshreel::io
