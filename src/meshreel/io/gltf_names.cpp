/// Names on the way between glTF and an Appearance.
// SPDX-License-Identifier: MIT
#include "meshreel/io/gltf_names.h"

#include "meshreel/base/text.h"

namespace meshreel::io {

namespace {

bool all_digits(std::string_view text)
{
    for (char c : text)
        if (c < '0' || c > '9') return false;
    return !text.empty();
}

std::string escaped(const std::string& name)
{
    constexpr std::string_view digits = "0123456789ABCDEF";
    std::string plain;
    for (char c : name) {
        const auto byte = static_cast<unsigned char>(c);
        const bool special = c == '%' || c == '/' || c == '#' || c == '@' || byte < 32;
        plain += special ? concat("%", std::string(1, digits[byte / 16]), std::string(1, digits[byte % 16]))
                         : std::string(1, c);
    }
    return plain;
}

int hex_digit(char c)
{
    if (c >= '0' && c <= '9') return c - '0';
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

std::string unescaped(std::string_view name)
{
    std::string plain;
    for (std::size_t i = 0; i < name.size(); ++i) {
        const bool escape =
            name[i] == '%' && i + 2 < name.size() && hex_digit(name[i + 1]) >= 0 && hex_digit(name[i + 2]) >= 0;
        plain += escape ? static_cast<char>(hex_digit(name[i + 1]) * 16 + hex_digit(name[i + 2])) : name[i];
        if (escape) i += 2;
    }
    return plain;
}

/// A small number in decimal; nothing for anything else.
std::optional<std::size_t> small_number(std::string_view text)
{
    if (!all_digits(text) || text.size() > 9) return std::nullopt;
    return static_cast<std::size_t>(std::stoul(std::string(text)));
}

constexpr std::string_view scalar_names[] = {"f32", "u8", "u16", "u32", "i8", "i16"};

} // namespace

std::string gltf_image_name(std::size_t i)
{
    return concat("gltf/images/", i);
}

std::optional<std::string> attribute_name(const std::string& semantic)
{
    if (semantic == "NORMAL") return "normal";
    if (semantic == "TANGENT") return "tangent";
    if (semantic.starts_with("TEXCOORD_") && all_digits(semantic.substr(9))) return "uv" + semantic.substr(9);
    if (semantic.starts_with("COLOR_") && all_digits(semantic.substr(6))) return "color" + semantic.substr(6);
    if (semantic.starts_with("_")) return semantic;
    return std::nullopt;
}

std::optional<std::string> attribute_semantic(const std::string& name)
{
    const std::string plain = name.starts_with("_") ? name : name.substr(0, name.find('|'));
    if (plain == "normal") return "NORMAL";
    if (plain == "tangent") return "TANGENT";
    if (plain.starts_with("uv") && all_digits(plain.substr(2))) return "TEXCOORD_" + plain.substr(2);
    if (plain.starts_with("color") && all_digits(plain.substr(5))) return "COLOR_" + plain.substr(5);
    if (plain.starts_with("_")) return plain.substr(0, plain.find('|'));
    return std::nullopt;
}

std::string variant_name(const Attribute& attribute)
{
    return concat(attribute.name, "|", scalar_names[static_cast<std::size_t>(attribute.type)],
                  attribute.normalized ? "nx" : "x", static_cast<unsigned>(attribute.components));
}

std::string GltfGroup::name() const
{
    return concat(escaped(node), instance > 1 ? concat("@", instance) : std::string(), "/", escaped(mesh), "#",
                  primitive);
}

GltfGroup parse_group(const std::string& name)
{
    const std::size_t slash = name.find('/'), hash = name.find('#', slash == name.npos ? 0 : slash);
    const auto primitive = hash == name.npos ? std::nullopt : small_number(std::string_view(name).substr(hash + 1));
    if (slash == name.npos || !primitive || name.find('/', slash + 1) != name.npos) return {name, 1, name, 0};
    const std::string_view node = std::string_view(name).substr(0, slash);
    const std::size_t at = node.find('@');
    const auto instance = at == node.npos ? std::optional<std::size_t>(1) : small_number(node.substr(at + 1));
    if (!instance) return {name, 1, name, 0};
    return {unescaped(node.substr(0, at)), *instance,
            unescaped(std::string_view(name).substr(slash + 1, hash - slash - 1)), *primitive};
}

} // namespace meshreel::io
